#include "render/direct/direct.h"
#include "render/direct/seen_light_pack.h"

STERADIAN_BEGIN_ISA
namespace {

using K = PackKernels;

// GGX under a punctual light: the lobe times the incident light. plain: F = 1, fresnel: F = (1 - v.h)^5.
__attribute__((flatten)) void punctual_ggx(const PackLight& light, const Points& points, float* plain, float* fresnel) {
  K k;
  const packed::Punctual& source = *std::get_if<packed::Punctual>(&light.shape);
  for (std::size_t i = 0; i < points.count; i += kLanes) {
    const auto frame = k.frame_from_normal_and_view(load(points.normal, i), load(points.tangent, i));
    const PackVec3 v = transform_transposed(frame, load(points.view, i));
    const auto incident = shapes::incident<Pack>(source, load(points.position, i));
    const PackVec3 l = transform_transposed(frame, incident.direction);
    const PackReal lobe = incident.irradiance * k.ggx_lobe(l, v, load(points.alpha_x + i), load(points.alpha_y + i));
    store(plain + i, lobe);
    store(fresnel + i, lobe * k.fresnel_schlick(PackReal(0.0), PackReal(1.0), dot(v, k.microfacet_half_vector(l, v))));
  }
}

__attribute__((flatten)) void add_diffuse(SurfaceTile& tile, const PackLight* const* lights, std::size_t light_count) {
  K k;
  const Points points = points_of(tile);
  for (std::size_t i = 0; i < kTilePixels; i += kLanes) {
    const PackVec3 albedo = load(arrays_of(tile.albedo), i);
    if (!any_lane(albedo.x + albedo.y + albedo.z > PackReal(0.0))) continue;
    const PackVec3 p = load(points.position, i), n = load(points.normal, i);
    const auto frame = k.frame_from_normal(n);
    const PackVec3 v = load(points.view, i);
    const PackReal loss = fresnel_loss(points, i);
    PackVec3 irradiance(0.0, 0.0, 0.0);
    for (std::size_t l = 0; l < light_count; ++l) {
      const PackLight& light = *lights[l];
      PackReal e(0.0);
      if (const auto* source = std::get_if<packed::Punctual>(&light.shape)) {
        const auto incident = shapes::incident<Pack>(*source, p);
        e = incident.irradiance * max(dot(n, incident.direction), PackReal(0.0));
        if (any_lane(loss > PackReal(0.0))) e = e * (PackReal(1.0) - loss * k.lambert_grazing(incident.direction, v));
      } else if (const SeenLight seen(light, p, i); any_lane(seen.lit)) {
        e = any_lane(loss > PackReal(0.0))
                ? k.lambert_irradiance_below(irradiance_vector(seen, frame, p), transform_transposed(frame, v), loss)
                : irradiance_of(seen, frame, p);
      }
      irradiance = irradiance + broadcast(light.radiance) * e;
    }
    const auto add = [&](TilePlane& plane, PackReal a, PackReal e) {
      store(plane.data() + i, load(plane.data() + i) + a * k.lambert_radiance(e));
    };
    add(tile.radiance.x, albedo.x, irradiance.x);
    add(tile.radiance.y, albedo.y, irradiance.y);
    add(tile.radiance.z, albedo.z, irradiance.z);
  }
}

}  // namespace

const DirectTable& direct_table() {
  static constexpr DirectTable table = {add_diffuse, punctual_ggx};
  return table;
}

STERADIAN_END_ISA
