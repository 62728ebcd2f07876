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

  // What is taken from within [low, high], without overlaps.
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

// The slope of a direction (w along the axis, t across it), `beyond` where it is not in front.
STERADIAN_INLINE PackReal slope(PackReal w, PackReal t, PackReal beyond) {
  const PackReal q = quotient(t, max(w, PackReal(1e-12)));
  return select(w > PackReal(1e-12), clamp(q, PackReal(-kBeyond), PackReal(kBeyond)), beyond);
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

// The blocker's tangents: its most clockwise and counter-clockwise vertices.
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

// Slopes of a disk's tangents, the disk in front of the axis: its clockwise one and the other.
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

// Two disks that overlap: which is nearer changes only at a crossing of their outlines that is seen on both.
STERADIAN_INLINE void take_lens(const TileLens& lens, const Axis& axis, Cut& cut) {
  const Tangents t = tangents(lens.round, axis);
  const PackReal p = slope(t.pw, t.pt, PackReal(-kBeyond)), q = slope(t.qw, t.qt, PackReal(kBeyond));
  PackMask on_light[2], on_blocker[2];
  PackReal crossing[2];
  for (int i = 0; i < 2; ++i) {
    const PackReal x = broadcast(lens.x[i]) - axis.px, y = broadcast(lens.y[i]) - axis.py;
    on_light[i] = x * broadcast(lens.lx[i]) + y * broadcast(lens.ly[i]) < PackReal(0.0);
    on_blocker[i] = x * broadcast(lens.bx[i]) + y * broadcast(lens.by[i]) < PackReal(0.0);
    crossing[i] = slope(axis.w(x, y), axis.t(x, y), PackReal(0.0));
  }
  const PackMask seen0 = on_light[0] && on_blocker[0], seen1 = on_light[1] && on_blocker[1];
  // None seen: the order is the same everywhere. A crossing on the light's near side but the blocker's far side has
  // the blocker in front; seen on neither, the side of the common chord decides.
  const PackMask front = (on_light[0] && !on_blocker[0]) || (on_light[1] && !on_blocker[1]);
  const PackMask behind = (on_blocker[0] && !on_light[0]) || (on_blocker[1] && !on_light[1]);
  const PackMask none = !(seen0 || seen1) && (front || (!behind && nearer(lens.round, axis)));
  const PackMask both = seen0 && seen1;
  const PackMask middle = both && crossing[0] < crossing[1];
  const PackMask valid = t.outside && (t.pw > PackReal(1e-12) || t.qw > PackReal(1e-12));
  const PackReal from = select(seen0, crossing[0], p), to = select(seen1, crossing[1], q);
  const PackMask split = both && !middle;
  cut.take(from, to, valid && (none || middle || (!both && (seen0 || seen1))) && from < to);
  if (any_lane(split)) {
    cut.take(p, crossing[1], valid && split);
    cut.take(crossing[0], q, valid && split);
  }
}

// False where nothing is left on any lane.
STERADIAN_INLINE bool cut_blockers(const TileLight& light, const Axis& axis, Cut& cut) {
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
    const Tangents t = tangents(light.rounds[i], axis);
    take_span(t.pw, t.pt, t.qw, t.qt, t.outside && nearer(light.rounds[i], axis), cut);
  }
  for (int i = 0; i < light.lens_count; ++i) take_lens(light.lenses[i], axis, cut);
  return !cut.dark();
}

STERADIAN_INLINE void add(float* p, PackReal x) { store(p, load(p) + x); }

// Where a disk with a range is seen, on one tile. Blocks of pixels are integrated end by end in loops of their own:
// without branches, many ends are under way at once.
struct DiskEnds {
  static constexpr int kRoom = 64;
  alignas(64) float d2[kTilePixels];       // the centre's distance squared, range 1
  alignas(64) float sum[kTilePixels];
  alignas(64) float slope[kRoom * kLanes];
  int pixel[kRoom];                        // the first of the block
  float sign[kRoom];
  int count = 0;
  // Ends at a tangent of the disk.
  alignas(64) float tangent[kTilePixels];
  int tangent_pixel[kTilePixels / kLanes];
  float tangent_sign[kTilePixels / kLanes];  // 2 where both are
  int tangent_count = 0;
  PackReal rho2;

  STERADIAN_INLINE void push(int i, PackReal at, float to_sum) {
    if (count == kRoom) flush();
    pixel[count] = i;
    sign[count] = to_sum;
    store(slope + static_cast<std::size_t>(count) * kLanes, at);
    ++count;
  }
  STERADIAN_INLINE void push_tangent(int i, PackReal at, float ends) {
    tangent_pixel[tangent_count] = i;
    tangent_sign[tangent_count++] = ends;
    store(tangent + i, at);
  }
  STERADIAN_INLINE void add_to_sum(int i, float times, PackReal part) { store(sum + i, load(sum + i) + broadcast(times) * part); }
  void flush() {
    PackKernels k;
    for (int n = 0; n < count; ++n)
      add_to_sum(pixel[n], sign[n], k.plane_disk_window(load(slope + static_cast<std::size_t>(n) * kLanes), load(d2 + pixel[n]), rho2));
    for (int n = 0; n < tangent_count; ++n) {
      const int i = tangent_pixel[n];
      add_to_sum(i, tangent_sign[n], PackReal(0.5) * k.plane_disk_window_whole(load(tangent + i), load(d2 + i), rho2));
    }
    count = tangent_count = 0;
  }
};

struct DiskView {
  Axis axis;
  PackReal d2, tangent2;
  STERADIAN_INLINE DiskView(const TileLight& light, const TileBuffer& tile, int i) {
    axis.px = load(tile.x + i);
    axis.py = load(tile.y + i);
    axis.x = broadcast(light.x) - axis.px;
    axis.y = broadcast(light.y) - axis.py;
    d2 = axis.x * axis.x + axis.y * axis.y;
    tangent2 = d2 - broadcast(light.radius * light.radius);
  }
  // The slope of the tangents; 0 within the disk.
  STERADIAN_INLINE PackReal limit(const TileLight& light) const {
    const PackReal slope = broadcast(light.radius) * inversesqrt(max(tangent2, PackReal(1e-12)));
    return select(tangent2 > PackReal(0.0), slope, PackReal(0.0));
  }
};

STERADIAN_INLINE void add_colour(const TileLight& light, TileBuffer& tile, int i, PackReal share) {
  share = share * PackReal(0.159154943091895336);
  add(tile.red + i, share * broadcast(light.red));
  add(tile.green + i, share * broadcast(light.green));
  add(tile.blue + i, share * broadcast(light.blue));
}

void add_ranged_disk(const TileLight& light, TileBuffer& tile) {
  DiskEnds ends;
  const PackReal inverse2 = broadcast(light.inverse_range * light.inverse_range);
  ends.rho2 = broadcast(light.radius * light.radius) * inverse2;
  int lit[kTilePixels / kLanes], lit_count = 0;
  for (int i = 0; i < kTilePixels; i += static_cast<int>(kLanes)) {
    const DiskView view(light, tile, i);
    const PackReal d2 = view.d2 * inverse2;
    Cut cut;
    cut.kept = light.scratch;
    cut.high = view.limit(light);
    const PackMask leaves = d2 - ends.rho2 > PackReal(1.0);
    const bool within = !any_lane(leaves);
    if (!within) {
      // Where the near side leaves the range before the tangent: law of cosines, R = 1.
      const PackReal numerator = d2 + PackReal(1.0) - ends.rho2;
      const PackReal sine2 = PackReal(4.0) * d2 - numerator * numerator;
      const PackReal reach = PackKernels().plane_root(max(sine2, PackReal(0.0))) / numerator;
      cut.high = select(leaves, min(reach, cut.high), cut.high);
    }
    cut.low = -cut.high;
    const PackReal reached = cut.high;
    if (cut.dark() || !cut_blockers(light, view.axis, cut)) continue;
    lit[lit_count++] = i;
    store(ends.d2 + i, d2);
    store(ends.sum + i, PackReal(0.0));
    // The integral over [low, high] without what is taken from within; where low has passed high, over nothing.
    const bool high_open = within && all_lanes(cut.high >= reached), low_open = within && all_lanes(cut.low <= -reached);
    if (high_open && low_open) {
      ends.push_tangent(i, reached, 2.0f);
    } else if (high_open) {
      ends.push_tangent(i, reached, 1.0f);
      ends.push(i, min(cut.low, cut.high), -1.0f);
    } else if (low_open) {
      ends.push_tangent(i, reached, 1.0f);
      ends.push(i, max(cut.low, cut.high), 1.0f);
    } else {
      ends.push(i, min(cut.low, cut.high), -1.0f);
      ends.push(i, cut.high, 1.0f);
    }
    cut.for_each_taken([&](PackReal from, PackReal to) {
      ends.push(i, from, 1.0f);
      ends.push(i, to, -1.0f);
    });
  }
  ends.flush();
  for (int n = 0; n < lit_count; ++n) add_colour(light, tile, lit[n], max(load(ends.sum + lit[n]), PackReal(0.0)));
}

STERADIAN_INLINE void add_disk(const TileLight& light, TileBuffer& tile, int i) {
  const DiskView view(light, tile, i);
  Cut cut;
  cut.kept = light.scratch;
  cut.high = view.limit(light);
  cut.low = -cut.high;
  if (cut.dark() || !cut_blockers(light, view.axis, cut)) return;
  PackReal sum(0.0);
  cut.for_each_gap([&](PackReal from, PackReal to) { sum += PackKernels().trig_atan2_unwrapped(to - from, PackReal(1.0) + from * to); });
  add_colour(light, tile, i, sum);
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
  if (!light.edge && light.inverse_range > 0.0f) {
    add_ranged_disk(light, tile);
    return;
  }
  for (int i = 0; i < kTilePixels; i += static_cast<int>(kLanes)) {
    if (light.edge)
      add_edge(light, tile, i);
    else
      add_disk(light, tile, i);
  }
}

void write(const TileBuffer& tile, int width, int height, float* out, std::size_t stride) {
  for (int y = 0; y < height; ++y, out += stride) {
    int x = 0;
    for (; x + 4 <= width; x += 4) {
      const int i = TileBuffer::slot(x, y);
      const __m128 r = _mm_load_ps(tile.red + i), g = _mm_load_ps(tile.green + i), b = _mm_load_ps(tile.blue + i);
      const __m128 b0r1 = _mm_shuffle_ps(b, r, _MM_SHUFFLE(1, 1, 0, 0)), g1b1 = _mm_shuffle_ps(g, b, _MM_SHUFFLE(1, 1, 1, 1));
      const __m128 b2r3 = _mm_shuffle_ps(b, r, _MM_SHUFFLE(3, 3, 2, 2)), g3b3 = _mm_shuffle_ps(g, b, _MM_SHUFFLE(3, 3, 3, 3));
      _mm_storeu_ps(out + 3 * x, _mm_shuffle_ps(_mm_unpacklo_ps(r, g), b0r1, _MM_SHUFFLE(2, 0, 1, 0)));
      _mm_storeu_ps(out + 3 * x + 4, _mm_shuffle_ps(g1b1, _mm_unpackhi_ps(r, g), _MM_SHUFFLE(1, 0, 2, 0)));
      _mm_storeu_ps(out + 3 * x + 8, _mm_shuffle_ps(b2r3, g3b3, _MM_SHUFFLE(2, 0, 2, 0)));
    }
    for (; x < width; ++x) {
      const int i = TileBuffer::slot(x, y);
      out[3 * x] = tile.red[i];
      out[3 * x + 1] = tile.green[i];
      out[3 * x + 2] = tile.blue[i];
    }
  }
}

}  // namespace

const TileTable& tile_table() {
  static constexpr TileTable table = {add_light, write};
  return table;
}

STERADIAN_END_ISA
