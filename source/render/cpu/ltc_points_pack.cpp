#include "render/cpu/ltc_points.h"
#include "render/cpu/polygon_pack.h"
#include "render/cpu/table_pack.h"

STERADIAN_BEGIN_ISA
namespace {

struct Both {
  PackReal irradiance, integral;
};

// One walk for both lobes: a vertex is brought into the shading frame once, and under M^-1 once. walk(start, edge) calls
// back as walk_contours does.
template <bool with_diffuse, class Walk>
STERADIAN_INLINE Both integrate(const PackKernels::LtcMatrix& m, const PackKernels::mask& behind, Walk walk) {
  PackKernels k;
  auto diffuse = k.polygon_begin();
  auto glossy = k.ltc_begin();
  PackVec3 a, ta;
  walk(
      [&](const PackVec3& v) {
        a = v;
        ta = k.ltc_direction(m, v);
      },
      [&](const PackVec3& b) {
        const PackVec3 tb = k.ltc_direction(m, b);
        if constexpr (with_diffuse) diffuse = k.polygon_add_edge(diffuse, a, b);
        glossy = k.ltc_add_edge(glossy, m, a, b, ta, tb);
        a = b;
        ta = tb;
      });
  return {with_diffuse ? k.polygon_irradiance(diffuse, behind) : PackReal(0.0), k.ltc_integral(glossy, behind)};
}

// Two functions of their own, so that each holds one walk in registers.
template <bool with_diffuse>
__attribute__((flatten, noinline)) Both integrate_polygon(const SeenLight& seen, const PackKernels::mat3& frame,
                                                          const PackVec3& p, const PackKernels::LtcMatrix& matrix) {
  const PackLight& light = seen.light;
  const PackKernels::LtcMatrix m = matrix;
  return integrate<with_diffuse>(m, seen.behind, [&](auto start, auto edge) {
    walk_contours(light.vertices.data(), light.contours.data(), light.contours.size() - 1, frame, p, start, edge);
  });
}

template <bool with_diffuse>
__attribute__((flatten, noinline)) Both integrate_round(const SeenLight& seen, const PackKernels::mat3& frame,
                                                        const PackVec3& p, const PackKernels::LtcMatrix& matrix, const PackLobe& lobe) {
  const PackKernels::LtcMatrix m = matrix;
  return integrate<with_diffuse>(m, seen.behind, [&](auto start, auto edge) {
    seen.walk_round(frame, p, lobe, start, edge);
  });
}

template <bool with_diffuse, class Decode>
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
      const Both both = light.light.is_round() ? integrate_round<with_diffuse>(light, frame, p, m, lobe)
                                               : integrate_polygon<with_diffuse>(light, frame, p, m);
      irradiance += select(light.lit, both.irradiance, PackReal(0.0));
      integral += select(light.lit && seen, both.integral, PackReal(0.0));
    }
    if (with_diffuse) store(sums.irradiance + i, irradiance);
    store(sums.specular + i, scale.x * integral);
    store(sums.grazing + i, scale.y * integral);
  }
}

__attribute__((flatten)) void classic(const PackLight* lights, std::size_t light_count, const SeenPoints& points,
                                      const LtcPackTables& tables, const LtcSums& sums) {
  const auto decode = [](const PackKernels::vec4& t, PackReal, const PackVec3&) {
    return PackKernels{}.ltc_from_classic(t);
  };
  if (sums.irradiance != nullptr)
    run<true>(lights, light_count, points, tables, sums, decode);
  else
    run<false>(lights, light_count, points, tables, sums, decode);
}

__attribute__((flatten)) void compact(const PackLight* lights, std::size_t light_count, const SeenPoints& points,
                                      const LtcPackTables& tables, const LtcSums& sums) {
  const auto decode = [](const PackKernels::vec4& e, PackReal roughness, const PackVec3& view) {
    return PackKernels{}.ltc_from_compact(e, max(roughness * roughness, PackReal(1.0e-4)), view);
  };
  if (sums.irradiance != nullptr)
    run<true>(lights, light_count, points, tables, sums, decode);
  else
    run<false>(lights, light_count, points, tables, sums, decode);
}

__attribute__((flatten)) void sheen(const PackLight* lights, std::size_t light_count, const SeenPoints& points,
                                    const LtcPackTables& tables, const LtcSums& sums) {
  run<false>(lights, light_count, points, tables, sums, [](const PackKernels::vec4& e, PackReal, const PackVec3&) {
    return PackKernels{}.ltc_from_compact(e, PackReal(1.0), PackVec3(0.0, 0.0, 1.0));
  });
}

}  // namespace

const LtcPackTable& ltc_pack_table() {
  static constexpr LtcPackTable table = {classic, compact, sheen};
  return table;
}

STERADIAN_END_ISA
