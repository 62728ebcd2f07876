// The edges of a run on the pixels of one tile: each over the part of the run's chord that blockers leave visible. For *_pack.cpp only.
#pragma once

#include "plane/frame/tiles/tile_edge.h"

namespace steradian::plane::STERADIAN_ISA {
namespace {

// Light of an edge, from [from, to] of the run's slopes.
template <bool ranged, bool linear, int power>
class PartIntegral {
 public:
  STERADIAN_INLINE PartIntegral(const TileLight& light, const TilePart& part, const Axis& run) : light_(light) {
    Axis axis;
    axis.px = run.px;
    axis.py = run.py;
    axis.x = broadcast(-part.nx);
    axis.y = broadcast(-part.ny);
    // The run's axis relative to this one: a slope m of the run is the direction axis + m across.
    cosine_ = axis.w(run.x, run.y);
    sine_ = axis.t(run.x, run.y);
    const PackReal d = axis.w(broadcast(part.x) - axis.px, broadcast(part.y) - axis.py);
    d_ = max(d, PackReal(1e-6));
    inverse_d_ = PackReal(1.0) / d_;
    foot_ = axis.t(axis.px, axis.py);
    low_ = clamp((broadcast(part.begin) - foot_) * inverse_d_, PackReal(-kBeyond), PackReal(kBeyond));
    high_ = clamp((broadcast(part.end) - foot_) * inverse_d_, PackReal(-kBeyond), PackReal(kBeyond));
    const PackReal q = d_ * d_ * broadcast(light.inverse_range * light.inverse_range);
    if (ranged) {
      const PackReal reach = sqrt(max(PackReal(1.0) / max(q, PackReal(1e-30)) - PackReal(1.0), PackReal(0.0)));
      low_ = max(low_, -reach);
      high_ = min(high_, reach);
    }
    high_ = select(d > PackReal(1e-6), high_, low_);
    const PackReal inverse_length = broadcast(1 / (part.end - part.begin));
    edge_ = {(foot_ - broadcast(part.begin)) * inverse_length, d_ * inverse_length, q};
  }

  STERADIAN_INLINE void add(PackReal from, PackReal to) {
    // An interval is less than half a turn: an end behind the edge's line is beyond all of the edge on its own side, unless both are.
    const PackReal from_w = cosine_ - from * sine_, to_w = cosine_ - to * sine_;
    const PackMask ahead = from_w > PackReal(1e-12) || to_w > PackReal(1e-12);
    from = max(slope(from_w, sine_ + from * cosine_, PackReal(-kBeyond)), low_);
    to = select(ahead, min(slope(to_w, sine_ + to * cosine_, PackReal(kBeyond)), high_), from);
    if (any_lane(to > from)) edge_.add(from, max(to, from), sum_);
  }

  STERADIAN_INLINE EndWeights weights() const {
    PackReal scale = PackKernels().inverse_two_pi();
    if (light_.profile == 2) scale *= inverse_d_;
    return {sum_.begin * scale, sum_.end * scale};
  }

 private:
  const TileLight& light_;
  PackReal cosine_, sine_, d_, inverse_d_, foot_, low_, high_;
  EdgeIntegral<ranged, linear, power> edge_;
  EndWeights sum_;
};

// The same for an edge of linear radiance without a range that is small for every pixel. From one end of it by the vector `along`, the
// angle grows by cross / r^2. That is smooth, and the distance at least five times the length.
class SmallPart {
 public:
  STERADIAN_INLINE SmallPart(const TilePart& part, const Axis& run) {
    x_ = broadcast(part.from_x) - run.px;
    y_ = broadcast(part.from_y) - run.py;
    along_x_ = broadcast(part.to_x - part.from_x);
    along_y_ = broadcast(part.to_y - part.from_y);
    t0_ = run.t(x_, y_);
    w0_ = run.w(x_, y_);
    t1_ = t0_ + run.t(along_x_, along_y_);
    w1_ = w0_ + run.w(along_x_, along_y_);
  }
  STERADIAN_INLINE void add_all() { add_between(PackReal(0.0), PackReal(1.0)); }
  // Adds the light between two slopes of the run.
  STERADIAN_INLINE void add(PackReal from, PackReal to) {
    const PackReal low = share_at(from), high = share_at(to);
    if (any_lane(high > low)) add_between(low, max(high, low));
  }
  STERADIAN_INLINE EndWeights weights() const {
    const PackReal scale = max(x_ * along_y_ - y_ * along_x_, PackReal(0.0)) * PackKernels().inverse_two_pi();
    return {sum_.begin * scale, sum_.end * scale};
  }

 private:
  STERADIAN_INLINE PackReal share_at(PackReal slope) const {
    const PackReal g0 = slope * w0_ - t0_, g1 = slope * w1_ - t1_;
    return clamp(g0 / select(g0 > g1, g0 - g1, PackReal(1e-30)), PackReal(0.0), PackReal(1.0));
  }
  STERADIAN_INLINE void add_between(PackReal low, PackReal high) {
    const PackReal half = PackReal(0.5) * (high - low), middle = PackReal(0.5) * (low + high);
    const auto add_node = [&](PackReal share, double weight) {
      const PackReal x = x_ + share * along_x_, y = y_ + share * along_y_;
      sum_.add(quotient(half * PackReal(weight), x * x + y * y), share);
    };
    add_node(middle - PackReal(kOuterNode) * half, kOuterWeight);
    add_node(middle, kMiddleWeight);
    add_node(middle + PackReal(kOuterNode) * half, kOuterWeight);
  }

  PackReal x_, y_, along_x_, along_y_, t0_, t1_, w0_, w1_;
  EndWeights sum_;
};

// A separate function for each kind of emission: inlined, they would take registers from each other.
template <bool ranged, bool linear, int power>
__attribute__((flatten, noinline)) void add_parts_of(const TileLight& light, TileBuffer& tile, int i, const Axis& axis, const Cut& cut,
                                                     bool whole) {
  PackReal red(0.0), green(0.0), blue(0.0);
  const auto add_weights = [&](const TilePart& part, const EndWeights& weights) {
    red += broadcast(part.red) * weights.begin;
    green += broadcast(part.green) * weights.begin;
    blue += broadcast(part.blue) * weights.begin;
    if (!linear) return;
    red += broadcast(part.red_end) * weights.end;
    green += broadcast(part.green_end) * weights.end;
    blue += broadcast(part.blue_end) * weights.end;
  };
  for (int n = 0; n < light.part_count; ++n) {
    if (!ranged && linear && power == 0 && light.parts[n].small) {
      SmallPart part(light.parts[n], axis);
      if (whole)
        part.add_all();
      else
        cut.for_each_gap([&](PackReal from, PackReal to) { part.add(from, to); });
      add_weights(light.parts[n], part.weights());
      continue;
    }
    PartIntegral<ranged, linear, power> part(light, light.parts[n], axis);
    cut.for_each_gap([&](PackReal from, PackReal to) { part.add(from, to); });
    add_weights(light.parts[n], part.weights());
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
