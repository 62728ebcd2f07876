#include "render/cpu/irradiance.h"
#include "render/cpu/polygon_pack.h"

STERADIAN_BEGIN_ISA
namespace {

__attribute__((flatten)) void irradiance(const PackLight& light, const SurfacePoints& points, float* result) {
  PackKernels k;
  const Vec3f* vertices = light.vertices.data();
  const std::size_t* contours = light.contours.data();
  const std::size_t contour_count = light.contours.size() - 1;
  const PackVec3 plane_normal = broadcast(light.plane_normal), plane_point = broadcast(light.plane_point);
  const bool two_sided = light.two_sided;

  for (std::size_t i = 0; i < points.count; i += kLanes) {
    const PackVec3 p(load(points.x + i), load(points.y + i), load(points.z + i));
    const PackVec3 n(load(points.nx + i), load(points.ny + i), load(points.nz + i));
    const auto height = dot(p - plane_point, plane_normal);
    const auto behind = height < PackReal(0.0);
    const auto lit = two_sided ? !(height <= PackReal(0.0) && height >= PackReal(0.0)) : height > PackReal(0.0);
    if (!any_lane(lit)) {
      store(result + i, PackReal(0.0));
      continue;
    }
    const auto frame = k.frame_from_normal(n);
    auto walk = k.polygon_begin();
    walk_contours(vertices, contours, contour_count, frame, p,
                  [&](const PackVec3& a, const PackVec3& b) { walk = k.polygon_add_edge(walk, a, b); });
    store(result + i, select(lit, k.polygon_irradiance(walk, behind), PackReal(0.0)));
  }
}

}  // namespace

const IrradianceTable& irradiance_table() {
  static constexpr IrradianceTable table = {irradiance};
  return table;
}

STERADIAN_END_ISA
