// Parts that lobes of every kind share.
#pragma once

#include <array>

#include "lobes/keys.h"
#include "steradian/kernels.h"
#include "steradian/material.h"
#include "steradian/vector.h"

namespace steradian::lobes {

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

// Factors of the two scalars, one number a channel.
struct Colours {
  Vec3d plain{1, 1, 1}, fresnel{0, 0, 0};
};

// A space in which the lobe is round and simple, for an integrator to work in. It never affects correctness.
//
// A direction l lies there in the direction of the solution w of x w_x + y w_y + z w_z = l + offset. The offset is zero or the view. With
// the view, w is a half vector, and a distribution of any two widths is round about (0, 0, 1).
struct LobeShape {
  Vec3d peak;     // the l of w = (0, 0, 1)
  Vec3d x, y, z;  // at most of length 1
  Vec3d offset;
  double width;      // angle from (0, 0, 1) [rad]
  bool long_tailed;  // falls off as a power, not as a Gaussian
};

// A shape about the normal, as wide as the hemisphere.
inline LobeShape shape_about_normal() { return {{0, 0, 1}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {}, 1.0, false}; }

// A round shape about an axis.
inline LobeShape shape_about(Vec3d axis, double width) {
  const Frame f = Frame::from_normal(axis);
  return {axis, f.x, f.y, axis, {}, width, false};
}

// A shape that is round in half vectors after the widths are taken out.
inline LobeShape shape_of_half_vectors(Vec3d view, double ax, double ay, bool long_tailed) {
  const double width = ax > ay ? ax : ay;
  return {{-view.x, -view.y, view.z}, {ax / width, 0, 0}, {0, ay / width, 0}, {0, 0, 1}, view, width < 1.0 ? width : 1.0, long_tailed};
}

constexpr std::array<Vec3d, 2> no_planes() { return {}; }

inline Vec3d mirrored(const ShadingPoint& at) { return normalized(at.normal * (2 * dot(at.normal, at.view)) - at.view); }

inline Vec3<Real<double>> to_kernel(Vec3d v) { return {v.x, v.y, v.z}; }
inline Vec3d from_kernel(const Vec3<Real<double>>& v) { return {v.x.v, v.y.v, v.z.v}; }

// A microfacet lobe without shadowing, from its distribution's value.
inline double unshadowed_lobe(Real<double> distribution, Vec3d l, Vec3d v) {
  return Kernels<double>().microfacet_lobe_unshadowed(distribution, to_kernel(l), to_kernel(v)).v;
}
inline Vec3<Real<double>> half_vector(Vec3d l, Vec3d v) { return Kernels<double>().microfacet_half_vector(to_kernel(l), to_kernel(v)); }

}  // namespace steradian::lobes
