#include "render/direct/sheen.h"

#include "integrals/ggx/charlie.h"
#include "render/direct/seen_light_pack.h"

STERADIAN_BEGIN_ISA
namespace {

__attribute__((flatten)) void radiance(const PackLight& light, const Points& points, float* result) {
  PackKernels k;
  integrals::Charlie<Pack> integral;
  for (std::size_t i = 0; i < points.count; i += kLanes) {
    const PackVec3 p = load(points.position, i), n = load(points.normal, i), v = load(points.view, i);
    const SeenLight seen(light, p, i);
    if (!any_lane(seen.lit && dot(n, v) > PackReal(0.0))) {
      store(result + i, PackReal(0.0));
      continue;
    }
    const auto frame = k.frame_from_normal(n);
    integral.alpha = load(points.alpha_x + i);
    // About the normal, and wide: the lobe has no peak for a round light's corners to gather about.
    const AboutLobe lobe = {PackVec3(0.0, 0.0, 1.0), PackReal(1.0), 12};
    store(result + i, integrate(AnyOutline{{seen, frame, p, lobe}}, seen.shading(transform_transposed(frame, v)), integral).x);
  }
}

}  // namespace

const SheenTable& sheen_table() {
  static constexpr SheenTable table = {radiance};
  return table;
}

STERADIAN_END_ISA
