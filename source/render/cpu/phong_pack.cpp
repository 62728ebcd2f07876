#include "render/cpu/phong.h"

#include "integrals/phong.h"
#include "render/cpu/polygon_pack.h"

STERADIAN_BEGIN_ISA
namespace {

// A function for each method, so that it holds one walk in registers.
template <class Share>
__attribute__((flatten, noinline)) void radiance_by(const Share& share, const PackLight& light, const ViewedPoints& points, float* result) {
  PackKernels k;
  const SurfacePoints& s = points.surface;
  integrals::Phong<Pack, Share> integral(share);
  for (std::size_t i = 0; i < s.count; i += kLanes) {
    const PackVec3 p(load(s.x + i), load(s.y + i), load(s.z + i));
    const PackVec3 n(load(s.nx + i), load(s.ny + i), load(s.nz + i));
    const PackVec3 v(load(points.vx + i), load(points.vy + i), load(points.vz + i));
    const auto frame = k.frame_from_normal(n);
    const auto shading = SeenLight(light, p).shading(transform_transposed(frame, v));
    store(result + i, integrate(contours_in(light, frame, p), shading, integral).x);
  }
}

void radiance(const PackLight& light, const ViewedPoints& points, double exponent, const PhongOptions& options, float* result) {
  const integrals::PhongLobe<Pack> lobe(exponent, options.relative_precision);
  integrals::with_phong_share<Pack>(lobe, options, [&](const auto& share) { radiance_by(share, light, points, result); });
}

}  // namespace

const PhongTable& phong_table() {
  static constexpr PhongTable table = {radiance};
  return table;
}

STERADIAN_END_ISA
