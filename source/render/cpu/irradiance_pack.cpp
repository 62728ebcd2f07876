#include "render/cpu/irradiance.h"
#include "render/cpu/seen_light_pack.h"

STERADIAN_BEGIN_ISA
namespace {

__attribute__((flatten)) void irradiance(const PackLight& light, const Points& points, float* result) {
  PackKernels k;
  for (std::size_t i = 0; i < points.count; i += kLanes) {
    const PackVec3 p = load(points.position, i);
    const SeenLight seen(light, p);
    if (!any_lane(seen.seen.lit)) {
      store(result + i, PackReal(0.0));
      continue;
    }
    const auto frame = k.frame_from_normal(load(points.normal, i));
    const PackVec3 e = irradiance_vector(seen, frame, p);
    const bool below = points.fresnel_loss != nullptr;
    store(result + i, below ? irradiance_below(e, transform_transposed(frame, load(points.view, i)), fresnel_loss(points, i)) : e.z);
  }
}

}  // namespace

const IrradianceTable& irradiance_table() {
  static constexpr IrradianceTable table = {irradiance};
  return table;
}

STERADIAN_END_ISA
