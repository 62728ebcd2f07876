#include "integrals/tables/table.h"

#include "integrals/tables/table_lookup.h"
#include "steradian/material.h"  // alpha_from_roughness

namespace steradian {

LtcValue ClassicTable::look_up(double roughness, double cos_theta) const {
  const auto s = ltc_stencil<double>(roughness, cos_theta, size);
  const auto m = interpolate<double>(matrix, s), f = interpolate<double>(magnitude, s);
  if (normalisation == ClassicNormalisation::last) return {{m.x.v, m.z.v, m.w.v, m.y.v, 1.0}, f.x.v, f.y.v};
  return {{m.x.v, m.z.v, 1.0, m.y.v, m.w.v}, f.x.v, f.y.v};
}

CompactTable::Entry CompactTable::entry(double roughness, double cos_theta) const {
  const auto e = interpolate<double>(shapes, ltc_stencil<double>(roughness, cos_theta, shape_size));
  const auto f = interpolate<double>(magnitudes, ltc_stencil<double>(roughness, cos_theta, magnitude_size));
  return {{e.x.v, e.y.v, e.z.v, e.w.v}, f.x.v, f.y.v};
}

LtcValue CompactTable::look_up(double roughness, double cos_theta) const {
  const Entry e = entry(roughness, cos_theta);
  const Vec3d view = view_from_cosine(cos_theta);
  return {ltc_inverse(e.shape, frame, alpha_from_roughness(roughness), view), e.n_a, e.f_a};
}

}  // namespace steradian
