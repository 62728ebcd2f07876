#include "render/direct/irradiance.h"
#include "render/direct/seen_light_pack.h"

STERADIAN_BEGIN_ISA
namespace {

__attribute__((flatten)) void irradiance(const PackLight& light, const Points& points, float* result) {
  PackKernels k;
  for (std::size_t i = 0; i < points.count; i += kLanes) {
    const PackVec3 p = load(points.position, i);
    const SeenLight seen(light, p, i);
    if (!any_lane(seen.lit)) {
      store(result + i, PackReal(0.0));
      continue;
    }
    const auto frame = k.frame_from_normal(load(points.normal, i));
    if (points.fresnel_loss == nullptr) {
      store(result + i, irradiance_of(seen, frame, p));
      continue;
    }
    const PackVec3 e = irradiance_vector(seen, frame, p), view = transform_transposed(frame, load(points.view, i));
    store(result + i, irradiance_below(e, view, fresnel_loss(points, i)));
  }
}

}  // namespace

const IrradianceTable& irradiance_table() {
  static constexpr IrradianceTable table = {irradiance};
  return table;
}

STERADIAN_END_ISA
