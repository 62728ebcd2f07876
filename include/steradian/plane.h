// The plane: light in two dimensions, without sampling. Bodies that shine or block, and the mean radiance at a point.
//
//   PlaneScene scene = load_plane_scene("lamps.svg").scene;
//   PlaneWorld world(scene);
//   Vec3d light = world.query({320, 200}).radiance;   // radiance averaged over the circle of directions
//
// Every body blocks, including lights. A point inside an occluder is dark. A point inside a light sees that light in all directions that
// nothing inside it blocks; inside several lights, the last one in the scene counts. If edges coincide, the light's edge is visible.
// Coordinates are SVG user units, y downwards. All of it is deterministic.
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "steradian/limits.h"
#include "steradian/picture.h"
#include "steradian/vector.h"
#include "steradian/vector2.h"

namespace steradian {

// Dependence of a light's radiance on direction and distance.
enum class PlaneProfile {
  uniform,  // the same radiance to all sides
  lambert,  // times the cosine between the edge's normal and the direction
  inverse,  // divided by the distance in user units
};

struct PlaneStop {
  double offset = 0;  // along the gradient, 0 to 1
  Vec3d radiance;
};

// Radiance that changes linearly along a direction of the plane, constant beyond the first and the last stop.
struct PlaneGradient {
  Vec2d from, to;
  std::vector<PlaneStop> stops;  // at least one, by rising offset
};

struct PlaneEmission {
  Vec3d radiance{1, 1, 1};                // linear RGB
  std::optional<PlaneGradient> gradient;  // replaces `radiance`
  PlaneProfile profile = PlaneProfile::uniform;
  double range = std::numeric_limits<double>::infinity();  // factor (1 - (r/range)^2)^2, r to the light's surface
  Vec2d spot_axis;                                         // light leaves within spot_half_angle of this direction; zero: everywhere
  double spot_half_angle = 0;                              // radians, up to pi

  bool is_spot() const { return spot_axis.x != 0 || spot_axis.y != 0; }
};

struct PlaneBody {
  enum class Shape {
    polygon,   // filled contours; holes and self-intersections by the fill rule
    polyline,  // open contours of no thickness, visible from both sides
    ellipse,   // center and two conjugate half axes
    capsule,   // all points nearer than `radius` to the segment contours[0][0], contours[0][1]
  };
  Shape shape = Shape::polygon;
  std::vector<std::vector<Vec2d>> contours;
  bool even_odd = false;
  Vec2d center, x_axis, y_axis;
  double radius = 0;
  std::optional<PlaneEmission> light;  // none for an occluder
  Vec3d color;                         // linear RGB, the drawn colour of an occluder; also its albedo if none is given
  std::optional<Vec3d> albedo;  // fraction of the light that its outline reflects (plane_bounce.h); none: `color`; for a light, nothing
  std::string name;             // the SVG id, for messages
  // Effects of an occluder on light other than blocking, at most one of them:
  std::optional<Vec3d> transmittance;  // it transmits this fraction of each channel, once for each body that a ray meets
  std::optional<Vec3d> mirror;         // its straight edges reflect this fraction, as a mirror does, once
  double light_depth = 0;              // above 0: it absorbs light, and shows within it the rest: exp(-s / light_depth) after a path s
};

// A light at infinity: visible if nothing blocks it, from outside of lights.
struct PlaneSun {
  Vec3d radiance{1, 1, 1};   // for a sun without width: the integral of the arriving light over directions
  double direction = 0;      // radians, its position from the scene; y is downwards
  double half_width = 0;     // radians, up to pi; 0: shadows are hard
  std::string name = "sun";  // for messages
};

PlaneBody plane_polygon(std::vector<Vec2d> vertices);
PlaneBody plane_circle(Vec2d center, double radius);
// A light along a line, with one body an edge. The radiance is that of the texels, which are evenly spaced from its first point to its
// last, and linear between them. All other values are as in `emission`. Throws Error for a line without length or texels.
std::vector<PlaneBody> plane_textured_line(const std::vector<Vec2d>& points, const std::vector<Vec3d>& texels,
                                           const PlaneEmission& emission = {});

// Fit of the scene in a picture of another shape.
enum class PlaneFit {
  stretch,  // the scene fills it
  meet,     // the whole scene is in it, and its surroundings
  slice,    // the scene fills it and is cropped
};

struct PlaneScene {
  Vec2d origin;  // origin of the picture: the viewBox
  double width = 512, height = 512;
  std::vector<PlaneBody> bodies;
  std::vector<PlaneSun> suns;
  double fog_density = 0;            // light at distance r is times exp(-fog_density r); suns are not dimmed
  PlaneFit fit = PlaneFit::stretch;  // SVG files: meet, unless they say otherwise
  Vec2d align{0.5, 0.5};             // for meet and slice: 0 is the left and top, 1 the right and bottom
  std::string name = "scene";        // for messages: the file that it came from
};

enum class PlaneMethod {
  exact,    // lower envelope in closed form
  par,      // Qiu's "Probabilistic Angular Radiance", as published
  sampled,  // stratified rays
  marched,  // rays that step along the signed distance
};
const char* name_of(PlaneMethod method);
// Throws Error for an unknown name, with the known names.
PlaneMethod plane_method_from_name(const std::string& name);

struct PlaneSampling {
  int spp = 64;  // rays of `sampled` and `marched`
  std::uint64_t seed = 1;
};

struct PlaneLight {
  Vec3d radiance;            // averaged over the circle of directions
  Vec3d moment_x, moment_y;  // the same average of radiance times direction (towards the light), per channel
};

// A prepared scene. It owns a copy, is const, and is safe to use from several threads.
class PlaneWorld {
 public:
  // Throws Error, with the body's name, for outlines without vertices and for coordinates that are not finite or beyond a million pictures.
  // Throws Error with the scene's name if it exceeds the limits.
  explicit PlaneWorld(PlaneScene scene, const Limits& limits = {});
  ~PlaneWorld();
  PlaneWorld(PlaneWorld&&) noexcept;
  PlaneWorld& operator=(PlaneWorld&&) noexcept;

  const PlaneScene& scene() const;

  // Light that arrives at a point, in double; `exact` is within 1e-12 of the closed form. Every method but par gives moments.
  PlaneLight query(Vec2d position, PlaneMethod method = PlaneMethod::exact, const PlaneSampling& sampling = {}) const;

  struct Impl;
  const Impl& impl() const { return *impl_; }

 private:
  std::unique_ptr<Impl> impl_;
};

// Appearance of occluders in a picture. It is dark inside of them.
enum class PlaneOccluders {
  black,
  fill,   // their colour; the last in the scene is on top
  clear,  // nothing: layer "alpha" is 0 in them and 1 elsewhere
};

class PlaneBounces;  // plane_bounce.h

struct PlaneFrameOptions {
  int width = 0, height = 0;  // pixels; 0: the scene's own size, one unit a pixel
  PlaneMethod method = PlaneMethod::exact;
  PlaneSampling sampling;
  PlaneOccluders occluders = PlaneOccluders::black;
  const PlaneBounces* bounces = nullptr;  // for the same world: adds their light; for `exact` without moments
  bool bounce_error = false;              // layer "bounce_error": its possible error
  double bounce_lattice = 0;              // above 0: their light is linear over cells of 8 x 8 pixels whose middle then has an error of at
                                          // most this fraction of its brightest place; 0: computed at every pixel
  bool moments = false;                   // layers "moment_x" and "moment_y"; in double, pixel by pixel
  int aa = 1;                             // points per pixel, on a square grid (rounded up to a square number)
  int threads = 0;                        // 0: all
  Limits limits;                          // limits of the picture, and of the lights and blockers that may meet in it
  std::function<void(std::uint64_t done, std::uint64_t total)> progress;  // called from any thread
};

struct PlaneFrameStats {
  double prepare_ms = 0, frame_ms = 0;
  int threads = 0;
  std::size_t lights = 0, occluders = 0;
  std::uint64_t tile_lights = 0, tile_blockers = 0;  // pairs that reached the pixels, of `exact`
  double lattice_error = 0;                          // for bounce_lattice: the largest error in the middle of a cell
  double lattice_drawn = 1;                          // fraction of the picture in which every pixel was computed
};

// The mean radiance at every pixel's centre. `exact` is computed in single precision, tile by tile, and is within 1e-5 (for a light of
// radiance 1) of query. The bytes are the same at any number of threads.
Picture render_plane(const PlaneWorld& world, const PlaneFrameOptions& options, PlaneFrameStats* stats = nullptr);
// The same into an existing picture. Frame after frame, its memory need not be fetched from the system again, which is a third of a simple
// frame's time.
void render_plane_into(Picture& picture, const PlaneWorld& world, const PlaneFrameOptions& options, PlaneFrameStats* stats = nullptr);

// Shapes of a file that are not in the scene, by the reason.
struct PlaneLeftOut {
  enum class Why {
    covers_picture,  // a filled shape that leaves no point of the picture free: taken for a backdrop, which blocks nothing
    covers_lights,   // a filled shape that holds every light, without suns: likewise
    ignored,         // not displayed, or its role is to be ignored
    transparent,     // without opacity
    unpainted,       // without a fill and a stroke
    clipped,         // outside of its clip-path or mask
  };
  Why why = Why::ignored;
  std::size_t count = 0;
  std::vector<std::string> names;  // of the first eight: the id, or the element and its line

  bool is_backdrop() const { return why == Why::covers_picture || why == Why::covers_lights; }
};
// The reason in words, as in "covers every light".
const char* words_of(PlaneLeftOut::Why why);

struct PlaneSvg {
  PlaneScene scene;
  std::vector<std::string> ignored;    // unsupported elements and attributes that the file uses, each once
  std::vector<PlaneLeftOut> left_out;  // at most one for each reason
  std::vector<std::string> warnings;   // lights that an occluder hides, in one sentence
};

// Reads an SVG file as a scene; docs/plane-drawings.md defines lights and occluders. Throws Error with file, line and a hint.
// load_plane_scene_from_text takes the SVG itself; `name` is the file's name in messages.
PlaneSvg load_plane_scene(const std::string& path, const Limits& limits = {});
PlaneSvg load_plane_scene_from_text(const std::string& svg, const std::string& name, const Limits& limits = {});

// The scene as SVG text that reads back as the same scene.
std::string plane_scene_to_svg(const PlaneScene& scene);

}  // namespace steradian
