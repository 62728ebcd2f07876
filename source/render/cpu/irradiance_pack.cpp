#include "render/cpu/irradiance.h"
#include "render/cpu/polygon_pack.h"

STERADIAN_BEGIN_ISA
namespace {

__attribute__((flatten)) void irradiance(const PackLight& light, const SurfacePoints& points, float* result) {
  PackKernels k;
  for (std::size_t i = 0; i < points.count; i += kLanes) {
    const PackVec3 p(load(points.x + i), load(points.y + i), load(points.z + i));
    const PackVec3 n(load(points.nx + i), load(points.ny + i), load(points.nz + i));
    const SeenLight seen(light, p);
    store(result + i, any_lane(seen.lit) ? area_light_irradiance(seen, k.frame_from_normal(n), p) : PackReal(0.0));
  }
}

}  // namespace

const IrradianceTable& irradiance_table() {
  static constexpr IrradianceTable table = {irradiance};
  return table;
}

STERADIAN_END_ISA
