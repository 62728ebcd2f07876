#include "integrals/ggx/ltc_shape.h"

#include <algorithm>
#include <cmath>

#include "steradian/kernels.h"

namespace steradian {

Vec3d view_from_cosine(double cos_theta) { return {std::sqrt(std::max(1 - cos_theta * cos_theta, 0.0)), 0, cos_theta}; }

LtcInverse ltc_inverse(const LtcShape& s, LobeFrame frame, double alpha, Vec3d view) {
  const bool mirror = frame == LobeFrame::mirror;
  Kernels<double>::vec4 e;
  e.x = s.e00, e.y = s.e11, e.z = s.e02, e.w = s.e20;
  const Vec3d v = mirror ? view : Vec3d{0, 0, 1};
  const auto m = Kernels<double>{}.ltc_from_compact(e, mirror ? alpha : 1.0, {v.x, v.y, v.z});
  return {m.xx.v, m.xz.v, m.yy.v, m.zx.v, m.zz.v};
}

double ltc_evaluate(const LtcInverse& m, Vec3d l) {
  Kernels<double>::LtcMatrix k;
  k.xx = m.xx, k.xz = m.xz, k.yy = m.yy, k.zx = m.zx, k.zz = m.zz;
  return Kernels<double>{}.ltc_lobe(k, {l.x, l.y, l.z}).v;
}

double ltc_above_horizon(const LtcInverse& m) { return 0.5 + 0.5 * m.xx / std::hypot(m.xx, m.zx); }

}  // namespace steradian
