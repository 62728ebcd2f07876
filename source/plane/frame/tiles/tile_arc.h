// Contribution of a visible piece of an arc without a closed form: quadrature on as many pixels at once as a register holds. For *_pack.cpp
// only.
//
// In the space where the ellipse is the unit circle, a ray at the angle psi from the centre's direction passes it at the distance d sin psi
// = sin beta; beta is the angle at which it hits. In beta nothing is singular at the tangents. Away from the arc Gauss' rule of a few nodes
// is used; the tile's distance decides their number (TileArc::nodes). Near it, Gauss-Kronrod's rule in z = tan(beta / 2) is used, with
// intervals halved if necessary.
#pragma once

#include "plane/frame/tiles/tile_edge.h"

namespace steradian::plane::STERADIAN_ISA {
namespace {

// Gauss-Legendre, the nodes above 0: exact to polynomials of degree 2 n - 1. Abramowitz and Stegun, table 25.4.
struct ArcRule {
  float node[8], weight[8];
};
STERADIAN_INLINE const ArcRule& arc_rule(int nodes) {
  static constexpr ArcRule four = {{0.861136312f, 0.339981044f}, {0.347854845f, 0.652145155f}};
  static constexpr ArcRule six = {{0.932469514f, 0.661209386f, 0.238619186f}, {0.171324492f, 0.360761573f, 0.467913935f}};
  static constexpr ArcRule eight = {{0.960289856f, 0.796666477f, 0.525532410f, 0.183434642f},
                                    {0.101228536f, 0.222381034f, 0.313706646f, 0.362683783f}};
  static constexpr ArcRule twelve = {{0.981560634f, 0.904117256f, 0.769902674f, 0.587317954f, 0.367831499f, 0.125233409f},
                                     {0.047175336f, 0.106939326f, 0.160078329f, 0.203167427f, 0.233492537f, 0.249147046f}};
  static constexpr ArcRule sixteen = {
      {0.989400935f, 0.944575023f, 0.865631202f, 0.755404408f, 0.617876244f, 0.458016778f, 0.281603551f, 0.095012510f},
      {0.027152459f, 0.062253524f, 0.095158512f, 0.124628971f, 0.149595989f, 0.169156519f, 0.182603415f, 0.189450610f}};
  return nodes == 4 ? four : nodes == 6 ? six : nodes == 8 ? eight : nodes == 12 ? twelve : sixteen;
}

class ArcIntegrand {
 public:
  STERADIAN_INLINE ArcIntegrand(const TileLight& light, const UnitPoint& eye)
      : light_(light), eye_(eye), d2_(max(eye.outside2, PackReal(1e-6)) + PackReal(1.0)), inverse_d2_(PackReal(1.0) / d2_) {}

  // Adds the light between two slopes.
  STERADIAN_INLINE void add(const Axis& axis, PackReal from, PackReal to, EndWeights& sum) const {
    if (light_.arc.nodes > 0)
      add_smooth(incidence(sine_of(axis, from)), incidence(sine_of(axis, to)), sum);
    else
      add_halving(place_of(sine_of(axis, from)), place_of(sine_of(axis, to)), sum);
  }

 private:
  // Sine of the angle of incidence, for the direction of a slope.
  STERADIAN_INLINE PackReal sine_of(const Axis& axis, PackReal m) const {
    const TileRound& r = light_.shape;
    const PackReal x = axis.x - m * axis.y, y = axis.y + m * axis.x;
    const PackReal u = x * broadcast(r.ux) + y * broadcast(r.uy), v = x * broadcast(r.vx) + y * broadcast(r.vy);
    const PackReal s = (eye_.v * u - eye_.u * v) * inversesqrt(max(u * u + v * v, PackReal(1e-30)));
    return clamp(s, PackReal(-1.0), PackReal(1.0));
  }
  STERADIAN_INLINE static PackReal place_of(PackReal sine) {
    return sine / (PackReal(1.0) + sqrt(max(PackReal(1.0) - sine * sine, PackReal(0.0))));
  }
  STERADIAN_INLINE static PackReal incidence(PackReal sine) {
    PackKernels k;
    const PackReal size = abs(sine), cosine = k.plane_root(max(PackReal(1.0) - size * size, PackReal(0.0)));
    const PackReal angle = PackReal(1.57079632679489662) - k.trig_angle_over_sine_acute(PackReal(1.0) - size) * cosine;
    return select(sine < PackReal(0.0), -angle, angle);
  }

  // A narrow part that rounding reverses is empty.
  STERADIAN_INLINE static PackReal half_between(PackReal from, PackReal to) { return max(PackReal(0.5) * (to - from), PackReal(0.0)); }

  // Accurate to 1e-7 within a right angle: the series omit x^13 / 13! and x^14 / 14!.
  STERADIAN_INLINE static void sine_and_cosine(PackReal x, PackReal& s, PackReal& c) {
    const PackReal q = x * x;
    s = x * (PackReal(1.0) +
             q * (PackReal(-1.0 / 6) +
                  q * (PackReal(1.0 / 120) + q * (PackReal(-1.0 / 5040) + q * (PackReal(1.0 / 362880) + q * PackReal(-1.0 / 39916800))))));
    c = PackReal(1.0) +
        q * (PackReal(-1.0 / 2) +
             q * (PackReal(1.0 / 24) + q * (PackReal(-1.0 / 720) +
                                            q * (PackReal(1.0 / 40320) + q * (PackReal(-1.0 / 3628800) + q * PackReal(1.0 / 479001600))))));
  }

  // Gauss' rule in the angle of incidence; nodes in pairs around the middle share the sine and cosine of their distance from it.
  STERADIAN_INLINE void add_smooth(PackReal from, PackReal to, EndWeights& sum) const {
    const ArcRule& rule = arc_rule(light_.arc.nodes);
    const PackReal half = half_between(from, to);
    PackReal middle_s, middle_c, begin(0.0), end(0.0);
    sine_and_cosine(PackReal(0.5) * (from + to), middle_s, middle_c);
    for (int i = 0; i < light_.arc.nodes / 2; ++i) {
      PackReal s, c;
      sine_and_cosine(half * broadcast(rule.node[i]), s, c);
      const PackReal ss = middle_s * c, sc = middle_c * s, cc = middle_c * c, cs = middle_s * s;
      const EndWeights a = at(ss - sc, max(cc + cs, PackReal(0.0))), b = at(ss + sc, max(cc - cs, PackReal(0.0)));
      begin += broadcast(rule.weight[i]) * (a.begin + b.begin);
      end += broadcast(rule.weight[i]) * (a.end + b.end);
    }
    sum.begin += half * begin;
    sum.end += half * end;
  }

  // Halves intervals for which 15 nodes are not enough. Beside the outline, directions change within a small part of the arc; the halves
  // then shrink towards it. An interval that still fails after the most halvings, or is not a number, is accepted as it is. The right half
  // of a half waits in its place, so that the depth alone would not end the loop.
  STERADIAN_INLINE void add_halving(PackReal from, PackReal to, EndWeights& sum) const {
    alignas(64) float ends[kDeepest * kLanes];
    int waiting = 0, halvings = 0;
    for (;;) {
      EndWeights part;
      const bool good = add_part(from, to, part);
      if (!good && waiting < kDeepest && halvings < kMostHalvings) {
        ++halvings;
        store(ends + static_cast<std::size_t>(waiting++) * kLanes, to);
        to = PackReal(0.5) * (from + to);
        continue;
      }
      sum.begin += part.begin;
      sum.end += part.end;
      if (waiting == 0) return;
      from = to;
      to = load(ends + static_cast<std::size_t>(--waiting) * kLanes);
    }
  }

  static constexpr int kDeepest = 12, kMostHalvings = 64;
  // Largest difference of the two rules, relative to 2 pi, the emission of a light all around; relative to the part's own light if that is
  // more, or is divided by the distance. Where Gauss' 7 nodes, exact to degree 13, are off by rho^-14, Kronrod's 15, exact to degree 22,
  // are off by rho^-23: by (2e-4)^(23/14) = 8e-7. Their difference oscillates around 0, so that it may be small by accident. A second null
  // rule must be as small: Legendre's P12 by Kronrod's rule, 0 up to degree 11. Of 60,000 functions (z - x)^-p with random poles around the
  // part, the 15 nodes are then off by 1.1e-5 at most, and by 4e-2 without it.
  static constexpr double kOff = 2e-4, kNullOff = 1.2e-4;

  // Both ends' weights for each unit of an angle of incidence with this sine and cosine.
  STERADIAN_INLINE EndWeights at(PackReal s, PackReal c) const {
    const TileRound& r = light_.shape;
    const PackReal root2 = max(d2_ - s * s, PackReal(1e-12)), inverse_root = inversesqrt(root2), root = root2 * inverse_root, t = root - c;
    // d psi = c / root d beta.
    PackReal weight = c * inverse_root;
    PackReal far2, u, v;
    if (light_.arc.det_if_round > 0.0f) {
      if (light_.profile == 1) weight *= c;
      far2 = t * t * broadcast(light_.arc.det_if_round);
      if (light_.linear) u = (-eye_.u * root + eye_.v * s) * inverse_d2_, v = (-eye_.v * root - eye_.u * s) * inverse_d2_;
    } else {
      // The ray's direction in unit space, and from there in the plane. Its length is the ratio of the two spaces along it, and the angle
      // in the plane is det / m2 times as large.
      u = (-eye_.u * root + eye_.v * s) * inverse_d2_, v = (-eye_.v * root - eye_.u * s) * inverse_d2_;
      const PackReal x = u * broadcast(r.xx) + v * broadcast(r.yx), y = u * broadcast(r.xy) + v * broadcast(r.yy), m2 = x * x + y * y;
      weight *= quotient(broadcast(light_.arc.det), m2);
      if (light_.profile == 1) {
        const PackReal hit_u = eye_.u + u * t, hit_v = eye_.v + v * t;
        const PackReal nx = hit_u * broadcast(r.yx) - hit_v * broadcast(r.xx), ny = hit_u * broadcast(r.yy) - hit_v * broadcast(r.xy);
        weight *= c * broadcast(light_.arc.det) * inversesqrt(max((nx * nx + ny * ny) * m2, PackReal(1e-30)));
      }
      far2 = t * t * m2;
    }
    if (light_.profile == 2) weight *= inversesqrt(max(far2, PackReal(1e-24)));
    if (light_.inverse_range > 0.0f) {
      const PackReal window = max(PackReal(1.0) - far2 * broadcast(light_.inverse_range * light_.inverse_range), PackReal(0.0));
      weight *= window * window;
    }
    EndWeights node;
    if (light_.linear) {
      const PackReal hit_u = eye_.u + u * t, hit_v = eye_.v + v * t;
      const PackReal hx = hit_u * broadcast(r.xx) + hit_v * broadcast(r.yx), hy = hit_u * broadcast(r.xy) + hit_v * broadcast(r.yy);
      const PackReal share = hx * broadcast(light_.arc.ramp_x) + hy * broadcast(light_.arc.ramp_y) + broadcast(light_.arc.ramp_c);
      node.add(weight, clamp(share, PackReal(0.0), PackReal(1.0)));
    } else {
      node.begin = weight;
    }
    return node;
  }
  STERADIAN_INLINE EndWeights at_place(PackReal z) const {
    const PackReal over = PackReal(1.0) / (PackReal(1.0) + z * z);
    EndWeights node = at(PackReal(2.0) * z * over, (PackReal(1.0) - z * z) * over);
    // d beta = 2 dz over.
    node.begin *= PackReal(2.0) * over;
    node.end *= PackReal(2.0) * over;
    return node;
  }

  // Gauss-Kronrod, 7 and 15 nodes; Piessens et al., QUADPACK, 1983. Returns false if the two differ, or the null rule is not near 0.
  STERADIAN_INLINE bool add_part(PackReal from, PackReal to, EndWeights& sum) const {
    static constexpr double kNode[8] = {0.991455371120812639, 0.949107912342758525, 0.864864423359769073, 0.741531185599394440,
                                        0.586087235467691130, 0.405845151377397167, 0.207784955007898468, 0.0};
    static constexpr double kKronrod[8] = {0.022935322010529225, 0.063092092629978553, 0.104790010322250184, 0.140653259715525919,
                                           0.169004726639267903, 0.190350578064785410, 0.204432940075298892, 0.209482141084727828};
    static constexpr double kGauss[8] = {0, 0.129484966168869693, 0, 0.279705391489276668,
                                         0, 0.381830050505118945, 0, 0.417959183673469388};
    static constexpr double kNull[8] = {0.009991356662876932, -0.025246739496563773, 0.029058304001152294,  -0.019997310073577482,
                                        0.000805380980923889, 0.022153524494280635,  -0.040392629162145345, 0.047256225186105581};
    const PackReal middle = PackReal(0.5) * (from + to), half = half_between(from, to);
    EndWeights kronrod, gauss, null;
    const auto add_weighted = [](double weight, const EndWeights& node, EndWeights& rule) {
      rule.begin += PackReal(weight) * node.begin;
      rule.end += PackReal(weight) * node.end;
    };
    for (int i = 0; i < 15; ++i) {
      const int k = i < 8 ? i : 14 - i;
      const PackReal place(i < 8 ? -kNode[k] : kNode[k]);
      const EndWeights node = at_place(middle + half * place);
      add_weighted(kKronrod[k], node, kronrod);
      add_weighted(kGauss[k], node, gauss);
      add_weighted(kNull[k], node, null);
    }
    sum.begin = half * kronrod.begin;
    sum.end = half * kronrod.end;
    const PackReal own = sum.begin + sum.end, scale = light_.profile == 2 ? own : max(PackReal(1.0), own);
    const PackReal limit = PackReal(kOff) * scale, null_limit = PackReal(kNullOff) * scale;
    return all_lanes(abs(sum.begin - half * gauss.begin) <= limit && abs(half * null.begin) <= null_limit) &&
           all_lanes(abs(sum.end - half * gauss.end) <= limit && abs(half * null.end) <= null_limit);
  }

  const TileLight& light_;
  UnitPoint eye_;
  PackReal d2_, inverse_d2_;
};

}  // namespace
}  // namespace steradian::plane::STERADIAN_ISA
