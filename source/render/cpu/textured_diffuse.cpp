#include "render/cpu/textured_diffuse.h"

#include "integrals/ltc/textured_light.h"
#include "render/cpu/irradiance.h"

namespace steradian {
namespace {

constexpr float kInversePi = 0.318309886f;

}  // namespace

std::vector<const PackLight*> without_textured(const std::vector<const PackLight*>& lights) {
  std::vector<const PackLight*> plain;
  for (const PackLight* light : lights)
    if (light->textured == nullptr) plain.push_back(light);
  return plain;
}

void add_diffuse_from_textured(SurfaceTile& tile, const std::vector<const PackLight*>& lights) {
  alignas(64) TilePlane irradiance;
  for (const PackLight* light : lights) {
    if (light->textured == nullptr) continue;
    irradiance_table_for(active_simd()).irradiance(*light, points_of(tile), irradiance.data());
    for (std::size_t i = 0; i < kTilePixels; ++i) {
      if (tile.material[i] == nullptr || !(irradiance[i] > 0)) continue;
      const Vec3f albedo{tile.albedo.x[i], tile.albedo.y[i], tile.albedo.z[i]};
      if (!(albedo.x + albedo.y + albedo.z > 0)) continue;
      const Vec3d position{tile.position.x[i], tile.position.y[i], tile.position.z[i]};
      const Vec3d normal = normalized(Vec3d{tile.normal.x[i], tile.normal.y[i], tile.normal.z[i]});
      const Vec3f add = albedo * light->textured->seen_by_diffuse({position, normal, normal}) * (irradiance[i] * kInversePi);
      tile.radiance.x[i] += add.x;
      tile.radiance.y[i] += add.y;
      tile.radiance.z[i] += add.z;
    }
  }
}

}  // namespace steradian
