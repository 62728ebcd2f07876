// The edges of a run on the pixels of one tile: each over the part of the run's chord that blockers leave visible. For *_pack.cpp only.
#pragma once

#include "plane/frame/tiles/tile_cut.h"

namespace steradian::plane::STERADIAN_ISA {
namespace {

// Contribution of an edge of a run from [from, to] of the run's slopes. power: 1 if emission falls with the cosine or the distance.
template <bool ranged, bool linear, int power>
class PartIntegral {
 public:
  STERADIAN_INLINE PartIntegral(const TileLight& light, const TilePart& part, const Axis& run) : light_(light), part_(part) {
    axis_.px = run.px;
    axis_.py = run.py;
    axis_.x = broadcast(-part.nx);
    axis_.y = broadcast(-part.ny);
    // The run's axis relative to this one: a slope m of the run is the direction axis + m across.
    cosine_ = axis_.w(run.x, run.y);
    sine_ = axis_.t(run.x, run.y);
    const PackReal d = axis_.w(broadcast(part.x) - axis_.px, broadcast(part.y) - axis_.py);
    d_ = max(d, PackReal(1e-6));
    inverse_d_ = PackReal(1.0) / d_;
    foot_ = axis_.t(axis_.px, axis_.py);
    low_ = clamp((broadcast(part.begin) - foot_) * inverse_d_, PackReal(-kBeyond), PackReal(kBeyond));
    high_ = clamp((broadcast(part.end) - foot_) * inverse_d_, PackReal(-kBeyond), PackReal(kBeyond));
    q_ = d_ * d_ * broadcast(light.inverse_range * light.inverse_range);
    if (ranged) {
      const PackReal reach = sqrt(max(PackReal(1.0) / max(q_, PackReal(1e-30)) - PackReal(1.0), PackReal(0.0)));
      low_ = max(low_, -reach);
      high_ = min(high_, reach);
    }
    high_ = select(d > PackReal(1e-6), high_, low_);
  }

  STERADIAN_INLINE void add(PackReal from, PackReal to) {
    // An interval is less than half a turn: an end behind the edge's line is beyond all of the edge on its own side, unless both are.
    const PackReal from_w = cosine_ - from * sine_, to_w = cosine_ - to * sine_;
    const PackMask ahead = from_w > PackReal(1e-12) || to_w > PackReal(1e-12);
    from = max(slope(from_w, sine_ + from * cosine_, PackReal(-kBeyond)), low_);
    to = select(ahead, min(slope(to_w, sine_ + to * cosine_, PackReal(kBeyond)), high_), from);
    if (!any_lane(to > from)) return;
    to = max(to, from);
    constant_ += antiderivative<0>(to) - antiderivative<0>(from);
    if (linear) slope_ += antiderivative<1>(to) - antiderivative<1>(from);
  }

  STERADIAN_INLINE void add_to(PackReal& red, PackReal& green, PackReal& blue) const {
    PackReal scale = PackKernels().inverse_two_pi();
    if (light_.profile == 2) scale *= inverse_d_;
    const PackReal constant = constant_ * scale, at_foot = (foot_ - broadcast(part_.begin)) * constant + slope_ * scale * d_;
    red += broadcast(part_.red) * constant + broadcast(part_.red_slope) * at_foot;
    green += broadcast(part_.green) * constant + broadcast(part_.green_slope) * at_foot;
    blue += broadcast(part_.blue) * constant + broadcast(part_.blue_slope) * at_foot;
  }

 private:
  // The compiler removes the angle for kinds that do not need it.
  template <int j>
  STERADIAN_INLINE PackReal antiderivative(PackReal t) const {
    PackKernels k;
    const PackReal f = k.trig_atan2(t, PackReal(1.0));
    return ranged ? k.plane_edge_integral(j, power, t, f, q_) : k.plane_term(j, power, t, f);
  }

  const TileLight& light_;
  const TilePart& part_;
  Axis axis_;
  PackReal cosine_, sine_, d_, inverse_d_, foot_, low_, high_, q_;
  PackReal constant_{0.0}, slope_{0.0};
};

// The same for an edge of uniform or linear radiance without a range that is small for every pixel. Between two points of it at distances
// r0 and r1, the angle is atan(cross / dot). ln(r1 / r0), the integral of tan f, is atanh((r1^2 - r0^2) / (r1^2 + r0^2)). Both arguments
// are below 1/5, so that their series omit x^9 / 9 < 6e-8.
class SmallPart {
 public:
  STERADIAN_INLINE SmallPart(const TilePart& part, const Axis& run) : part_(part) {
    x0_ = broadcast(part.from_x) - run.px;
    y0_ = broadcast(part.from_y) - run.py;
    x1_ = broadcast(part.to_x) - run.px;
    y1_ = broadcast(part.to_y) - run.py;
    t0_ = run.t(x0_, y0_);
    t1_ = run.t(x1_, y1_);
    w0_ = run.w(x0_, y0_);
    w1_ = run.w(x1_, y1_);
  }
  STERADIAN_INLINE void add_all() { add_between(x0_, y0_, x1_, y1_); }
  // Adds the light between two slopes of the run.
  STERADIAN_INLINE void add(PackReal from, PackReal to) {
    const PackReal low = share_at(from), high = share_at(to), dx = x1_ - x0_, dy = y1_ - y0_;
    if (!any_lane(high > low)) return;
    const PackReal last = max(high, low);
    add_between(x0_ + low * dx, y0_ + low * dy, x0_ + last * dx, y0_ + last * dy);
  }
  STERADIAN_INLINE void add_to(PackReal& red, PackReal& green, PackReal& blue) const {
    const PackReal scale = PackKernels().inverse_two_pi(), nx = broadcast(part_.nx), ny = broadcast(part_.ny);
    // The direction towards the edge is against its normal; along it is (ny, -nx).
    const PackReal d = -(nx * x0_ + ny * y0_), foot = nx * y0_ - ny * x0_;
    const PackReal constant = angle_ * scale, at_foot = foot * constant + logarithm_ * scale * d;
    red += broadcast(part_.red) * constant + broadcast(part_.red_slope) * at_foot;
    green += broadcast(part_.green) * constant + broadcast(part_.green_slope) * at_foot;
    blue += broadcast(part_.blue) * constant + broadcast(part_.blue_slope) * at_foot;
  }

 private:
  STERADIAN_INLINE PackReal share_at(PackReal slope) const {
    const PackReal g0 = slope * w0_ - t0_, g1 = slope * w1_ - t1_;
    return clamp(g0 / select(g0 > g1, g0 - g1, PackReal(1e-30)), PackReal(0.0), PackReal(1.0));
  }
  STERADIAN_INLINE static PackReal odd_series(PackReal x, double sign) {
    const PackReal x2 = x * x;
    return x * (PackReal(1.0) + x2 * (PackReal(sign / 3) + x2 * (PackReal(0.2) + x2 * PackReal(sign / 7))));
  }
  STERADIAN_INLINE void add_between(PackReal ax, PackReal ay, PackReal bx, PackReal by) {
    const PackReal cross = ax * by - ay * bx, dot = ax * bx + ay * by;
    const PackReal dx = bx - ax, dy = by - ay, sx = ax + bx, sy = ay + by;
    angle_ += odd_series(quotient(cross, dot), -1);
    // r1^2 - r0^2 and r1^2 + r0^2, without squares that cancel.
    logarithm_ += odd_series(quotient(dx * sx + dy * sy, PackReal(0.5) * (sx * sx + sy * sy + dx * dx + dy * dy)), 1);
  }

  const TilePart& part_;
  PackReal x0_, y0_, x1_, y1_, t0_, t1_, w0_, w1_;
  PackReal angle_{0.0}, logarithm_{0.0};
};

// A separate function for each kind of emission: inlined, they would take registers from each other.
template <bool ranged, bool linear, int power>
__attribute__((flatten, noinline)) void add_parts_of(const TileLight& light, TileBuffer& tile, int i, const Axis& axis, const Cut& cut,
                                                     bool whole) {
  PackReal red(0.0), green(0.0), blue(0.0);
  for (int n = 0; n < light.part_count; ++n) {
    if (!ranged && power == 0 && light.parts[n].small) {
      SmallPart part(light.parts[n], axis);
      if (whole)
        part.add_all();
      else
        cut.for_each_gap([&](PackReal from, PackReal to) { part.add(from, to); });
      part.add_to(red, green, blue);
      continue;
    }
    PartIntegral<ranged, linear, power> part(light, light.parts[n], axis);
    cut.for_each_gap([&](PackReal from, PackReal to) { part.add(from, to); });
    part.add_to(red, green, blue);
  }
  add(tile.red + i, red);
  add(tile.green + i, green);
  add(tile.blue + i, blue);
}

// `whole`: blockers occlude nothing of it.
STERADIAN_INLINE void add_parts(const TileLight& light, TileBuffer& tile, int i, const Axis& axis, const Cut& cut, bool whole) {
  const int kind = (light.inverse_range > 0.0f ? 4 : 0) + (light.linear ? 2 : 0) + (light.profile == 0 ? 0 : 1);
  switch (kind) {
    case 1: return add_parts_of<false, false, 1>(light, tile, i, axis, cut, whole);
    case 2: return add_parts_of<false, true, 0>(light, tile, i, axis, cut, whole);
    case 3: return add_parts_of<false, true, 1>(light, tile, i, axis, cut, whole);
    case 4: return add_parts_of<true, false, 0>(light, tile, i, axis, cut, whole);
    case 5: return add_parts_of<true, false, 1>(light, tile, i, axis, cut, whole);
    case 6: return add_parts_of<true, true, 0>(light, tile, i, axis, cut, whole);
    case 7: return add_parts_of<true, true, 1>(light, tile, i, axis, cut, whole);
    default: return add_parts_of<false, false, 0>(light, tile, i, axis, cut, whole);
  }
}

}  // namespace
}  // namespace steradian::plane::STERADIAN_ISA
