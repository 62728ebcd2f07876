#include "render/direct/closed_form.h"

#include "integrals/ggx/ggx.h"
#include "render/direct/seen_light_pack.h"

STERADIAN_BEGIN_ISA
namespace {

__attribute__((flatten)) void ggx(const PackLight& light, const Points& points, Quality quality, float* plain, float* fresnel) {
  PackKernels k;
  integrals::Ggx<Pack> integral;
  integral.quality = quality;
  for (std::size_t i = 0; i < points.count; i += kLanes) {
    const PackVec3 p = load(points.position, i), n = load(points.normal, i), v = load(points.view, i);
    const SeenLight seen(light, p, i);
    if (!any_lane(seen.lit && dot(n, v) > PackReal(0.0))) {
      store(plain + i, PackReal(0.0));
      store(fresnel + i, PackReal(0.0));
      continue;
    }
    // x is the part of the tangent that is perpendicular to the normal, or any direction if there is none.
    const auto frame = k.frame_from_normal_and_view(n, load(points.tangent, i));
    const PackVec3 view = transform_transposed(frame, v);
    integral.alpha_x = load(points.alpha_x + i);
    integral.alpha_y = load(points.alpha_y + i);
    const AboutLobe lobe = {k.phong_mirror(view), PackReal(2.0) * max(integral.alpha_x, integral.alpha_y),
                            quality == Quality::high ? 16 : 12};
    const auto r = integrate(AnyOutline{{seen, frame, p, lobe}}, seen.shading(view), integral);
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
