#include "render/frame/uneven_diffuse.h"

#include "integrals/textured/profiled_light.h"
#include "integrals/textured/textured_light.h"
#include "render/direct/lobe_packs.h"
#include "render/direct/textured_means.h"

namespace steradian {
namespace {

constexpr float kInversePi = 0.318309886f;

}  // namespace

std::vector<const PackLight*> even_ones(const std::vector<const PackLight*>& lights) {
  std::vector<const PackLight*> plain;
  for (const PackLight* light : lights)
    if (light->is_even()) plain.push_back(light);
  return plain;
}

void add_diffuse_from_uneven(SurfaceTile& tile, const std::vector<const PackLight*>& lights) {
  alignas(64) TilePlane irradiance, above;  // above: without the boundary, which the lobe of a profile's mean lacks
  for (const PackLight* light : lights) {
    if (light->is_even()) continue;
    const Points points = points_of(tile);
    const auto diffuse = lobe_packs_for(active_simd())[methods::Procedure::diffuse];
    diffuse(*light, points, {}, {irradiance.data()});
    if (light->profiled != nullptr) {
      Points without_boundary = points;
      without_boundary.fresnel_loss = nullptr;
      diffuse(*light, without_boundary, {}, {above.data()});
    }
    TileVector seen;
    alignas(64) TilePlane found;
    found.fill(0);
    if (light->textured != nullptr)
      textured_means_table_for(active_simd())
          .diffuse(*light->textured, points, irradiance.data(), {seen.x.data(), seen.y.data(), seen.z.data(), found.data()});
    for (std::size_t i = 0; i < kTilePixels; ++i) {
      if (tile.material[i] == nullptr || !(irradiance[i] > 0)) continue;
      const Vec3f albedo{tile.albedo.x[i], tile.albedo.y[i], tile.albedo.z[i]};
      if (!(albedo.x + albedo.y + albedo.z > 0)) continue;
      const Vec3d position{tile.position.x[i], tile.position.y[i], tile.position.z[i]};
      const Vec3d normal = normalized(Vec3d{tile.normal.x[i], tile.normal.y[i], tile.normal.z[i]});
      const ShadingPoint at = {position, normal, normal};
      const Vec3f mean = found[i] > 0 ? Vec3f{seen.x[i], seen.y[i], seen.z[i]}
                         : light->textured != nullptr
                             ? light->textured->seen_by_diffuse(at, TextureWay::look_up)
                             : static_cast<Vec3f>(light->profiled->seen_by({}, at, static_cast<double>(above[i] * kInversePi)));
      const Vec3f add = albedo * mean * (irradiance[i] * kInversePi);
      tile.radiance.x[i] += add.x;
      tile.radiance.y[i] += add.y;
      tile.radiance.z[i] += add.z;
    }
  }
}

}  // namespace steradian
