// The inner loop of a frame: one light on the pixels of one tile, as many pixels at once as a register holds.
//
// Every direction is a slope: the tangent of its angle from an axis, the direction of a disk's centre or an edge's
// normal. Blockers cut [-limit, limit] of the light's slopes down from both ends; the few that lie strictly within are
// kept, sorted, and the gaps between them integrated in closed form.
#include "core/pack.h"
#include "plane/tile.h"

STERADIAN_BEGIN_ISA
namespace {

using PackMask = Mask<Pack>;
constexpr double kBeyond = 1e9;

// The light's slopes that are still visible.
struct Cut {
  PackReal low, high;
  float* kept;  // begin and end of each interval; room for all the tile's items
  int count = 0;

  STERADIAN_INLINE float* begin_of(int k) const { return kept + static_cast<std::size_t>(2 * k) * kLanes; }
  STERADIAN_INLINE float* end_of(int k) const { return begin_of(k) + kLanes; }

  STERADIAN_INLINE bool dark() const { return all_lanes(low >= high); }

  // Takes [from, to] away where `valid`.
  STERADIAN_INLINE void take(PackReal from, PackReal to, PackMask valid) {
    from = select(valid, from, PackReal(kBeyond));  // an interval at the far end takes nothing
    to = select(valid, to, PackReal(kBeyond));
    from = max(from, low);
    const PackMask left = from <= low;
    const PackReal new_low = select(left, max(low, to), low);
    const PackMask right = to >= high;
    const PackReal new_high = select(right, min(high, from), high);
    const PackMask within = !(left || right);
    low = new_low;
    high = new_high;
    if (any_lane(within && to > low && from < high && from < to)) insert(select(within, from, PackReal(kBeyond)), select(within, to, PackReal(kBeyond)));
  }

  // Sorted by begin, lane by lane.
  STERADIAN_INLINE void insert(PackReal from, PackReal to) {
    for (int k = 0; k < count; ++k) {
      const PackReal b = load(begin_of(k)), e = load(end_of(k));
      const PackMask swap = from < b;
      store(begin_of(k), select(swap, from, b));
      store(end_of(k), select(swap, to, e));
      from = select(swap, b, from);
      to = select(swap, e, to);
    }
    store(begin_of(count), from);
    store(end_of(count), to);
    ++count;
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

struct Axis {
  PackReal x, y;        // axis: w along it, t across
  PackReal px, py;      // the pixels
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

// Two directions that span less than half a turn, in any order, also behind the pixel.
STERADIAN_INLINE void take_span(PackReal pw, PackReal pt, PackReal qw, PackReal qt, PackMask valid, Cut& cut) {
  PackKernels k;
  const PackMask swap = pw * qt - pt * qw < PackReal(0.0);
  const PackReal aw = select(swap, qw, pw), at = select(swap, qt, pt), bw = select(swap, pw, qw), bt = select(swap, pt, qt);
  const PackReal from = k.plane_slope(aw, at, PackReal(-kBeyond)), to = k.plane_slope(bw, bt, PackReal(kBeyond));
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

// The blocker's tangents: its most clockwise and counter-clockwise vertices.
STERADIAN_INLINE void take_body(const TileBody& body, const TileVertex* vertices, const Axis& axis, Cut& cut) {
  PackKernels k;
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
  const PackReal from = k.plane_slope(pw, pt, PackReal(-kBeyond)), to = k.plane_slope(qw, qt, PackReal(kBeyond));
  PackMask valid = (pw > PackReal(1e-12) || qw > PackReal(1e-12)) && from < to;
  if (body.deep) valid = valid && nearer(body, axis);
  cut.take(from, to, valid);
}

// Tangent directions of an ellipse, in the axis' components.
struct Tangents {
  PackReal pw, pt, qw, qt;
  PackMask outside;
};
STERADIAN_INLINE Tangents tangents(const TileRound& r, const Axis& axis) {
  const PackReal cx = broadcast(r.cx) - axis.px, cy = broadcast(r.cy) - axis.py;
  const PackReal u = cx * broadcast(r.ux) + cy * broadcast(r.uy), v = cx * broadcast(r.vx) + cy * broadcast(r.vy);
  const PackReal d2 = u * u + v * v - PackReal(1.0);
  Tangents result;
  result.outside = d2 > PackReal(0.0);
  const PackReal tangent = sqrt(max(d2, PackReal(0.0)));
  // The centre's direction turned by the angle whose sine is 1 / d, to both sides, and back out of the unit space.
  const PackReal pu = u * tangent + v, pv = v * tangent - u, qu = u * tangent - v, qv = v * tangent + u;
  const PackReal px = pu * broadcast(r.xx) + pv * broadcast(r.yx), py = pu * broadcast(r.xy) + pv * broadcast(r.yy);
  const PackReal qx = qu * broadcast(r.xx) + qv * broadcast(r.yx), qy = qu * broadcast(r.xy) + qv * broadcast(r.yy);
  result.pw = axis.w(px, py);
  result.pt = axis.t(px, py);
  result.qw = axis.w(qx, qy);
  result.qt = axis.t(qx, qy);
  return result;
}

// Two disks that overlap: which is nearer changes only at a crossing of their outlines that is seen on both.
STERADIAN_INLINE void take_lens(const TileLens& lens, const Axis& axis, Cut& cut) {
  PackKernels k;
  const Tangents t = tangents(lens.round, axis);
  const PackReal p = k.plane_slope(t.pw, t.pt, PackReal(-kBeyond)), q = k.plane_slope(t.qw, t.qt, PackReal(kBeyond));
  PackMask on_light[2], on_blocker[2];
  PackReal slope[2];
  for (int i = 0; i < 2; ++i) {
    const PackReal x = broadcast(lens.x[i]) - axis.px, y = broadcast(lens.y[i]) - axis.py;
    on_light[i] = x * broadcast(lens.lx[i]) + y * broadcast(lens.ly[i]) < PackReal(0.0);
    on_blocker[i] = x * broadcast(lens.bx[i]) + y * broadcast(lens.by[i]) < PackReal(0.0);
    slope[i] = k.plane_slope(axis.w(x, y), axis.t(x, y), PackReal(0.0));
  }
  const PackMask seen0 = on_light[0] && on_blocker[0], seen1 = on_light[1] && on_blocker[1];
  // None seen: the order is the same everywhere. A crossing on the light's near side but the blocker's far side has
  // the blocker in front; seen on neither, the side of the common chord decides.
  const PackMask front = (on_light[0] && !on_blocker[0]) || (on_light[1] && !on_blocker[1]);
  const PackMask behind = (on_blocker[0] && !on_light[0]) || (on_blocker[1] && !on_light[1]);
  const PackMask none = !(seen0 || seen1) && (front || (!behind && nearer(lens.round, axis)));
  const PackMask both = seen0 && seen1;
  const PackMask middle = both && slope[0] < slope[1];
  const PackMask valid = t.outside && (t.pw > PackReal(1e-12) || t.qw > PackReal(1e-12));
  const PackReal from = select(seen0, slope[0], p), to = select(seen1, slope[1], q);
  const PackMask split = both && !middle;
  cut.take(from, to, valid && (none || middle || (!both && (seen0 || seen1))) && from < to);
  if (any_lane(split)) {
    cut.take(p, slope[1], valid && split);
    cut.take(slope[0], q, valid && split);
  }
}

// False where nothing is left on any lane.
STERADIAN_INLINE bool cut_blockers(const TileLight& light, const Axis& axis, Cut& cut) {
  for (int i = 0; i < light.low_count; ++i) cut.low = max(cut.low, slope_to(light.lows[i], axis));
  for (int i = 0; i < light.high_count; ++i) cut.high = min(cut.high, slope_to(light.highs[i], axis));
  if (cut.dark()) return false;
  for (int i = 0; i < light.span_count; ++i) {
    take_blocker(light.spans[i], light.span_vertices, axis, cut);
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
    const Tangents t = tangents(light.rounds[i], axis);
    take_span(t.pw, t.pt, t.qw, t.qt, t.outside && nearer(light.rounds[i], axis), cut);
  }
  for (int i = 0; i < light.lens_count; ++i) take_lens(light.lenses[i], axis, cut);
  return !cut.dark();
}

STERADIAN_INLINE void add(float* p, PackReal x) { store(p, load(p) + x); }

STERADIAN_INLINE void add_disk(const TileLight& light, TileBuffer& tile, int i) {
  PackKernels k;
  Axis axis;
  axis.px = load(tile.x + i);
  axis.py = load(tile.y + i);
  axis.x = broadcast(light.x) - axis.px;
  axis.y = broadcast(light.y) - axis.py;
  const PackReal rho2 = broadcast(light.radius * light.radius);
  const PackReal d2 = axis.x * axis.x + axis.y * axis.y;
  const PackReal tangent2 = d2 - rho2;
  const PackReal limit = broadcast(light.radius) * inversesqrt(max(tangent2, PackReal(1e-12)));
  const PackReal inverse = broadcast(light.inverse_range), inverse2 = inverse * inverse;
  const PackReal d2r = d2 * inverse2, rho2r = rho2 * inverse2;
  const bool ranged = light.inverse_range > 0.0f;
  Cut cut;
  cut.kept = light.scratch;
  cut.high = limit;
  bool whole = true;  // within the range as far as the tangents
  if (ranged) {
    const PackMask leaves = d2r - rho2r > PackReal(1.0);
    whole = !any_lane(leaves);
    if (!whole) {
      // Where the near side leaves the range before the tangent: law of cosines, R = 1.
      const PackReal numerator = d2r + PackReal(1.0) - rho2r;
      const PackReal sine2 = PackReal(4.0) * d2r - numerator * numerator;
      const PackReal reach = sqrt(max(sine2, PackReal(0.0))) / numerator;
      cut.high = select(leaves, min(reach, limit), limit);
    }
  }
  cut.high = select(tangent2 > PackReal(0.0), cut.high, PackReal(0.0));
  cut.low = -cut.high;
  const PackReal reached = cut.high;
  if (cut.dark() || !cut_blockers(light, axis, cut)) return;
  PackReal sum(0.0);
  const bool open = cut.count == 0 && all_lanes(cut.high - cut.low >= reached + reached);
  if (ranged && open) {
    sum = whole ? k.plane_disk_window_whole(reached, d2r, rho2r) : PackReal(2.0) * k.plane_disk_window(reached, d2r, rho2r);
  } else {
    cut.for_each_gap([&](PackReal from, PackReal to) {
      sum += ranged ? k.plane_disk_window(to, d2r, rho2r) - k.plane_disk_window(from, d2r, rho2r)
                    : k.trig_atan2_unwrapped(to - from, PackReal(1.0) + from * to);
    });
  }
  sum = sum * PackReal(0.159154943091895336);
  add(tile.red + i, sum * broadcast(light.red));
  add(tile.green + i, sum * broadcast(light.green));
  add(tile.blue + i, sum * broadcast(light.blue));
}

STERADIAN_INLINE void add_edge(const TileLight& light, TileBuffer& tile, int i) {
  PackKernels k;
  Axis axis;
  axis.px = load(tile.x + i);
  axis.py = load(tile.y + i);
  // Towards the edge: against its lit normal. t runs along the edge.
  axis.x = broadcast(-light.nx);
  axis.y = broadcast(-light.ny);
  const PackReal d = axis.w(broadcast(light.x) - axis.px, broadcast(light.y) - axis.py);
  const PackReal foot = axis.t(axis.px, axis.py);
  const PackMask lit = d > PackReal(1e-6);
  const PackReal inverse_d = PackReal(1.0) / max(d, PackReal(1e-6));
  Cut cut;
  cut.kept = light.scratch;
  cut.low = (broadcast(light.begin) - foot) * inverse_d;
  cut.high = (broadcast(light.end) - foot) * inverse_d;
  const PackReal q = d * d * broadcast(light.inverse_range * light.inverse_range);
  if (light.inverse_range > 0.0f) {
    const PackReal reach = sqrt(max(PackReal(1.0) / max(q, PackReal(1e-30)) - PackReal(1.0), PackReal(0.0)));
    cut.low = max(cut.low, -reach);
    cut.high = min(cut.high, reach);
  }
  cut.high = select(lit, cut.high, cut.low);
  if (cut.dark() || !cut_blockers(light, axis, cut)) return;

  const int power = light.profile == 0 ? 0 : 1;
  PackReal constant(0.0), slope(0.0);
  cut.for_each_gap([&](PackReal from, PackReal to) {
    if (light.inverse_range > 0.0f || light.linear || power != 0) {
      const PackReal f0 = k.trig_atan2(from, PackReal(1.0)), f1 = k.trig_atan2(to, PackReal(1.0));
      constant += k.plane_edge_integral(0, power, to, f1, q) - k.plane_edge_integral(0, power, from, f0, q);
      if (light.linear) slope += k.plane_edge_integral(1, power, to, f1, q) - k.plane_edge_integral(1, power, from, f0, q);
    } else {
      constant += k.trig_atan2_unwrapped(to - from, PackReal(1.0) + from * to);
    }
  });
  PackReal scale(0.159154943091895336);
  if (light.profile == 2) scale *= inverse_d;
  // Radiance at the foot, and its change per slope.
  constant = constant * scale;
  const PackReal at_foot = (foot - broadcast(light.begin)) * constant + slope * scale * d;
  add(tile.red + i, broadcast(light.red) * constant + broadcast(light.red_slope) * at_foot);
  add(tile.green + i, broadcast(light.green) * constant + broadcast(light.green_slope) * at_foot);
  add(tile.blue + i, broadcast(light.blue) * constant + broadcast(light.blue_slope) * at_foot);
}

__attribute__((flatten)) void add_light(const TileLight& light, TileBuffer& tile) {
  for (int i = 0; i < kTilePixels; i += static_cast<int>(kLanes)) {
    if (light.edge)
      add_edge(light, tile, i);
    else
      add_disk(light, tile, i);
  }
}

}  // namespace

const TileTable& tile_table() {
  static constexpr TileTable table = {add_light};
  return table;
}

STERADIAN_END_ISA
