#include "render/cpu/phong.h"

#include "integrals/phong.h"
#include "render/cpu/seen_light_pack.h"

STERADIAN_BEGIN_ISA
namespace {

// A function for each method, so that it holds one walk in registers.
template <class Share>
__attribute__((flatten, noinline)) void radiance_by(const Share& share, double exponent, const PhongOptions& options,
                                                    const PackLight& light, const Points& points, float* result) {
  PackKernels k;
  integrals::Phong<Pack, Share> integral(share, exponent, options);
  for (std::size_t i = 0; i < points.count; i += kLanes) {
    const PackVec3 p = load(points.position, i), n = load(points.normal, i), v = load(points.view, i);
    const auto frame = k.frame_from_normal(n);
    const SeenLight seen(light, p, i);
    const auto shading = seen.shading(transform_transposed(frame, v));
    const auto r = light.is_pieces() ? integrate(PiecesOutline{seen, frame}, shading, integral)
                                     : integrate(PolygonOutline{{seen, frame, p}}, shading, integral);
    store(result + i, r.x);
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
