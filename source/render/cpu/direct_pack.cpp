#include "render/cpu/direct.h"
#include "render/cpu/polygon_pack.h"

STERADIAN_BEGIN_ISA
namespace {

using K = PackKernels;
using PackMask = K::mask;

struct Receiver {
  PackVec3 position, normal;
  K::mat3 frame;
};

STERADIAN_INLINE PackVec3 load_vector(const TileVector& v, std::size_t i) {
  return {load(v.x.data() + i), load(v.y.data() + i), load(v.z.data() + i)};
}

// Point, spot and directional lights: intensity over distance squared times cosine (KHR_lights_punctual).
// Irradiance across the direction to a punctual light, and that unit direction.
struct PunctualIncident {
  PackReal irradiance;
  PackVec3 direction;
};
STERADIAN_INLINE PunctualIncident punctual_incident(const PackLight& light, const PackVec3& p) {
  if (light.kind == PackLight::Kind::directional) return {PackReal(1.0), -broadcast(light.direction)};
  const PackVec3 to = broadcast(light.position) - p;
  const PackReal d2 = max(dot(to, to), PackReal(1e-12));
  const PackVec3 direction = to * inversesqrt(d2);
  PackReal e = PackReal(1.0) / d2;
  if (light.inverse_range2 > 0) {
    const PackReal q = d2 * broadcast(light.inverse_range2);
    e = e * clamp(PackReal(1.0) - q * q, PackReal(0.0), PackReal(1.0));
  }
  if (light.kind == PackLight::Kind::spot) {
    const PackReal cosine = -dot(broadcast(light.direction), direction);
    const PackReal f =
        clamp(cosine * broadcast(light.spot_scale) + broadcast(light.spot_offset), PackReal(0.0), PackReal(1.0));
    e = e * f * f;
  }
  return {e, direction};
}

STERADIAN_INLINE PackReal punctual_irradiance(const PackLight& light, const PackVec3& p, const PackVec3& n) {
  const PunctualIncident incident = punctual_incident(light, p);
  return incident.irradiance * max(dot(n, incident.direction), PackReal(0.0));
}

// GGX under a point: the lobe times the incident light. plain: F = 1, fresnel: F = (1 - v.h)^5.
__attribute__((flatten)) void punctual_ggx(const PackLight& light, const GgxPoints& points, float* plain, float* fresnel) {
  K k;
  const SurfacePoints& s = points.surface;
  for (std::size_t i = 0; i < s.count; i += kLanes) {
    const PackVec3 p(load(s.x + i), load(s.y + i), load(s.z + i));
    const PackVec3 n(load(s.nx + i), load(s.ny + i), load(s.nz + i));
    const PackVec3 tangent(load(points.tx + i), load(points.ty + i), load(points.tz + i));
    const auto frame = k.frame_from_normal_and_view(n, tangent);
    const PackVec3 v = transform_transposed(frame, PackVec3(load(points.vx + i), load(points.vy + i), load(points.vz + i)));
    const PunctualIncident incident = punctual_incident(light, p);
    const PackVec3 l = transform_transposed(frame, incident.direction);
    const PackReal lobe = incident.irradiance * k.ggx_lobe(l, v, load(points.alpha_x + i), load(points.alpha_y + i));
    store(plain + i, lobe);
    store(fresnel + i, lobe * k.fresnel_schlick(PackReal(0.0), PackReal(1.0), dot(v, k.microfacet_half_vector(l, v))));
  }
}

__attribute__((flatten)) void add_diffuse(SurfaceTile& tile, const PackLight* const* lights, std::size_t light_count) {
  K k;
  for (std::size_t i = 0; i < kTilePixels; i += kLanes) {
    const PackVec3 albedo = load_vector(tile.albedo, i);
    if (!any_lane(albedo.x + albedo.y + albedo.z > PackReal(0.0))) continue;
    Receiver at;
    at.position = load_vector(tile.position, i);
    at.normal = load_vector(tile.normal, i);
    at.frame = k.frame_from_normal(at.normal);
    PackVec3 irradiance(0.0, 0.0, 0.0);
    for (std::size_t l = 0; l < light_count; ++l) {
      const PackLight& light = *lights[l];
      PackReal e(0.0);
      if (light.is_area()) {
        const SeenLight seen(light, at.position);
        if (any_lane(seen.lit)) e = area_light_irradiance(seen, at.frame, at.position);
      } else {
        e = punctual_irradiance(light, at.position, at.normal);
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
