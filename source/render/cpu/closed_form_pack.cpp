#include "render/cpu/closed_form.h"

#include "render/cpu/ggx_pack.h"

STERADIAN_BEGIN_ISA
namespace {

// x along the tangent as far as it is perpendicular to the normal; any x where it is not.
PackKernels::mat3 frame_along(const PackVec3& n, const PackVec3& tangent) {
  PackKernels k;
  return k.frame_from_normal_and_view(n, tangent);
}

__attribute__((flatten)) void ggx(const PackLight& light, const GgxPoints& points, Quality quality, float* plain,
                               float* fresnel) {
  PackKernels k;
  const SurfacePoints& surface = points.surface;
  const PackVec3 plane_normal = broadcast(light.plane_normal), plane_point = broadcast(light.plane_point);
  GgxPackWalks walks;
  for (std::size_t i = 0; i < surface.count; i += kLanes) {
    GgxPackPoint at;
    at.position = PackVec3(load(surface.x + i), load(surface.y + i), load(surface.z + i));
    const PackVec3 n(load(surface.nx + i), load(surface.ny + i), load(surface.nz + i));
    const PackVec3 v(load(points.vx + i), load(points.vy + i), load(points.vz + i));
    const PackReal height = dot(at.position - plane_point, plane_normal);
    const auto behind = height < PackReal(0.0);
    const auto seen = height > PackReal(0.0) || (behind && PackReal(light.two_sided ? 1.0 : 0.0) > PackReal(0.5));
    at.lit = seen && dot(n, v) > PackReal(0.0);
    if (!any_lane(at.lit)) {
      store(plain + i, PackReal(0.0));
      store(fresnel + i, PackReal(0.0));
      continue;
    }
    at.frame = frame_along(n, PackVec3(load(points.tx + i), load(points.ty + i), load(points.tz + i)));
    at.view = k.ggx_view(transform_transposed(at.frame, v), load(points.alpha_x + i), load(points.alpha_y + i));
    at.smith = PackReal(1.0);
    at.facing = select(behind, PackReal(-1.0), PackReal(1.0));
    const auto r = ggx_closed_form(light, at, quality, walks);
    store(plain + i, r.x);
    store(fresnel + i, r.y);
  }
}

}  // namespace

const ClosedFormTable& closed_form_table() {
  static constexpr ClosedFormTable table = {ggx};
  return table;
}

STERADIAN_END_ISA
