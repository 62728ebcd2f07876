// The plane: light in two dimensions, without sampling. Bodies that shine or block, and the mean radiance at a point.
//
//   PlaneScene scene = load_plane_scene("lamps.svg").scene;
//   PlaneWorld world(scene);
//   Vec3d light = world.query({320, 200}).radiance;   // radiance averaged over the circle of directions
//
// Every body blocks, lights too. A point inside an occluder is dark; a point inside a light sees that light (the last
// in the scene, inside several) in all directions that nothing inside it blocks. Where edges coincide, the light's is
// seen. Coordinates are SVG user units, y downwards. The whole of it is deterministic.
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

// How a light's radiance depends on direction and distance.
enum class PlaneProfile {
  uniform,  // the same radiance to every side
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
  std::optional<PlaneGradient> gradient;  // takes the place of `radiance`
  PlaneProfile profile = PlaneProfile::uniform;
  double range = std::numeric_limits<double>::infinity();  // times (1 - (r/range)^2)^2, r to the light's surface
  Vec2d spot_axis;                                         // light leaves within spot_half_angle of this direction; zero: everywhere
  double spot_half_angle = 0;                              // radians, up to pi

  bool is_spot() const { return spot_axis.x != 0 || spot_axis.y != 0; }
};

struct PlaneBody {
  enum class Shape {
    polygon,   // filled contours; holes and self-intersections by the fill rule
    polyline,  // open contours of no thickness, seen from both sides
    ellipse,   // center and two conjugate half axes
    capsule,   // all points nearer than `radius` to the segment contours[0][0], contours[0][1]
  };
  Shape shape = Shape::polygon;
  std::vector<std::vector<Vec2d>> contours;
  bool even_odd = false;
  Vec2d center, x_axis, y_axis;
  double radius = 0;
  std::optional<PlaneEmission> light;  // an occluder has none
  Vec3d color;                         // linear RGB, to draw an occluder with, and what it reflects where no albedo is given
  std::optional<Vec3d> albedo;  // the share of the light that its outline sends on (plane_bounce.h); none: `color`, of a light nothing
  std::string name;             // the SVG id, for messages
  // What an occluder may do with light other than to block it, one of them at most:
  std::optional<Vec3d> transmittance;  // let through this share of each channel, once for each body that a ray meets
  std::optional<Vec3d> mirror;         // send back this share from its straight edges, as a mirror does, once
  double light_depth = 0;              // above 0: take it in, and show within it what is left: exp(-s / light_depth) after a way s
};

// A light at infinity: seen where nothing blocks it, from outside of lights.
struct PlaneSun {
  Vec3d radiance{1, 1, 1};   // of a sun without width: what arrives of it, the integral over directions
  double direction = 0;      // radians, where it stands as seen from the scene; y is downwards
  double half_width = 0;     // radians, up to pi; 0: shadows are hard
  std::string name = "sun";  // for messages
};

PlaneBody plane_polygon(std::vector<Vec2d> vertices);
PlaneBody plane_circle(Vec2d center, double radius);
// A light along a line, a body an edge: radiance is that of the texels, evenly placed from its first point to its last, and linear between
// them. All else is as in `emission`. Throws Error for a line without length or texels.
std::vector<PlaneBody> plane_textured_line(const std::vector<Vec2d>& points, const std::vector<Vec3d>& texels,
                                           const PlaneEmission& emission = {});

// Where the picture's shape is not the scene's.
enum class PlaneFit {
  stretch,  // the scene fills it
  meet,     // all of the scene is in it, and what lies around it
  slice,    // the scene fills it and is cut off
};

struct PlaneScene {
  Vec2d origin;  // of the picture: the viewBox
  double width = 512, height = 512;
  std::vector<PlaneBody> bodies;
  std::vector<PlaneSun> suns;
  double fog_density = 0;            // what is seen at distance r is times exp(-fog_density r); suns are not dimmed
  PlaneFit fit = PlaneFit::stretch;  // SVG files: meet, unless they say otherwise
  Vec2d align{0.5, 0.5};             // of meet and slice: 0 the left and top, 1 the right and bottom
  std::string name = "scene";        // for messages: the file it came from
};

enum class PlaneMethod {
  exact,    // lower envelope in closed form
  par,      // Qiu's "Probabilistic Angular Radiance", as published
  sampled,  // stratified rays
  marched,  // rays that step along the signed distance
};
const char* name_of(PlaneMethod method);
// Throws Error for an unknown name, with those that exist.
PlaneMethod plane_method_from_name(const std::string& name);

struct PlaneSampling {
  int spp = 64;  // rays of `sampled` and `marched`
  std::uint64_t seed = 1;
};

struct PlaneLight {
  Vec3d radiance;            // averaged over the circle of directions
  Vec3d moment_x, moment_y;  // the same average of radiance times direction (towards the light), per channel
};

// A scene made ready. Holds its own copy; const, and safe to use from several threads.
class PlaneWorld {
 public:
  // Throws Error, with the body's name, for coordinates that are not finite or beyond a million pictures, and outlines
  // without vertices; with the scene's, where it asks for more than the limits.
  explicit PlaneWorld(PlaneScene scene, const Limits& limits = {});
  ~PlaneWorld();
  PlaneWorld(PlaneWorld&&) noexcept;
  PlaneWorld& operator=(PlaneWorld&&) noexcept;

  const PlaneScene& scene() const;

  // What arrives at a point. In double; `exact` is within 1e-12 of the closed form. Moments come from every method
  // but par.
  PlaneLight query(Vec2d position, PlaneMethod method = PlaneMethod::exact, const PlaneSampling& sampling = {}) const;

  struct Impl;
  const Impl& impl() const { return *impl_; }

 private:
  std::unique_ptr<Impl> impl_;
};

// What a picture shows where occluders are. Inside of them it is dark.
enum class PlaneOccluders {
  black,
  fill,   // their colour, the last in the scene on top
  clear,  // nothing: layer "alpha" is 0 in them and 1 elsewhere
};

class PlaneBounces;  // plane_bounce.h

struct PlaneFrameOptions {
  int width = 0, height = 0;  // pixels; 0: the scene's own size, one unit a pixel
  PlaneMethod method = PlaneMethod::exact;
  PlaneSampling sampling;
  PlaneOccluders occluders = PlaneOccluders::black;
  const PlaneBounces* bounces = nullptr;  // of the same world: their light, too; of `exact` without moments
  bool bounce_error = false;              // layer "bounce_error": how far it may be off
  double bounce_lattice = 0;              // above 0: their light is linear over cells of 8 x 8 pixels whose middle is then off by no more
                                          // than this share of its brightest place; 0: worked out at every pixel
  bool moments = false;                   // layers "moment_x" and "moment_y"; in double, pixel by pixel
  int aa = 1;                             // point values a pixel, on a square grid (rounded up to a square number)
  int threads = 0;                        // 0: all
  Limits limits;                          // of the picture, and of the lights and blockers that may meet in it
  std::function<void(std::uint64_t done, std::uint64_t total)> progress;  // called from any thread
};

struct PlaneFrameStats {
  double prepare_ms = 0, frame_ms = 0;
  int threads = 0;
  std::size_t lights = 0, occluders = 0;
  std::uint64_t tile_lights = 0, tile_blockers = 0;  // pairs that reached the pixels, of `exact`
  double lattice_error = 0;                          // of bounce_lattice: what the middle of a cell is off by, at most
  double lattice_drawn = 1;                          // share of the picture in which every pixel was worked out
};

// The mean radiance at every pixel's centre. `exact` is worked in single precision, tile by tile, and is within 1e-5
// (of a light of radiance 1) of query. The same bytes at any number of threads.
Picture render_plane(const PlaneWorld& world, const PlaneFrameOptions& options, PlaneFrameStats* stats = nullptr);
// The same into a picture that is there: frame after frame, its memory need not be fetched from the system again, which
// is a third of a simple frame's time.
void render_plane_into(Picture& picture, const PlaneWorld& world, const PlaneFrameOptions& options, PlaneFrameStats* stats = nullptr);

struct PlaneSvg {
  PlaneScene scene;
  std::vector<std::string> ignored;  // elements and attributes the file uses and we do not support, each once
};

// Reads an SVG file as a scene; see docs/plane.md for what counts as light and occluder. Throws Error with file, line
// and a hint. load_plane_scene_from_text takes the SVG itself; `name` stands for the file in messages.
PlaneSvg load_plane_scene(const std::string& path, const Limits& limits = {});
PlaneSvg load_plane_scene_from_text(const std::string& svg, const std::string& name, const Limits& limits = {});

// The scene as SVG text that reads back as the same scene.
std::string plane_scene_to_svg(const PlaneScene& scene);

}  // namespace steradian
