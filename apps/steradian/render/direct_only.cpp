#include "render/direct_only.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <vector>

#include "core/lattices.h"
#include "render/surface/rough_glass.h"

namespace steradian::app {
namespace {

constexpr std::size_t kPoints = 256;
constexpr double kMatters = 0.05;

struct SampledPatch {
  Vec3d position, normal;
  double albedo = 0;
};

struct SampledFacet {
  Vec3d corner, e1, e2, normal;
  double area = 0, albedo = 0;
};

// Calls use(facet) for the triangles that do not shine.
template <class Use>
void for_each_facet(const Scene& scene, Use use) {
  for (const Mesh& mesh : scene.meshes) {
    const SurfaceMaterial& m = scene.materials[static_cast<std::size_t>(mesh.material)];
    if (mesh.is_light_shape || m.unlit) continue;
    const double albedo = luminance(Vec3d{m.base_color.x, m.base_color.y, m.base_color.z}) * (1 - static_cast<double>(m.transmission));
    for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
      if (mesh.is_emitter() && mesh.triangle_lights[t] >= 0) continue;
      const auto at = [&](std::size_t c) { return static_cast<Vec3d>(mesh.positions[mesh.indices[3 * t + c]]); };
      const Vec3d a = at(0), e1 = at(1) - a, e2 = at(2) - a, n = cross(e1, e2);
      if (length(n) > 0) use(SampledFacet{a, e1, e2, normalized(n), length(n) / 2, albedo});
    }
  }
}

// Points at even steps of the area, each at the next place of a sequence that is even over the unit square, folded into its triangle.
std::vector<SampledPatch> patches_of(const Scene& scene, double total) {
  std::vector<SampledPatch> patches;
  double before = 0;
  for_each_facet(scene, [&](const SampledFacet& f) {
    before += f.area;
    while (patches.size() < kPoints && (static_cast<double>(patches.size()) + 0.5) * total < before * static_cast<double>(kPoints)) {
      const auto i = static_cast<double>(patches.size() + 1);
      auto [u, v] = r2_place(i);
      if (u + v > 1) u = 1 - u, v = 1 - v;
      patches.push_back({f.corner + f.e1 * u + f.e2 * v, f.normal, f.albedo});
    }
  });
  return patches;
}

}  // namespace

bool may_focus_light(const Scene& scene) {
  return std::any_of(scene.meshes.begin(), scene.meshes.end(), [&](const Mesh& mesh) {
    const SurfaceMaterial& m = scene.materials[static_cast<std::size_t>(mesh.material)];
    return !mesh.is_light_shape && m.solid && m.transmission > 0;
  });
}

double light_between_surfaces(const Scene& scene) {
  double total = 0;
  for_each_facet(scene, [&](const SampledFacet& f) { total += f.area; });
  const std::vector<SampledPatch> patches = patches_of(scene, total);
  if (patches.empty()) return 0;
  const double area = total / static_cast<double>(patches.size());
  double sum = 0;
  for (const SampledPatch& to : patches)
    for (const SampledPatch& from : patches) {
      const Vec3d way = from.position - to.position;
      const double d2 = dot(way, way);
      // The form factor of a disk of that area, which stays below 1 where the two are near.
      const double cosines = d2 > 0 ? std::max(dot(way, to.normal), 0.0) * std::max(-dot(way, from.normal), 0.0) / d2 : 0;
      sum += from.albedo * cosines * area / (std::numbers::pi * d2 + area);
    }
  return sum / static_cast<double>(patches.size());
}

void say_direct_only(const Scene& scene, const RenderOptions& options) {
  if (may_focus_light(scene)) fmt::print(stderr, "steradian: no caustics: light comes straight through solids of glass\n");
  if (options.bounces != 0) return;
  const bool rough_glass = std::any_of(scene.meshes.begin(), scene.meshes.end(), [&](const Mesh& mesh) {
    return RoughGlass::may_blur(scene.materials[static_cast<std::size_t>(mesh.material)]);
  });
  if (rough_glass) fmt::print(stderr, "steradian: rough glass shows a sharp image: --bounces all blurs it\n");
  if (options.indirect.mode != IndirectMode::off || light_between_surfaces(scene) < kMatters) return;
  fmt::print(stderr, "steradian: direct light only, without what surfaces send to each other: --bounces all adds it\n");
}

}  // namespace steradian::app
