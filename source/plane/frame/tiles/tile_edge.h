// Light of an edge between two slopes, on as many pixels at once as a register holds. For *_pack.cpp only.
//
// Radiance is linear from one end of the edge to the other. So the light is the sum of both ends' radiance times weights. No weight is
// negative, since it is a sum of values between the ends: nothing cancels beside a much brighter end.
#pragma once

#include "plane/frame/tiles/tile_cut.h"

namespace steradian::plane::STERADIAN_ISA {
namespace {

// Gauss-Legendre, three nodes, as halves of a length: the outer ones from the middle, and the weights. Over a length of a fifth of the
// distance of what it integrates, the error is of the order 20^-6 of the sum.
constexpr double kOuterNode = 0.774596669241483377, kOuterWeight = 5.0 / 9, kMiddleWeight = 8.0 / 9;

// Sums of both ends' weights; `begin` alone if the radiance is the same everywhere.
struct EndWeights {
  PackReal begin{0.0}, end{0.0};
  STERADIAN_INLINE void add(PackReal weight, PackReal share) {
    begin += weight * (PackReal(1.0) - share);
    end += weight * share;
  }
};

// power: 1 if emission falls with the cosine or the distance.
template <bool ranged, bool linear, int power>
class EdgeIntegral {
 public:
  STERADIAN_INLINE EdgeIntegral() = default;
  // The share of a slope is its place along the edge: 0 at `begin`, 1 at `end`. q: (d / range)^2.
  STERADIAN_INLINE EdgeIntegral(PackReal share_at_foot, PackReal share_by_slope, PackReal q)
      : share_at_foot_(share_at_foot), share_by_slope_(share_by_slope), q_(q) {}

  // from <= to.
  STERADIAN_INLINE void add(PackReal from, PackReal to, EndWeights& sum) const {
    const PackReal width = to - from, nearest = max(max(from, -to), PackReal(0.0));
    const PackMask narrow = width * width <= PackReal(0.04) * (PackReal(1.0) + nearest * nearest);
    EndWeights by_nodes, closed;
    if (any_lane(narrow)) {
      const PackReal half = PackReal(0.5) * width, middle = PackReal(0.5) * (from + to);
      add_node(middle - PackReal(kOuterNode) * half, half * PackReal(kOuterWeight), by_nodes);
      add_node(middle, half * PackReal(kMiddleWeight), by_nodes);
      add_node(middle + PackReal(kOuterNode) * half, half * PackReal(kOuterWeight), by_nodes);
    }
    if (!all_lanes(narrow)) {
      const PackReal measure = constant(from, to);
      if (linear) {
        // The value at the centroid, which lies between the two.
        const PackReal centroid = (slope_term(to) - slope_term(from)) / max(measure, PackReal(1e-30));
        closed.add(measure, share_at(min(max(centroid, from), to)));
      } else {
        closed.begin = measure;
      }
    }
    sum.begin += select(narrow, by_nodes.begin, closed.begin);
    if (linear) sum.end += select(narrow, by_nodes.end, closed.end);
  }

 private:
  STERADIAN_INLINE PackReal share_at(PackReal t) const { return clamp(share_at_foot_ + share_by_slope_ * t, PackReal(0.0), PackReal(1.0)); }

  STERADIAN_INLINE void add_node(PackReal t, PackReal weight, EndWeights& sum) const {
    const PackReal sec2 = PackReal(1.0) + t * t;
    weight *= power == 0 ? quotient(PackReal(1.0), sec2) : quotient(inversesqrt(sec2), sec2);
    if (ranged) {
      const PackReal window = PackReal(1.0) - q_ * sec2;
      weight *= window * window;
    }
    if (linear)
      sum.add(weight, share_at(t));
    else
      sum.begin += weight;
  }

  // Far along the edge, the antiderivatives of both slopes round to the same: these differences do not cancel.
  STERADIAN_INLINE PackReal constant(PackReal from, PackReal to) const {
    PackKernels k;
    PackReal sum;
    if (power == 0) {
      sum = k.trig_atan2_unwrapped(to - from, PackReal(1.0) + from * to);
    } else {
      const PackReal c0 = inversesqrt(PackReal(1.0) + from * from), c1 = inversesqrt(PackReal(1.0) + to * to), c = c0 * c1;
      const PackReal product = from * to;
      sum = select(product > PackReal(0.0), (to - from) * c * (c0 + c1) / (PackReal(1.0) + (PackReal(1.0) + product) * c),
                   to * c1 - from * c0);
    }
    if (ranged) {
      // The angle is not read for these powers.
      const auto term = [&](int n) { return k.plane_power_integral(n, to, to) - k.plane_power_integral(n, from, from); };
      sum = sum - PackReal(2.0) * q_ * term(power - 2) + q_ * q_ * term(power - 4);
    }
    return sum;
  }

  STERADIAN_INLINE PackReal slope_term(PackReal t) const {
    PackKernels k;
    return ranged ? k.plane_edge_integral(1, power, t, t, q_) : k.plane_term(1, power, t, t);
  }

  PackReal share_at_foot_, share_by_slope_, q_;
};

}  // namespace
}  // namespace steradian::plane::STERADIAN_ISA
