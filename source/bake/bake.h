// bake: the irradiance of a scene's surfaces as a map of texels, or at their vertices. docs/bake.md.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "bake/charts/contacts.h"
#include "bake/fit_space.h"
#include "core/budget.h"
#include "core/progress.h"
#include "core/unfinished_file.h"
#include "steradian/render.h"
#include "steradian/scene.h"

namespace steradian::bake {

enum class BakedDirect { on, off };
// texture: a map of texels. vertex: values at the vertices of the meshes.
enum class BakeTarget { texture, vertex };

inline constexpr double kLeastTexels = 1e-3, kMostTexels = 1e4;  // a metre

struct BakeOptions {
  double texels = 16;  // a metre; for vertices: that of the places where light is computed, four a texel
  BakedDirect direct = BakedDirect::on;
  BakeTarget target = BakeTarget::texture;
  std::size_t part = 1, parts = 1;  // of a run on several machines: the other parts' texels stay zero
  RenderOptions light;              // bounces, quality, shadows, threads and stop
  WorkFraction progress{};
  UnfinishedFile* unfinished = nullptr;  // keeps what is finished, and has what an earlier run has finished; null: nothing is kept
  std::uint32_t run = 0;                 // number of this map among those that `unfinished` holds
};

struct BakeStats {
  double solve_ms = 0, sample_ms = 0, fit_ms = 0, total_ms = 0;
  std::size_t charts = 0, cut = 0, seams = 0, texels = 0, samples = 0, patches = 0;
  double shadow_fallback = 0;  // as RenderStats
  double mean = 0;             // of the irradiance's luminance over the surfaces
  double rms_residual = 0;     // of the fit over that mean
  double rms_error = 0;        // estimate of the light between surfaces over that mean
  double largest_seam = 0;     // difference between two sides over that mean
};

// The map of one group of lights (light_groups.h).
struct GroupTexels {
  std::string name;
  std::vector<Vec3f> irradiance;
};

// Irradiance [W/m^2 where emission is radiance], with the estimated error of each value.
struct LightMap : MapTexels {
  std::vector<GroupTexels> groups;   // empty: all lights together
  std::vector<CornerLight> corners;  // for vertices: by mesh
  std::vector<Chart> charts;
  // The corners of cut triangles, by mesh and triangle (CutScene); empty for meshes that are as they were.
  std::vector<std::vector<std::array<CutCorner, 3>>> cuts;
  std::vector<std::string> warnings;
};

// Bakes all surfaces that take light. place: the scene's file, for messages. Throws Error for meshes whose charts are broken, and for maps
// beyond the budget. The same scene and options give the same values at any number of threads.
LightMap bake_map(Scene scene, const BakeOptions& options, const std::string& place, Budget& budget, BakeStats* stats = nullptr);

// The charts and the black texels of such a map.
LightMap empty_map(Scene scene, const BakeOptions& options, const std::string& place, Budget& budget);

}  // namespace steradian::bake
