// solve: lights and materials that fit themselves to a picture or to illuminances.
//
//   LightFit lamp;
//   lamp.light = 0;                                            // Scene::area_lights[0]
//   lamp.power = lamp.position = true;
//   PictureTarget target;
//   target.picture = read_picture("target.exr");
//   const Solution found = solve(scene, {lamp}, {}, {target});
//   // found.area_lights[0], found.parameters, found.converged
//
// Powers and colours alone are linear: shadows and bounces may count. Places, rotations, sizes and vertices are found by Levenberg and
// Marquardt in a box, with derivatives of the light without sampling. See docs/solve.md. Needs the layer `solve` (steradian::solve).
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "steradian/picture.h"
#include "steradian/render.h"
#include "steradian/scene.h"

namespace steradian {

struct FitRange {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
};

// The parameters of one light that are free. Lights are numbered: area lights first, then punctual lights.
struct LightFit {
  std::size_t light = 0;
  std::string name{};     // in the names of parameters and in messages; empty: the light's own
  bool power = false;     // one factor for all channels
  bool color = false;     // each channel by itself; `power` must then be false
  bool position = false;  // of the centre
  bool rotation = false;  // about the centre
  bool size = false;      // width and height of a rectangle, diameter of a disk or sphere, length and diameter of a tube
  bool vertices = false;  // of a polygon, each in the light's plane; position, rotation and size must then be false
  FitRange position_x{}, position_y{}, position_z{};                 // [m]
  double most_degrees = 180;                                         // of the rotation, for each of its three components
  FitRange size_range{0, std::numeric_limits<double>::infinity()};   // [m]
  FitRange power_range{0, std::numeric_limits<double>::infinity()};  // of light_flux
  double most_move = std::numeric_limits<double>::infinity();        // of a vertex along each of two directions [m]
  double keep = 0;  // weight of staying at the start: one residual a parameter, its change over its typical size
};

// Lights that follow the first one in the parameters that its fit has free. With a mirror, which is a plane, a follower has the place of
// the first light's image, and turns as it does. Without one, followers move by the same distance.
struct LightTie {
  std::vector<std::size_t> lights;
  bool has_mirror = false;
  Vec3d mirror_point{}, mirror_normal{1, 0, 0};
};

// The parameters of one material that are free: of all meshes that have it.
struct MaterialFit {
  std::size_t material = 0;  // of Scene::materials
  std::string name{};        // in the names of parameters and in messages; empty: the material's own
  bool albedo = false;       // factor on the base colour, each channel by itself
  bool roughness = false;    // factor on the perceptual roughness
  FitRange albedo_range{0, 1}, roughness_range{0, 1};
  double keep = 0;  // as LightFit::keep
};

// Function of a radiance or an illuminance v that residuals compare. root: sqrt(v / mean + 0.01), with the target's mean. linear: v / mean.
// log: log(v / mean + 0.01).
enum class ResidualSpace { root, linear, log };
// squares: least squares. cauchy: residuals far above 0.05 hardly count, such as those of wrong pixels.
enum class ResidualLoss { squares, cauchy };

// The light of a surface that a picture compares. A painted highlight is specular: as plain radiance, a lamp over it would do.
enum class LightPart { all, diffuse, specular };

struct PictureTarget {
  Picture picture;                     // linear; its size is the size of the fit
  std::string camera;                  // empty: the first
  std::vector<float> pixel_weights{};  // by pixel; empty: all 1. A weight of 0 leaves a pixel out
  double weight = 1;
  ResidualSpace space = ResidualSpace::root;
  ResidualLoss loss = ResidualLoss::squares;
  LightPart part = LightPart::all;
  bool painted = false;  // its bright patches are strokes, not lamps that it shows
};

// Wanted illuminances [lux], where radiances are in nits. A band costs nothing inside.
struct LuxBand {
  std::optional<double> min, max;
  std::optional<double> mean;        // over all points
  std::optional<double> uniformity;  // least value over the mean, in [0, 1]
};

struct LuxTarget {
  std::string name;
  std::vector<Vec3d> points, normals;  // as many of each
  LuxBand lux;
  double weight = 1;
};

using LightTarget = std::variant<PictureTarget, LuxTarget>;

// One accepted step of the solver.
struct SolveStep {
  int start = 0;       // number of the starting point, 0 the scene's own
  int step = 0;        // 0: the starting point itself
  double cost = 0;     // half the sum of squares
  double damping = 0;  // lambda of Levenberg and Marquardt; 0 for a linear problem
};

struct FittedParameter {
  std::string name;  // "lamp: position x"
  // Metres, degrees, or the unit of light_flux; a colour's channel in the light's radiance. A vertex: its move from the start.
  double start = 0, value = 0;
  double sigma = 0;  // standard error of `value`, from the residuals; infinite where it is not determined
  bool at_bound = false;
  bool determined = true;  // false: the targets hardly change with it, or only together with others
};

struct LuxResult {
  std::string name;
  double min = 0, mean = 0, max = 0;  // [lux]
  std::size_t outside = 0;            // points outside of the band by more than 1e-3 of it
  std::size_t points = 0;
};

// How a light has changed from the scene's.
struct LightChange {
  std::size_t light = 0;          // as LightFit::light
  Vec3d move{};                   // of its centre [m]
  Vec3d rotation{};               // about the centre: axis times angle [rad]
  double size_1 = 1, size_2 = 1;  // factors on width or length, and on height or diameter
  std::vector<Vec3d> vertices{};  // of a polygon whose vertices were fitted, as flat_polygon has them: the outline, then the holes
  bool color = false;             // false: `radiance` is a multiple of the scene's
  Vec3d radiance{};               // intensity of a punctual light
};

// How a material has changed from the scene's.
struct MaterialChange {
  std::size_t material = 0;                        // as MaterialFit::material
  bool has_albedo = false, has_roughness = false;  // what was fitted
  Vec3d albedo{};                                  // factor on the base colour
  double roughness = 0;                            // factor on the perceptual roughness
};

struct SolveOptions {
  RenderOptions render{};  // method, quality, shadows, bounces, threads; size and camera are the targets'
  int starts = 1;          // the scene's own, and random ones within the ranges
  std::uint64_t seed = 1;
  int max_steps = 100;
  double tolerance = 1e-6;                           // relative change of the cost, and of the parameters, at which steps end
  bool least_power = false;                          // of all settings of powers that satisfy the illuminances, that of the least power
  std::function<bool(const SolveStep&)> progress{};  // returns false to stop; the best so far is the solution
  std::function<void(const std::vector<LightChange>&)> moved{};  // called with the lights of each accepted step, before `progress`
  std::vector<MaterialFit> materials{};                          // fitted with the lights, or alone
};

struct Solution {
  std::vector<AreaLight> area_lights;          // all of the scene's, the fitted ones changed
  std::vector<PunctualLight> punctual_lights;  // likewise
  std::vector<LightChange> changes;            // of the fitted lights and of those tied to them
  std::vector<MaterialChange> material_changes;
  std::vector<FittedParameter> parameters;
  std::vector<SolveStep> steps;
  std::vector<LuxResult> lux;  // by illuminance target
  double cost = 0;
  double picture_error = 0;  // rms of the pictures' residuals, in their space
  std::size_t residuals = 0;
  int evaluations = 0;
  bool converged = false;
  bool stopped = false;            // by `progress`
  std::vector<std::string> notes;  // statements about the fit, a sentence each
};

// Finds the lights. Throws Error with all problems at once: lights that do not have a parameter, empty targets, nothing to fit, fewer
// residuals than parameters, lights that no target sees. The same arguments give the same bytes at any number of threads.
Solution solve(const Scene& scene, const std::vector<LightFit>& fits, const std::vector<LightTie>& ties,
               const std::vector<LightTarget>& targets, const SolveOptions& options = {});

// The values of all targets as a function of the free parameters, with exact derivatives where the light has them: for other optimizers.
//
//   const LightModel model(scene, fits, {}, targets);
//   const LightModel::Values v = model.with_slopes(model.start());
class LightModel {
 public:
  // The arguments must outlive this object. Throws Error as solve does.
  LightModel(const Scene& scene, const std::vector<LightFit>& fits, const std::vector<LightTie>& ties,
             const std::vector<LightTarget>& targets, const SolveOptions& options = {});
  ~LightModel();
  LightModel(const LightModel&) = delete;
  LightModel& operator=(const LightModel&) = delete;

  // Variables: metres, radians, and factors on the power. The factors are logarithms if a position, rotation or size is free too.
  struct Variable {
    std::string name;
    double start = 0, low = 0, high = 0;
  };
  std::vector<Variable> variables() const;
  std::vector<double> start() const;

  // Pictures: red, green and blue of the pixels that count, row by row. Illuminances: one a point. Targets follow each other.
  struct Values {
    std::vector<double> value;
    std::vector<double> slopes;  // one row of variables a value; empty without slopes
  };
  Values at(const std::vector<double>& x) const;
  Values with_slopes(const std::vector<double>& x) const;
  // The pictures' values; a quiet NaN for an illuminance, whose target is a band.
  std::vector<double> wanted() const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

// Flux of a light [lm where radiances are in nits]: pi times luminance of the radiance times emitting area; 4 pi times the intensity of a
// point or spot light; the illuminance of a directional light.
double light_flux(const AreaLight& light);
double light_flux(const PunctualLight& light);

}  // namespace steradian
