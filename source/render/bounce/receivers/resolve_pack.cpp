#include "render/bounce/receivers/resolve.h"

#include "render/bounce/lobe_pack.h"
#include "render/bounce/receivers/arrays_pack.h"

STERADIAN_BEGIN_ISA
namespace {

__attribute__((flatten)) void run(const indirect::PictureSurfaces& s, const indirect::IncomingLight& light, const LtcPackTables& tables,
                                  int first, int last, indirect::VectorArray& radiance) {
  for (int y = first; y < last; ++y)
    for (int x = 0; x < s.raster.width; x += static_cast<int>(kLanes)) {
      const std::size_t i = s.raster.at(x, y);
      const PackVec3 albedo = load_at(s.albedo, i), diffuse = load_at(light.diffuse, i);
      const PackReal by_pi(0.318309886183790672);
      PackVec3 result(albedo.x * diffuse.x * by_pi, albedo.y * diffuse.y * by_pi, albedo.z * diffuse.z * by_pi);
      const PackVec3 f0 = load_at(s.f0, i), f90 = load_at(s.f90, i);
      if (any_lane(f0.x + f0.y + f0.z + f90.x > PackReal(0.0))) {
        const auto magnitude = look_up_magnitude(tables, sqrt(load(s.alpha.data() + i)), dot(load_at(s.normal, i), load_at(s.view, i)));
        const PackVec3 shine = load_at(light.glossy, i), mean = f0 * magnitude.x + (f90 - f0) * magnitude.y;
        result = result + PackVec3(mean.x * shine.x, mean.y * shine.y, mean.z * shine.z);
      }
      store(radiance.x.data() + i, result.x);
      store(radiance.y.data() + i, result.y);
      store(radiance.z.data() + i, result.z);
    }
}

}  // namespace

const indirect::ResolveTable& resolve_table() {
  static constexpr indirect::ResolveTable table = {run};
  return table;
}

STERADIAN_END_ISA
