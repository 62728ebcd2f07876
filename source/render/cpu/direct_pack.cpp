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

STERADIAN_INLINE PackReal polygon_light(const PackLight& light, const Receiver& at) {
  K k;
  const PackReal height = dot(at.position - broadcast(light.plane_point), broadcast(light.plane_normal));
  const PackMask behind = height < PackReal(0.0);
  const PackMask lit = light.two_sided ? behind || height > PackReal(0.0) : height > PackReal(0.0);
  if (!any_lane(lit)) return 0.0;
  auto walk = k.polygon_begin();
  walk_contours(light.vertices.data(), light.contours.data(), light.contours.size() - 1, at.frame, at.position,
                [&](const PackVec3& a, const PackVec3& b) { walk = k.polygon_add_edge(walk, a, b); });
  return select(lit, k.polygon_irradiance(walk, behind), PackReal(0.0));
}

// The outline as a polygon of equal area. 64 vertices leave 4e-4 of the irradiance at worst (docs/accuracy.md).
constexpr int kOutlineVertices = 64;
struct OutlineTable {
  float cosine[kOutlineVertices], sine[kOutlineVertices];
};
// The factor on the vertices that gives a regular polygon the area of its circle.
constexpr double kOutlineScale = 1.0008042;  // sqrt(2 pi / (64 sin(2 pi / 64)))

STERADIAN_INLINE PackReal ellipsoid_light(const PackLight& light, const OutlineTable& table, const Receiver& at) {
  K k;
  const K::mat3 s(broadcast(light.axis_x), broadcast(light.axis_y), broadcast(light.axis_z));
  // Columns of the inverse, from its rows.
  const K::mat3 inverse(PackVec3(broadcast(light.unit_x.x), broadcast(light.unit_y.x), broadcast(light.unit_z.x)),
                        PackVec3(broadcast(light.unit_x.y), broadcast(light.unit_y.y), broadcast(light.unit_z.y)),
                        PackVec3(broadcast(light.unit_x.z), broadcast(light.unit_y.z), broadcast(light.unit_z.z)));
  const auto outline = k.ellipsoid_outline(broadcast(light.center) - at.position, s, inverse);
  if (!any_lane(outline.outside)) return 0.0;
  const PackVec3 c = transform_transposed(at.frame, outline.center);
  const PackVec3 a = transform_transposed(at.frame, outline.axis_a) * PackReal(kOutlineScale);
  const PackVec3 b = transform_transposed(at.frame, outline.axis_b) * PackReal(kOutlineScale);
  const PackMask reversed = dot(c, cross(a, b)) < PackReal(0.0);
  const auto vertex = [&](int i) {
    return k.polygon_direction(c + a * broadcast(table.cosine[i]) + b * broadcast(table.sine[i]));
  };
  auto walk = k.polygon_begin();
  PackVec3 previous = vertex(kOutlineVertices - 1);
  for (int i = 0; i < kOutlineVertices; ++i) {
    const PackVec3 next = vertex(i);
    walk = k.polygon_add_edge(walk, previous, next);
    previous = next;
  }
  return select(outline.outside, k.polygon_irradiance(walk, reversed), PackReal(0.0));
}

// Point, spot and directional lights: intensity over distance squared times cosine (KHR_lights_punctual).
STERADIAN_INLINE PackReal punctual_light(const PackLight& light, const Receiver& at) {
  if (light.kind == PackLight::Kind::directional)
    return max(-dot(at.normal, broadcast(light.direction)), PackReal(0.0));
  const PackVec3 to = broadcast(light.position) - at.position;
  const PackReal d2 = max(dot(to, to), PackReal(1e-12));
  const PackReal inverse = inversesqrt(d2);
  PackReal e = max(dot(at.normal, to) * inverse, PackReal(0.0)) / d2;
  if (light.inverse_range2 > 0) {
    const PackReal q = d2 * broadcast(light.inverse_range2);
    e = e * clamp(PackReal(1.0) - q * q, PackReal(0.0), PackReal(1.0));
  }
  if (light.kind == PackLight::Kind::spot) {
    const PackReal cosine = -dot(broadcast(light.direction), to) * inverse;
    const PackReal f =
        clamp(cosine * broadcast(light.spot_scale) + broadcast(light.spot_offset), PackReal(0.0), PackReal(1.0));
    e = e * f * f;
  }
  return e;
}

__attribute__((flatten)) void add_diffuse(SurfaceTile& tile, const PackLight* const* lights, std::size_t light_count) {
  K k;
  // cos and sin of the outline's vertices, by turning one step at a time in double.
  OutlineTable table;
  const double step_cosine = 0.99518472667219693, step_sine = 0.098017140329560604;  // of 2 pi / 64
  double c = 1, s = 0;
  for (int i = 0; i < kOutlineVertices; ++i) {
    table.cosine[i] = static_cast<float>(c);
    table.sine[i] = static_cast<float>(s);
    const double next = c * step_cosine - s * step_sine;
    s = c * step_sine + s * step_cosine;
    c = next;
  }
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
      const PackReal e = light.kind == PackLight::Kind::polygon     ? polygon_light(light, at)
                         : light.kind == PackLight::Kind::ellipsoid ? ellipsoid_light(light, table, at)
                                                                    : punctual_light(light, at);
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
  static constexpr DirectTable table = {add_diffuse};
  return table;
}

STERADIAN_END_ISA
