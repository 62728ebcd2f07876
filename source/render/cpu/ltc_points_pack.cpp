#include "render/cpu/ltc_points.h"
#include "render/cpu/polygon_pack.h"
#include "render/cpu/table_pack.h"

STERADIAN_BEGIN_ISA
namespace {

struct Both {
  PackReal irradiance, integral;
};

// One walk for both lobes: a vertex is brought into the shading frame once, and under M^-1 once.
__attribute__((flatten, noinline)) Both integrate(const SeenLight& seen, const PackKernels::mat3& frame,
                                                  const PackVec3& p, const PackKernels::LtcMatrix& m,
                                                  const PackLobe& lobe) {
  PackKernels k;
  auto diffuse = k.polygon_begin();
  auto glossy = k.ltc_begin();
  PackVec3 a, ta;
  seen.walk(
      frame, p, lobe,
      [&](const PackVec3& v) {
        a = v;
        ta = k.ltc_direction(m, v);
      },
      [&](const PackVec3& b) {
        const PackVec3 tb = k.ltc_direction(m, b);
        diffuse = k.polygon_add_edge(diffuse, a, b);
        glossy = k.ltc_add_edge(glossy, m, a, b, ta, tb);
        a = b;
        ta = tb;
      });
  return {k.polygon_irradiance(diffuse, seen.behind), k.ltc_integral(glossy, seen.behind)};
}

template <class Decode>
STERADIAN_INLINE void run(const PackLight* lights, std::size_t light_count, const SeenPoints& points,
                          const LtcPackTables& tables, const LtcSums& sums, Decode decode) {
  PackKernels k;
  const SurfacePoints& at = points.at;
  const float* matrix = tables.matrix.nodes.data();
  const float* magnitude = tables.magnitude.nodes.data();
  for (std::size_t i = 0; i < at.count; i += kLanes) {
    const PackVec3 p(load(at.x + i), load(at.y + i), load(at.z + i));
    const PackVec3 n(load(at.nx + i), load(at.ny + i), load(at.nz + i));
    const PackVec3 v(load(points.vx + i), load(points.vy + i), load(points.vz + i));
    const PackReal roughness = load(points.roughness + i);
    const auto frame = k.frame_from_normal_and_view(n, v);
    const PackReal c = dot(n, v);
    const PackVec3 view(dot(frame.c0, v), PackReal(0.0), c);
    const auto coordinates = k.ltc_coordinates(roughness, c);
    const auto m = decode(look_up(matrix, tables.matrix.size, coordinates.x, coordinates.y), roughness, view);
    const auto scale = look_up(magnitude, tables.magnitude.size, coordinates.x, coordinates.y);
    const auto seen = c > PackReal(0.0);

    const PackLobe lobe = {PackVec3(-view.x, PackReal(0.0), c), PackReal(2.0) * roughness * roughness, 12};
    PackReal irradiance(0.0), integral(0.0);
    for (std::size_t l = 0; l < light_count; ++l) {
      const SeenLight light(lights[l], p);
      if (!any_lane(light.lit)) continue;
      const Both both = integrate(light, frame, p, m, lobe);
      irradiance += select(light.lit, both.irradiance, PackReal(0.0));
      integral += select(light.lit && seen, both.integral, PackReal(0.0));
    }
    store(sums.irradiance + i, irradiance);
    store(sums.specular + i, scale.x * integral);
    store(sums.grazing + i, scale.y * integral);
  }
}

__attribute__((flatten)) void classic(const PackLight* lights, std::size_t light_count, const SeenPoints& points,
                                      const LtcPackTables& tables, const LtcSums& sums) {
  run(lights, light_count, points, tables, sums,
      [](const PackKernels::vec4& t, PackReal, const PackVec3&) { return PackKernels{}.ltc_from_classic(t); });
}

__attribute__((flatten)) void compact(const PackLight* lights, std::size_t light_count, const SeenPoints& points,
                                      const LtcPackTables& tables, const LtcSums& sums) {
  run(lights, light_count, points, tables, sums, [](const PackKernels::vec4& e, PackReal roughness, const PackVec3& view) {
    return PackKernels{}.ltc_from_compact(e, max(roughness * roughness, PackReal(1.0e-4)), view);
  });
}

}  // namespace

const LtcPackTable& ltc_pack_table() {
  static constexpr LtcPackTable table = {classic, compact};
  return table;
}

STERADIAN_END_ISA
