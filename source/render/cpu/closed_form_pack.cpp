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
  GgxPackWalks walks;
  for (std::size_t i = 0; i < surface.count; i += kLanes) {
    GgxPackPoint at;
    at.position = PackVec3(load(surface.x + i), load(surface.y + i), load(surface.z + i));
    const PackVec3 n(load(surface.nx + i), load(surface.ny + i), load(surface.nz + i));
    const PackVec3 v(load(points.vx + i), load(points.vy + i), load(points.vz + i));
    const SeenLight seen(light, at.position);
    at.lit = seen.lit && dot(n, v) > PackReal(0.0);
    if (!any_lane(at.lit)) {
      store(plain + i, PackReal(0.0));
      store(fresnel + i, PackReal(0.0));
      continue;
    }
    at.frame = frame_along(n, PackVec3(load(points.tx + i), load(points.ty + i), load(points.tz + i)));
    at.view = k.ggx_view(transform_transposed(at.frame, v), load(points.alpha_x + i), load(points.alpha_y + i));
    at.smith = PackReal(1.0);
    at.facing = select(seen.behind, PackReal(-1.0), PackReal(1.0));
    const auto r = ggx_closed_form(seen, at, quality, walks);
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
