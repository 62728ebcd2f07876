#include "render/frame/uneven_diffuse.h"

#include <optional>

#include "integrals/textured/profiled_light.h"
#include "integrals/textured/textured_light.h"
#include "render/direct/lobe_packs.h"
#include "render/direct/profiled_means.h"
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

PlaneRegion visible_region(const PackLight& light, std::size_t slot, Vec3d position) {
  PlaneRegion region;
  const auto coordinates = [&](Vec3d place) -> Vec2d {
    if (light.profiled != nullptr) return light.profiled->coordinates_of(place);
    const FilteredTexture& texture = light.textured->texture();
    const Vec3d d = place - texture.origin();
    return {dot(d, texture.axis_x()), dot(d, texture.axis_y())};
  };
  const PreparedPolygon part = std::get<packed::Pieces>(light.shape).light_of(slot, position, {0, 0, 1});
  for (std::size_t i = 0; i + 1 < part.vertices.size(); i += 2)
    region.add(coordinates(part.vertices[i]), coordinates(part.vertices[i + 1]));
  return region;
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
    alignas(64) TilePlane found, candela;
    found.fill(0);
    const bool on_packs = light->profiled != nullptr && light->profiled->table() != nullptr && !light->is_pieces();
    if (on_packs)
      profiled_means_table_for(active_simd()).diffuse(*light->profiled, points, irradiance.data(), {candela.data(), found.data()});
    if (light->textured != nullptr && !light->is_pieces())
      textured_means_table_for(active_simd())
          .diffuse(*light->textured, points, irradiance.data(), {seen.x.data(), seen.y.data(), seen.z.data(), found.data()});
    for (std::size_t i = 0; i < kTilePixels; ++i) {
      if (tile.material[i] == nullptr || !(irradiance[i] > 0)) continue;
      const Vec3f albedo{tile.albedo.x[i], tile.albedo.y[i], tile.albedo.z[i]};
      if (!(albedo.x + albedo.y + albedo.z > 0)) continue;
      const Vec3d position{tile.position.x[i], tile.position.y[i], tile.position.z[i]};
      const Vec3d normal = normalized(Vec3d{tile.normal.x[i], tile.normal.y[i], tile.normal.z[i]});
      const ShadingPoint at = {position, normal, normal};
      const auto mean_of = [&]() -> Vec3f {
        if (found[i] > 0)
          return on_packs ? static_cast<Vec3f>(light->profiled->radiance_of(static_cast<double>(candela[i]))) : get(seen, i);
        const double integral = static_cast<double>(above[i] * kInversePi);
        if (!light->is_pieces())
          return light->textured != nullptr ? light->textured->seen_by_diffuse(at, TextureWay::look_up)
                                            : static_cast<Vec3f>(light->profiled->seen_by({}, at, integral));
        if (light->profiled != nullptr)
          if (const std::optional<Vec3d> even = light->profiled->even_radiance(position)) return static_cast<Vec3f>(*even);
        const PlaneRegion visible = visible_region(*light, i, position);
        if (light->textured != nullptr) return light->textured->seen_by_diffuse(at, visible);
        return static_cast<Vec3f>(light->profiled->seen_in_part({}, at, integral, visible));
      };
      const Vec3f mean = mean_of();
      const Vec3f add = albedo * mean * (irradiance[i] * kInversePi);
      tile.radiance.x[i] += add.x;
      tile.radiance.y[i] += add.y;
      tile.radiance.z[i] += add.z;
    }
  }
}

}  // namespace steradian
