// What a visible piece of an arc sends, where that has no closed form: Gauss-Kronrod quadrature on as many pixels at once
// as a register holds. For *_pack.cpp only.
//
// In the space where the ellipse is the unit circle, a ray at the angle psi from the centre's direction passes it at the
// distance d sin psi = sin beta, beta being the angle at which it hits. In beta nothing is singular at the tangents, and
// z = tan(beta / 2) makes sines of it without trigonometry.
#pragma once

#include "plane/frame/tile_cut.h"

namespace steradian::plane::STERADIAN_ISA {
namespace {

struct ArcSum {
  PackReal constant{0.0}, ramp{0.0};  // integrals over directions: of 1, and of TileArc's ramp; times profile and range
};

class ArcIntegrand {
 public:
  STERADIAN_INLINE ArcIntegrand(const TileLight& light, const UnitPoint& eye)
      : light_(light), eye_(eye), d2_(max(eye.outside2, PackReal(1e-6)) + PackReal(1.0)), inverse_d2_(PackReal(1.0) / d2_) {}

  // The place z of the direction of a slope.
  STERADIAN_INLINE PackReal place_of(const Axis& axis, PackReal m) const {
    const TileRound& r = light_.shape;
    const PackReal x = axis.x - m * axis.y, y = axis.y + m * axis.x;
    const PackReal u = x * broadcast(r.ux) + y * broadcast(r.uy), v = x * broadcast(r.vx) + y * broadcast(r.vy);
    const PackReal s = (eye_.v * u - eye_.u * v) * inversesqrt(max(u * u + v * v, PackReal(1e-30)));
    const PackReal sine = clamp(s, PackReal(-1.0), PackReal(1.0));
    return sine / (PackReal(1.0) + sqrt(max(PackReal(1.0) - sine * sine, PackReal(0.0))));
  }

  // Halves what 15 nodes do not serve. Beside the outline, directions change within a small part of the arc; the halves
  // then shrink towards it. What is still not served after so many halvings, or is no number, is taken as it is: the right half of a
  // half waits in its place, so that the depth alone would not end it.
  STERADIAN_INLINE void add(PackReal from, PackReal to, ArcSum& sum) const {
    alignas(64) float ends[kDeepest * kLanes];
    int waiting = 0, halvings = 0;
    for (;;) {
      ArcSum part;
      const bool good = add_part(from, to, part);
      if (!good && waiting < kDeepest && halvings < kMostHalvings) {
        ++halvings;
        store(ends + static_cast<std::size_t>(waiting++) * kLanes, to);
        to = PackReal(0.5) * (from + to);
        continue;
      }
      sum.constant += part.constant;
      sum.ramp += part.ramp;
      if (waiting == 0) return;
      from = to;
      to = load(ends + static_cast<std::size_t>(--waiting) * kLanes);
    }
  }

 private:
  static constexpr int kDeepest = 12, kMostHalvings = 64;
  // Of 2 pi, the emission of a light all around: what the two rules may differ by. Where Gauss' 7 nodes, exact to degree 13, are off
  // by rho^-14, Kronrod's 15, exact to degree 22, are off by rho^-23: by (2e-4)^(23/14) = 8e-7.
  static constexpr double kOff = 2e-4;

  struct Node {
    PackReal weight, ramp;
  };

  STERADIAN_INLINE Node at(PackReal z) const {
    const TileRound& r = light_.shape;
    const PackReal over = PackReal(1.0) / (PackReal(1.0) + z * z), s = PackReal(2.0) * z * over, c = (PackReal(1.0) - z * z) * over;
    const PackReal root = PackKernels().plane_root(max(d2_ - s * s, PackReal(1e-12))), t = root - c;
    // The ray's direction in unit space, from there in the plane: as long as the two spaces differ along it.
    const PackReal u = (-eye_.u * root + eye_.v * s) * inverse_d2_, v = (-eye_.v * root - eye_.u * s) * inverse_d2_;
    const PackReal x = u * broadcast(r.xx) + v * broadcast(r.yx), y = u * broadcast(r.xy) + v * broadcast(r.yy);
    const PackReal m2 = x * x + y * y, hit_u = eye_.u + u * t, hit_v = eye_.v + v * t;
    // d beta = 2 dz over, d psi = c / root d beta, and the angle in the plane is det / m2 times as much.
    Node node;
    node.weight = PackReal(2.0) * over * quotient(c * broadcast(light_.arc.det), root * m2);
    if (light_.profile == 1) {
      const PackReal nx = hit_u * broadcast(r.yx) - hit_v * broadcast(r.xx), ny = hit_u * broadcast(r.yy) - hit_v * broadcast(r.xy);
      node.weight *= c * broadcast(light_.arc.det) * inversesqrt(max((nx * nx + ny * ny) * m2, PackReal(1e-30)));
    }
    if (light_.profile == 2) node.weight *= inversesqrt(max(t * t * m2, PackReal(1e-24)));
    if (light_.inverse_range > 0.0f) {
      const PackReal q = t * t * m2 * broadcast(light_.inverse_range * light_.inverse_range);
      const PackReal window = max(PackReal(1.0) - q, PackReal(0.0));
      node.weight *= window * window;
    }
    node.ramp = PackReal(0.0);
    if (light_.linear) {
      const PackReal hx = hit_u * broadcast(r.xx) + hit_v * broadcast(r.yx), hy = hit_u * broadcast(r.xy) + hit_v * broadcast(r.yy);
      node.ramp = node.weight * (hx * broadcast(light_.arc.ramp_x) + hy * broadcast(light_.arc.ramp_y));
    }
    return node;
  }

  // Gauss-Kronrod, 7 and 15 nodes; Piessens et al., QUADPACK, 1983. False where the two differ.
  STERADIAN_INLINE bool add_part(PackReal from, PackReal to, ArcSum& sum) const {
    static constexpr double kNode[8] = {0.991455371120812639, 0.949107912342758525, 0.864864423359769073, 0.741531185599394440,
                                        0.586087235467691130, 0.405845151377397167, 0.207784955007898468, 0.0};
    static constexpr double kKronrod[8] = {0.022935322010529225, 0.063092092629978553, 0.104790010322250184, 0.140653259715525919,
                                           0.169004726639267903, 0.190350578064785410, 0.204432940075298892, 0.209482141084727828};
    static constexpr double kGauss[8] = {0, 0.129484966168869693, 0, 0.279705391489276668,
                                         0, 0.381830050505118945, 0, 0.417959183673469388};
    const PackReal middle = PackReal(0.5) * (from + to), half = PackReal(0.5) * (to - from);
    PackReal gauss(0.0), ramp_gauss(0.0), constant(0.0), ramp(0.0);
    for (int i = 0; i < 15; ++i) {
      const int k = i < 8 ? i : 14 - i;
      const PackReal place(i < 8 ? -kNode[k] : kNode[k]);
      const Node node = at(middle + half * place);
      constant += PackReal(kKronrod[k]) * node.weight;
      ramp += PackReal(kKronrod[k]) * node.ramp;
      gauss += PackReal(kGauss[k]) * node.weight;
      ramp_gauss += PackReal(kGauss[k]) * node.ramp;
    }
    sum.constant = half * constant;
    sum.ramp = half * ramp;
    const PackReal limit = PackReal(kOff) * max(PackReal(1.0), abs(sum.constant));
    return all_lanes(abs(half * (constant - gauss)) <= limit) && all_lanes(abs(half * (ramp - ramp_gauss)) <= limit);
  }

  const TileLight& light_;
  UnitPoint eye_;
  PackReal d2_, inverse_d2_;
};

}  // namespace
}  // namespace steradian::plane::STERADIAN_ISA
