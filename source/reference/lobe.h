// Lobe: a material's lobe at one view, for the ground truth. What quadrature integrates and Monte Carlo samples.
#pragma once

#include "steradian/material.h"
#include "steradian/vector.h"

namespace steradian::reference {

// BRDF times cosine in one direction, or an integral of it. Fresnel is linear in its two reflectances, so that two
// scalars carry every colour.
struct LobeValue {
  double plain = 0;    // without Fresnel
  double fresnel = 0;  // the same times (1 - v.h)^5

  friend LobeValue operator+(LobeValue a, LobeValue b) { return {a.plain + b.plain, a.fresnel + b.fresnel}; }
  friend LobeValue operator-(LobeValue a, LobeValue b) { return {a.plain - b.plain, a.fresnel - b.fresnel}; }
  friend LobeValue operator*(LobeValue a, double s) { return {a.plain * s, a.fresnel * s}; }
  LobeValue& operator+=(LobeValue b) { return *this = *this + b; }
};

// A space in which the lobe is round and simple, for an integrator to work in. Never a matter of correctness.
//
// A direction l lies there in the direction of the solution w of x w_x + y w_y + z w_z = l + offset. The offset is zero,
// or the view: w is then a half vector, and a distribution of any two widths is round about (0, 0, 1).
struct LobeShape {
  Vec3d peak;         // the l of w = (0, 0, 1)
  Vec3d x, y, z;      // at most of length 1
  Vec3d offset;
  double width;       // angle from (0, 0, 1) [rad]
  bool long_tailed;   // falls off as a power, not as a Gaussian
};

// Directions are unit and in the shading frame: z the normal, x the tangent of the widths.
class Lobe {
 public:
  Lobe(const Material& material, Vec3d view);

  // 0 where l or the view is not above the surface.
  LobeValue evaluate(Vec3d l) const;

  // A direction with density pdf(l) per solid angle, for u, v in [0, 1). The zero vector: no direction; the density
  // then integrates to less than 1. Directions below the surface occur.
  Vec3d sample(double u, double v) const;
  double pdf(Vec3d l) const;

  // The colour of an integral: albedo, or Schlick's Fresnel.
  Vec3d radiance(LobeValue integral) const { return plain_ * integral.plain + fresnel_ * integral.fresnel; }
  // Largest factor of each of the two scalars in any channel.
  LobeValue largest_factors() const;

  LobeShape shape() const;
  // Relative error of evaluate() per unit of the last place of l and the view.
  double sensitivity() const;
  // Phong's lobe ends on a plane through the point, and not smoothly: its normal. Else the zero vector.
  Vec3d ending_plane() const;
  bool above_surface() const { return view_.z > 0; }

 private:
  Brdf brdf_;
  Vec3d view_;
  double n_, ax_, ay_;
  bool shadowing_;
  Vec3d plain_, fresnel_;
  Vec3d mirror_;
  Frame mirror_frame_;
};

}  // namespace steradian::reference
