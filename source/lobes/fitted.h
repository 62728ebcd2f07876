// Fitted: a table of linearly transformed cosines in the place of GGX, as a lobe of its own. Quadrature and Monte Carlo take it like any
// other lobe, so they judge the method `ltc` with that table.
#pragma once

#include <algorithm>
#include <cmath>

#include "lobes/lobe_parts.h"
#include "lobes/samplers.h"

namespace steradian {
struct ClassicTable;
}

namespace steradian::lobes {

// M^-1 in the frame of normal and view, and the factors of the lobe's integral: all of F = 1, and of F = (1 - v.h)^5.
struct FittedEntry {
  Kernels<double>::LtcMatrix inverse;
  double n_a = 0, f_a = 0;
};

// Reads the table at one view. Its definition stands with the table: integrals/tables/table.cpp.
FittedEntry read_fitted(const ClassicTable& table, double alpha, double cosine);

struct Fitted {
  // The table's own peak and width: a measured lobe need not lie about the mirrored view, nor follow the roughness.
  static LobeAxis axis_and_width(const Material& m, const ShadingPoint& at) {
    const Frame frame = Frame::from_normal(at.normal);
    const Fitted lobe(m, frame.to_local(normalized(at.view)));
    const LobeShape shape = lobe.shape();
    return {frame.to_world(shape.peak), lobe.width()};
  }

  Fitted(const Material& material, Vec3d view)
      : colours{material.f0, material.f90 - material.f0}, entry(read_fitted(*material.fitted, material.alpha_x, view.z)) {
    const double across = std::hypot(view.x, view.y);
    if (across > 0) toward = {view.x / across, view.y / across, 0};
    const auto& m = entry.inverse;
    // M, from M^-1, whose determinant is positive.
    const double minor = (m.xx * m.zz - m.xz * m.zx).v;
    x = {m.zz.v / minor, 0, -m.zx.v / minor};
    y = {0, 1 / m.yy.v, 0};
    z = {-m.xz.v / minor, 0, m.xx.v / minor};
  }

  LobeValue evaluate(Vec3d l) const {
    const double density = pdf(l);
    return {entry.n_a * density, entry.f_a * density};
  }
  Vec3d sample(double u, double v) const {
    const Vec3d w = sample_cosine_hemisphere(u, v);
    return normalized(from_plane_of_view(x * w.x + y * w.y + z * w.z));
  }
  double pdf(Vec3d l) const { return Kernels<double>().ltc_lobe(entry.inverse, to_kernel(to_plane_of_view(l))).v; }

  // Under M^-1, the lobe is a cosine about z.
  LobeShape shape() const {
    const double longest = std::max({length(x), length(y), length(z)});
    const auto axis = [&](Vec3d v) { return from_plane_of_view(v / longest); };
    return {normalized(from_plane_of_view(z)), axis(x), axis(y), axis(z), {}, 1.0, false};
  }
  // x and z are in one plane; only x across z widens the lobe.
  double width() const { return std::min({length(cross(x, z)) / dot(z, z), length(y) / length(z), 1.0}); }
  // The fourth power of |M^-1 l| has the condition of M^-1.
  double sensitivity() const {
    const auto& m = entry.inverse;
    const double rows = std::sqrt((m.xx * m.xx + m.xz * m.xz + m.yy * m.yy + m.zx * m.zx + m.zz * m.zz).v);
    return 1 + 4 * rows * std::max({length(x), length(y), length(z)});
  }
  // The cosine under M^-1 ends at its horizon.
  std::array<Vec3d, 2> ending_planes() const {
    return {normalized(from_plane_of_view({entry.inverse.zx.v, 0, entry.inverse.zz.v})), Vec3d{}};
  }

  Colours colours;

 private:
  Vec3d to_plane_of_view(Vec3d l) const { return {l.x * toward.x + l.y * toward.y, l.y * toward.x - l.x * toward.y, l.z}; }
  Vec3d from_plane_of_view(Vec3d l) const { return {l.x * toward.x - l.y * toward.y, l.x * toward.y + l.y * toward.x, l.z}; }

  FittedEntry entry;
  Vec3d toward{1, 0, 0};  // the view's direction along the surface
  Vec3d x, y, z;          // columns of M
};

}  // namespace steradian::lobes
