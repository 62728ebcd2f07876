#include "render/cpu/phong.h"

#include "integrals/phong.h"
#include "render/cpu/seen_light_pack.h"

STERADIAN_BEGIN_ISA
namespace {

// Corners of a round light gather about the mirrored view.
template <class Integral>
STERADIAN_INLINE auto integrate_outline(const PackLight& light, const SeenLight& seen, const PackKernels::mat3& frame, const PackVec3& p,
                                        const PackVec3& view, double exponent, Integral& integral) {
  const auto shading = seen.shading(view);
  if (light.is_pieces()) return integrate(PiecesOutline{seen, frame}, shading, integral);
  if (!light.is_round()) return integrate(PolygonOutline{{seen, frame, p}}, shading, integral);
  const AboutLobe about = {PackKernels().phong_mirror(view), PackReal(1 / std::sqrt(exponent + 1)), 12};
  return integrate(RoundOutline{seen, frame, p, about}, shading, integral);
}

// Each method has a function, so that it holds one walk in registers.
template <class Share>
__attribute__((flatten, noinline)) void radiance_by(const Share& share, double exponent, const PhongOptions& options,
                                                    const PackLight& light, const Points& points, float* result) {
  PackKernels k;
  integrals::Phong<Pack, Share> integral(share, exponent, options);
  for (std::size_t i = 0; i < points.count; i += kLanes) {
    const PackVec3 p = load(points.position, i), n = load(points.normal, i), v = load(points.view, i);
    const auto frame = k.frame_from_normal(n);
    const SeenLight seen(light, p, i);
    const PackVec3 view = transform_transposed(frame, v);
    store(result + i, integrate_outline(light, seen, frame, p, view, exponent, integral).x);
  }
}

void radiance(const PackLight& light, const Points& points, double exponent, const PhongOptions& options, float* result) {
  const integrals::PhongLobe<Pack> lobe(exponent, options);
  integrals::with_phong_share<Pack>(lobe, options,
                                    [&](const auto& share) { radiance_by(share, exponent, options, light, points, result); });
}

}  // namespace

const PhongTable& phong_table() {
  static constexpr PhongTable table = {radiance};
  return table;
}

STERADIAN_END_ISA
