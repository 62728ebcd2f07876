// The part of a light that the blockers of a tile leave visible, for as many pixels at once as a register holds. For *_pack.cpp only.
//
// Every direction is a slope: the tangent of its angle from an axis, the direction of a disk's centre or an edge's normal. Blockers reduce
// the light's slopes [-limit, limit] from both ends. The few intervals that lie strictly within are stored, sorted.
#pragma once

#include "core/pack.h"
#include "plane/frame/tiles/tile.h"

namespace steradian::plane::STERADIAN_ISA {
namespace {

using PackMask = Mask<Pack>;
constexpr double kBeyond = 1e9;

STERADIAN_INLINE void add(float* p, PackReal x) { store(p, load(p) + x); }

// The light's slopes that are still visible.
struct Cut {
  PackReal low, high;
  float* kept;  // begin and end of each interval; capacity for all the tile's items
  int count = 0;

  STERADIAN_INLINE float* begin_of(int k) const { return kept + static_cast<std::size_t>(2 * k) * kLanes; }
  STERADIAN_INLINE float* end_of(int k) const { return begin_of(k) + kLanes; }

  STERADIAN_INLINE bool dark() const { return all_lanes(low >= high); }

  // Removes [from, to] where `valid`.
  STERADIAN_INLINE void take(PackReal from, PackReal to, PackMask valid) {
    from = select(valid, from, PackReal(kBeyond));  // an interval at the far end removes nothing
    to = select(valid, to, PackReal(kBeyond));
    from = max(from, low);
    const PackMask left = from <= low;
    const PackReal new_low = select(left, max(low, to), low);
    const PackMask right = to >= high;
    const PackReal new_high = select(right, min(high, from), high);
    const PackMask within = !(left || right);
    low = new_low;
    high = new_high;
    if (any_lane(within && to > low && from < high && from < to))
      insert(select(within, from, PackReal(kBeyond)), select(within, to, PackReal(kBeyond)));
  }

  // Inserts sorted by begin, lane by lane. Mostly intervals arrive in that order, and continue where the last one ends: then the last one
  // grows. Lanes that remove nothing have both ends beyond.
  STERADIAN_INLINE void insert(PackReal from, PackReal to) {
    if (count > 0) {
      const PackReal b = load(begin_of(count - 1)), e = load(end_of(count - 1));
      const PackMask nothing = from >= PackReal(kBeyond), empty = b >= PackReal(kBeyond);
      PackMask joins = nothing || empty || (from <= e && to >= b);
      if (count > 1) joins = joins && (nothing || from >= load(begin_of(count - 2)));
      if (all_lanes(joins)) {
        store(begin_of(count - 1), min(b, from));
        store(end_of(count - 1), select(nothing, e, select(empty, to, max(e, to))));
        return;
      }
    }
    int at = count++;
    store(begin_of(at), from);
    store(end_of(at), to);
    for (; at > 0; --at) {
      const PackReal b = load(begin_of(at - 1)), e = load(end_of(at - 1)), late_b = load(begin_of(at)), late_e = load(end_of(at));
      const PackMask swap = late_b < b;
      if (!any_lane(swap)) return;
      store(begin_of(at - 1), select(swap, late_b, b));
      store(end_of(at - 1), select(swap, late_e, e));
      store(begin_of(at), select(swap, b, late_b));
      store(end_of(at), select(swap, e, late_e));
    }
  }

  // Calls f for the intervals removed from within [low, high], without overlaps.
  template <class F>
  STERADIAN_INLINE void for_each_taken(F f) const {
    PackReal at = low;
    for (int k = 0; k < count; ++k) {
      const PackReal from = max(at, min(load(begin_of(k)), high)), to = max(from, min(load(end_of(k)), high));
      if (any_lane(to > from)) f(from, to);
      at = to;
    }
  }

  template <class F>
  STERADIAN_INLINE void for_each_gap(F f) const {
    PackReal at = low;
    for (int k = 0; k < count; ++k) {
      const PackReal gap_end = min(load(begin_of(k)), high);
      if (any_lane(gap_end > at)) f(at, max(gap_end, at));
      at = max(at, min(load(end_of(k)), high));
    }
    if (any_lane(high > at)) f(at, max(high, at));
  }
};

// a / b to 2 or 3 ulp; b > 0 and in the range of its estimate.
STERADIAN_INLINE PackReal quotient(PackReal a, PackReal b) {
#if defined(__AVX512F__)
  const PackReal y = PackReal::of(Pack(_mm512_rcp14_ps(b.v)));
  return a * (y * (PackReal(2.0) - b * y));
#elif defined(__AVX2__)
  const PackReal y = PackReal::of(Pack(_mm256_rcp_ps(b.v)));
  return a * (y * (PackReal(2.0) - b * y));
#else
  return a / b;
#endif
}

// The slope of a direction (w along the axis, t across it), or `beyond` if it is not in front.
STERADIAN_INLINE PackReal slope(PackReal w, PackReal t, PackReal beyond) {
  const PackReal q = quotient(t, max(w, PackReal(1e-12)));
  return select(w > PackReal(1e-12), clamp(q, PackReal(-kBeyond), PackReal(kBeyond)), beyond);
}

struct Axis {
  PackReal x, y;    // axis: w along it, t across
  PackReal px, py;  // the pixels
  STERADIAN_INLINE PackReal w(PackReal vx, PackReal vy) const { return vx * x + vy * y; }
  STERADIAN_INLINE PackReal t(PackReal vx, PackReal vy) const { return x * vy - y * vx; }
};

STERADIAN_INLINE PackReal slope_to(const TileVertex& v, const Axis& axis) {
  const PackReal x = broadcast(v.x) - axis.px, y = broadcast(v.y) - axis.py;
  return quotient(axis.t(x, y), axis.w(x, y));
}

STERADIAN_INLINE void take_blocker(const TileSpan& span, const TileVertex* vertices, const Axis& axis, Cut& cut) {
  const TileVertex* v = vertices + span.first;
  PackReal from = slope_to(v[0], axis), to = slope_to(v[span.begins], axis);
  for (int i = 1; i < span.begins; ++i) from = min(from, slope_to(v[i], axis));
  for (int i = 1; i < span.ends; ++i) to = max(to, slope_to(v[span.begins + i], axis));
  cut.take(from, to, from < to);
}

// Removes the span of two directions less than half a turn apart, in any order, also behind the pixel.
STERADIAN_INLINE void take_span(PackReal pw, PackReal pt, PackReal qw, PackReal qt, PackMask valid, Cut& cut) {
  const PackMask swap = pw * qt - pt * qw < PackReal(0.0);
  const PackReal aw = select(swap, qw, pw), at = select(swap, qt, pt), bw = select(swap, pw, qw), bt = select(swap, pt, qt);
  const PackReal from = slope(aw, at, PackReal(-kBeyond)), to = slope(bw, bt, PackReal(kBeyond));
  cut.take(from, to, valid && (aw > PackReal(1e-12) || bw > PackReal(1e-12)) && from < to);
}

STERADIAN_INLINE void take_chord(const TileItem& item, const Axis& axis, PackMask valid, Cut& cut) {
  const PackReal px = broadcast(item.px) - axis.px, py = broadcast(item.py) - axis.py;
  const PackReal qx = broadcast(item.qx) - axis.px, qy = broadcast(item.qy) - axis.py;
  take_span(axis.w(px, py), axis.t(px, py), axis.w(qx, qy), axis.t(qx, qy), valid, cut);
}

template <class Item>
STERADIAN_INLINE PackMask nearer(const Item& item, const Axis& axis) {
  return broadcast(item.depth_x) * axis.px + broadcast(item.depth_y) * axis.py + broadcast(item.depth_c) > PackReal(0.0);
}

// Removes the directions between the blocker's tangents: its most clockwise and counter-clockwise vertices.
STERADIAN_INLINE void take_body(const TileBody& body, const TileVertex* vertices, const Axis& axis, Cut& cut) {
  const TileVertex* v = vertices + body.vertices.first;
  const auto outermost = [&](const TileVertex* candidates, int count, PackReal sign, PackReal& w, PackReal& t) {
    PackReal x = broadcast(candidates[0].x) - axis.px, y = broadcast(candidates[0].y) - axis.py;
    for (int i = 1; i < count; ++i) {
      const PackReal cx = broadcast(candidates[i].x) - axis.px, cy = broadcast(candidates[i].y) - axis.py;
      const PackMask further = (x * cy - y * cx) * sign > PackReal(0.0);
      x = select(further, cx, x);
      y = select(further, cy, y);
    }
    w = axis.w(x, y);
    t = axis.t(x, y);
  };
  PackReal pw, pt, qw, qt;
  outermost(v, body.vertices.begins, PackReal(-1.0), pw, pt);
  outermost(v + body.vertices.begins, body.vertices.ends, PackReal(1.0), qw, qt);
  const PackReal from = slope(pw, pt, PackReal(-kBeyond)), to = slope(qw, qt, PackReal(kBeyond));
  PackMask valid = (pw > PackReal(1e-12) || qw > PackReal(1e-12)) && from < to;
  if (body.deep) valid = valid && nearer(body, axis);
  cut.take(from, to, valid);
}

// A point in the space where an ellipse is the unit circle.
struct UnitPoint {
  PackReal u, v, outside2;  // outside2: above 0 outside
  STERADIAN_INLINE UnitPoint(const TileRound& r, PackReal px, PackReal py) {
    const PackReal x = px - broadcast(r.cx), y = py - broadcast(r.cy);
    u = x * broadcast(r.ux) + y * broadcast(r.uy);
    v = x * broadcast(r.vx) + y * broadcast(r.vy);
    outside2 = u * u + v * v - PackReal(1.0);
  }
};

// Tangent directions of an ellipse from a point: p is the clockwise one.
struct TangentVectors {
  PackReal px, py, qx, qy;
  STERADIAN_INLINE TangentVectors(const TileRound& r, const UnitPoint& eye) {
    const PackReal tangent = sqrt(max(eye.outside2, PackReal(0.0))), u = -eye.u, v = -eye.v;
    // The centre's direction turned by the angle whose sine is 1 / d, to both sides, and back out of the unit space.
    const PackReal pu = u * tangent + v, pv = v * tangent - u, qu = u * tangent - v, qv = v * tangent + u;
    px = pu * broadcast(r.xx) + pv * broadcast(r.yx);
    py = pu * broadcast(r.xy) + pv * broadcast(r.yy);
    qx = qu * broadcast(r.xx) + qv * broadcast(r.yx);
    qy = qu * broadcast(r.xy) + qv * broadcast(r.yy);
  }
};

// The same in the axis' components.
struct Tangents {
  PackReal pw, pt, qw, qt;
  PackMask outside;
};
STERADIAN_INLINE Tangents tangents(const TileRound& r, const UnitPoint& eye, const Axis& axis) {
  const TangentVectors t(r, eye);
  return {axis.w(t.px, t.py), axis.t(t.px, t.py), axis.w(t.qx, t.qy), axis.t(t.qx, t.qy), eye.outside2 > PackReal(0.0)};
}

// Slopes of a disk's tangents, with the disk in front of the axis: its clockwise one and the other.
struct DiskTangents {
  PackReal x, y, root, radius;  // the centre from the pixel, the length of a tangent
  STERADIAN_INLINE DiskTangents(const TileDisk& disk, const Axis& axis) {
    x = broadcast(disk.x) - axis.px;
    y = broadcast(disk.y) - axis.py;
    radius = broadcast(disk.radius);
    root = PackKernels().plane_root(max(x * x + y * y - radius * radius, PackReal(0.0)));
  }
  STERADIAN_INLINE PackReal begin(const Axis& axis) const { return along(axis, x * root + y * radius, y * root - x * radius); }
  STERADIAN_INLINE PackReal end(const Axis& axis) const { return along(axis, x * root - y * radius, y * root + x * radius); }
  STERADIAN_INLINE static PackReal along(const Axis& axis, PackReal dx, PackReal dy) { return quotient(axis.t(dx, dy), axis.w(dx, dy)); }
};

// On the line from the eye through a point of the ellipse, at the fraction 1 of the way: the fraction at which it enters.
STERADIAN_INLINE PackReal entry_before(const TileRound& r, const UnitPoint& eye, PackReal x, PackReal y) {
  const PackReal u = x * broadcast(r.ux) + y * broadcast(r.uy), v = x * broadcast(r.vx) + y * broadcast(r.vy);
  return min(quotient(max(eye.outside2, PackReal(0.0)), max(u * u + v * v, PackReal(1e-30))), PackReal(1.0));
}

// Two convex outlines that cross: the nearer one changes only at a crossing that is visible on both.
STERADIAN_INLINE void take_lens(const TileLens& lens, const TileLight& light, const Axis& axis, Cut& cut) {
  const UnitPoint eye(lens.round, axis.px, axis.py);
  const Tangents t = tangents(lens.round, eye, axis);
  const PackReal p = slope(t.pw, t.pt, PackReal(-kBeyond)), q = slope(t.qw, t.qt, PackReal(kBeyond));
  const PackMask valid = t.outside && (t.pw > PackReal(1e-12) || t.qw > PackReal(1e-12)) && p < q;
  const PackMask never = PackReal(1.0) < PackReal(0.0);
  PackMask seen[4], any = never;
  PackReal at[4];
  for (int i = 0; i < lens.count; ++i) {
    const TileLens::Crossing& c = lens.crossings[i];
    const PackReal x = broadcast(c.x) - axis.px, y = broadcast(c.y) - axis.py;
    // One that rounding hides counts: it is at the end of what is visible, and decides the order there.
    const PackReal slack = PackReal(1e-5) * (abs(x) + abs(y));
    seen[i] = x * broadcast(c.lx) + y * broadcast(c.ly) < slack && x * broadcast(c.bx) + y * broadcast(c.by) < slack;
    at[i] = slope(axis.w(x, y), axis.t(x, y), PackReal(0.0));
    any = any || seen[i];
  }
  // No crossing is visible: the order is the same everywhere, also towards the first crossing.
  const PackReal x = broadcast(lens.crossings[0].x) - axis.px, y = broadcast(lens.crossings[0].y) - axis.py;
  PackReal light_entry(1.0);
  if (light.kind != TileKind::edge) light_entry = entry_before(light.shape, UnitPoint(light.shape, axis.px, axis.py), x, y);
  const PackMask in_front = !any && entry_before(lens.round, eye, x, y) < light_entry;
  if (any_lane(in_front && valid)) cut.take(p, q, in_front && valid);
  if (!any_lane(any && valid)) return;
  // The blocker is in front from each crossing where this begins, up to the next where it ends. It is also in front from its tangent up to
  // a crossing where it ends, if none has begun.
  for (int i = 0; i < lens.count; ++i) {
    const bool begins = lens.crossings[i].begins;
    PackReal from = begins ? at[i] : p, to = begins ? q : at[i];
    PackMask counts = seen[i] && valid;
    for (int k = 0; k < lens.count; ++k) {
      if (k == i) continue;
      if (begins && !lens.crossings[k].begins) to = select(seen[k] && at[k] > at[i], min(to, at[k]), to);
      if (!begins && lens.crossings[k].begins) counts = counts && !(seen[k] && at[k] < at[i]);
    }
    cut.take(from, to, counts && from < to);
  }
}

// Restricts the cut to the directions in which a spot's light arrives.
STERADIAN_INLINE void cut_spot(const TileSpot& spot, const Axis& axis, Cut& cut) {
  const PackReal low_x = broadcast(spot.low_x), low_y = broadcast(spot.low_y), high_x = broadcast(spot.high_x),
                 high_y = broadcast(spot.high_y);
  const PackReal lw = axis.w(low_x, low_y), lt = axis.t(low_x, low_y), hw = axis.w(high_x, high_y), ht = axis.t(high_x, high_y);
  const PackMask either = lw > PackReal(1e-12) || hw > PackReal(1e-12);
  if (spot.wide) {
    // The rest is less than half a turn, from high to low.
    cut.take(slope(hw, ht, PackReal(-kBeyond)), slope(lw, lt, PackReal(kBeyond)), either);
    return;
  }
  cut.low = max(cut.low, slope(lw, lt, PackReal(-kBeyond)));
  cut.high = select(either, min(cut.high, slope(hw, ht, PackReal(kBeyond))), cut.low);
}

// Returns false if nothing remains on any lane.
STERADIAN_INLINE bool cut_blockers(const TileLight& light, const Axis& axis, Cut& cut) {
  if (light.spot.present) cut_spot(light.spot, axis, cut);
  for (int i = 0; i < light.low_count; ++i) cut.low = max(cut.low, slope_to(light.lows[i], axis));
  for (int i = 0; i < light.high_count; ++i) cut.high = min(cut.high, slope_to(light.highs[i], axis));
  for (int i = 0; i < light.low_disk_count; ++i) cut.low = max(cut.low, DiskTangents(light.low_disks[i], axis).end(axis));
  for (int i = 0; i < light.high_disk_count; ++i) cut.high = min(cut.high, DiskTangents(light.high_disks[i], axis).begin(axis));
  if (cut.dark()) return false;
  for (int i = 0; i < light.span_count; ++i) {
    take_blocker(light.spans[i], light.span_vertices, axis, cut);
    if (cut.dark()) return false;
  }
  for (int i = 0; i < light.disk_count; ++i) {
    const DiskTangents tangents(light.disks[i], axis);
    const PackReal from = tangents.begin(axis), to = tangents.end(axis);
    cut.take(from, to, from < to);
    if (cut.dark()) return false;
  }
  for (int i = 0; i < light.body_count; ++i) {
    take_body(light.bodies[i], light.span_vertices, axis, cut);
    if (cut.dark()) return false;
  }
  for (int i = 0; i < light.chord_count; ++i) {
    take_chord(light.chords[i], axis, PackMask(Pack(0.0f) == Pack(0.0f)), cut);
    if (cut.dark()) return false;
  }
  for (int i = 0; i < light.deep_count; ++i) take_chord(light.deep[i], axis, nearer(light.deep[i], axis), cut);
  for (int i = 0; i < light.round_count; ++i) {
    const Tangents t = tangents(light.rounds[i], UnitPoint(light.rounds[i], axis.px, axis.py), axis);
    take_span(t.pw, t.pt, t.qw, t.qt, t.outside && nearer(light.rounds[i], axis), cut);
  }
  for (int i = 0; i < light.lens_count; ++i) take_lens(light.lenses[i], light, axis, cut);
  return !cut.dark();
}

}  // namespace
}  // namespace steradian::plane::STERADIAN_ISA
