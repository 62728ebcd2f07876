#include "render/cpu/irradiance.h"
#include "render/cpu/seen_light_pack.h"

STERADIAN_BEGIN_ISA
namespace {

__attribute__((flatten)) void irradiance(const PackLight& light, const Points& points, float* result) {
  PackKernels k;
  for (std::size_t i = 0; i < points.count; i += kLanes) {
    const PackVec3 p = load(points.position, i);
    const SeenLight seen(light, p);
    const bool lit = any_lane(seen.seen.lit);
    store(result + i, lit ? irradiance_vector(seen, k.frame_from_normal(load(points.normal, i)), p).z : PackReal(0.0));
  }
}

}  // namespace

const IrradianceTable& irradiance_table() {
  static constexpr IrradianceTable table = {irradiance};
  return table;
}

STERADIAN_END_ISA
