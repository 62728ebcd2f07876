#include "render/direct/comparison.h"

#include "integrals/ggx/ltc.h"
#include "integrals/ggx/representative_point.h"
#include "render/direct/seen_light_pack.h"
#include "render/direct/table_pack.h"

STERADIAN_BEGIN_ISA
namespace {

// integral_at(i, view): the integral for the points from i on, whose view is (s, 0, c).
template <class IntegralAt>
__attribute__((flatten)) void radiance(const PackLight& light, const Points& points, IntegralAt integral_at, float* plain, float* fresnel) {
  PackKernels k;
  for (std::size_t i = 0; i < points.count; i += kLanes) {
    const PackVec3 p = load(points.position, i), n = load(points.normal, i), v = load(points.view, i);
    const SeenLight seen(light, p, i);
    integrals::Part<Pack> r{PackReal(0.0), PackReal(0.0)};
    if (any_lane(seen.lit && dot(n, v) > PackReal(0.0))) {
      const auto frame = k.frame_from_normal_and_view(n, v);
      const PackReal c = dot(n, v);
      const PackVec3 view(dot(frame.c0, v), PackReal(0.0), c);
      const AboutLobe about = {PackVec3(-view.x, PackReal(0.0), c), PackReal(2.0) * load(points.alpha_x + i), 12};
      auto integral = integral_at(i, view);
      r = integrate(AnyOutline{{seen, frame, p, about}}, seen.shading(view), integral);
    }
    store(plain + i, r.x);
    store(fresnel + i, r.y);
  }
}

void clipless(const PackLight& light, const Points& points, const LtcPackTables& classic, float* plain, float* fresnel) {
  const auto integral_at = [&](std::size_t i, const PackVec3& view) {
    PackKernels k;
    const auto at = k.ltc_coordinates(sqrt(load(points.alpha_x + i)), view.z);
    const auto look = [&](const PackTable& t) { return look_up(t.nodes.data(), t.size, at.x, at.y); };
    const auto scale = look(classic.magnitude);
    return integrals::CliplessLtc<Pack>({k.ltc_from_classic(look(classic.matrix)), scale.x, scale.y});
  };
  radiance(light, points, integral_at, plain, fresnel);
}

void representative_point(const PackLight& light, const Points& points, float* plain, float* fresnel) {
  const auto integral_at = [&](std::size_t i, const PackVec3&) { return integrals::RepresentativePoint<Pack>(load(points.alpha_x + i)); };
  radiance(light, points, integral_at, plain, fresnel);
}

}  // namespace

const ComparisonTable& comparison_table() {
  static constexpr ComparisonTable table = {clipless, representative_point};
  return table;
}

STERADIAN_END_ISA
