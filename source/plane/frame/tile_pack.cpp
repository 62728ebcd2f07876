// The inner loop of a frame: one light on the pixels of one tile. What the blockers leave of it is integrated in closed
// form.
#include "plane/frame/tile_arc.h"
#include "plane/frame/tile_cut.h"

namespace steradian::plane::STERADIAN_ISA {
namespace {

STERADIAN_INLINE void add(float* p, PackReal x) { store(p, load(p) + x); }

// Where a disk with a range is seen, on one tile. Blocks of pixels are integrated end by end in loops of their own:
// without branches, many ends are under way at once.
struct DiskEnds {
  static constexpr int kRoom = 64;
  alignas(64) float d2[kTilePixels];  // the centre's distance squared, range 1
  alignas(64) float sum[kTilePixels];
  alignas(64) float slope[kRoom * kLanes];
  int pixel[kRoom];  // the first of the block
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

void add_ranged_disk(const TileLight& light, TileBuffer& tile, unsigned blocks) {
  DiskEnds ends;
  const PackReal inverse2 = broadcast(light.inverse_range * light.inverse_range);
  ends.rho2 = broadcast(light.radius * light.radius) * inverse2;
  int lit[kTilePixels / kLanes], lit_count = 0;
  for (int i = 0; i < kTilePixels; i += static_cast<int>(kLanes)) {
    if ((blocks >> (i / 16) & 1) == 0) continue;
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

// What an edge of a run sends from [from, to] of the run's slopes. power: 1 where emission falls with the cosine or the distance.
template <bool ranged, bool linear, int power>
class PartIntegral {
 public:
  STERADIAN_INLINE PartIntegral(const TileLight& light, const TilePart& part, const Axis& run) : light_(light), part_(part) {
    axis_.px = run.px;
    axis_.py = run.py;
    axis_.x = broadcast(-part.nx);
    axis_.y = broadcast(-part.ny);
    // Of the run's axis, seen from this one: a slope m of the run is the direction axis + m across.
    cosine_ = axis_.w(run.x, run.y);
    sine_ = axis_.t(run.x, run.y);
    d_ = max(axis_.w(broadcast(part.x) - axis_.px, broadcast(part.y) - axis_.py), PackReal(1e-6));
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
  }

  STERADIAN_INLINE void add(PackReal from, PackReal to) {
    from = max(own(from), low_);
    to = min(own(to), high_);
    if (!any_lane(to > from)) return;
    to = max(to, from);
    constant_ += antiderivative<0>(to) - antiderivative<0>(from);
    if (linear) slope_ += antiderivative<1>(to) - antiderivative<1>(from);
  }

  STERADIAN_INLINE void add_to(PackReal& red, PackReal& green, PackReal& blue) const {
    PackReal scale(0.159154943091895336);
    if (light_.profile == 2) scale *= inverse_d_;
    const PackReal constant = constant_ * scale, at_foot = (foot_ - broadcast(part_.begin)) * constant + slope_ * scale * d_;
    red += broadcast(part_.red) * constant + broadcast(part_.red_slope) * at_foot;
    green += broadcast(part_.green) * constant + broadcast(part_.green_slope) * at_foot;
    blue += broadcast(part_.blue) * constant + broadcast(part_.blue_slope) * at_foot;
  }

 private:
  // Of kinds that do not need the angle, the compiler leaves it out.
  template <int j>
  STERADIAN_INLINE PackReal antiderivative(PackReal t) const {
    PackKernels k;
    const PackReal f = k.trig_atan2(t, PackReal(1.0));
    return ranged ? k.plane_edge_integral(j, power, t, f, q_) : k.plane_term(j, power, t, f);
  }

  STERADIAN_INLINE PackReal own(PackReal m) const {
    const PackReal w = cosine_ - m * sine_, t = sine_ + m * cosine_;
    return slope(w, t, select(t > PackReal(0.0), PackReal(kBeyond), PackReal(-kBeyond)));
  }

  const TileLight& light_;
  const TilePart& part_;
  Axis axis_;
  PackReal cosine_, sine_, d_, inverse_d_, foot_, low_, high_, q_;
  PackReal constant_{0.0}, slope_{0.0};
};

// The same of an edge of uniform or linear radiance without a range that is small as every pixel sees it: between two points of it at
// distances r0 and r1, the angle is atan(cross / dot), and ln(r1 / r0), the integral of tan f, is atanh((r1^2 - r0^2) / (r1^2 + r0^2)).
// Both arguments are below 1/5, so that x^9 / 9 < 6e-8 is what their series leave out.
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
  // What lies between two slopes of the run.
  STERADIAN_INLINE void add(PackReal from, PackReal to) {
    const PackReal low = share_at(from), high = share_at(to), dx = x1_ - x0_, dy = y1_ - y0_;
    if (!any_lane(high > low)) return;
    const PackReal last = max(high, low);
    add_between(x0_ + low * dx, y0_ + low * dy, x0_ + last * dx, y0_ + last * dy);
  }
  STERADIAN_INLINE void add_to(PackReal& red, PackReal& green, PackReal& blue) const {
    const PackReal scale(0.159154943091895336), nx = broadcast(part_.nx), ny = broadcast(part_.ny);
    // Towards the edge is against its normal; along it is (ny, -nx).
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

// A function of its own for each kind of emission: inlined, they would take registers from the others.
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

// `whole`: blockers take nothing of it.
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
  // Fourth powers of slopes stay within float's range.
  cut.low = clamp((broadcast(light.begin) - foot) * inverse_d, PackReal(-kBeyond), PackReal(kBeyond));
  cut.high = clamp((broadcast(light.end) - foot) * inverse_d, PackReal(-kBeyond), PackReal(kBeyond));
  const PackReal q = d * d * broadcast(light.inverse_range * light.inverse_range);
  if (light.inverse_range > 0.0f && light.part_count == 0) {
    const PackReal reach = sqrt(max(PackReal(1.0) / max(q, PackReal(1e-30)) - PackReal(1.0), PackReal(0.0)));
    cut.low = max(cut.low, -reach);
    cut.high = min(cut.high, reach);
  }
  cut.high = select(lit, cut.high, cut.low);
  const PackReal low = cut.low, high = cut.high;
  if (cut.dark() || !cut_blockers(light, axis, cut)) return;
  if (light.part_count > 0) return add_parts(light, tile, i, axis, cut, cut.count == 0 && all_lanes(cut.low <= low && cut.high >= high));

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

// The slopes of an arc that face the pixels, by its tangents and ends.
STERADIAN_INLINE void open_arc(const TileLight& light, const UnitPoint& eye, Axis& axis, Cut& cut) {
  const TileArc& arc = light.arc;
  const TangentVectors t(light.shape, eye);
  if (arc.between_tangents) {
    const PackReal p = inversesqrt(max(t.px * t.px + t.py * t.py, PackReal(1e-30))),
                   q = inversesqrt(max(t.qx * t.qx + t.qy * t.qy, PackReal(1e-30)));
    axis.x = t.px * p + t.qx * q;
    axis.y = t.py * p + t.qy * q;
  } else {
    axis.x = broadcast(light.x) - axis.px;
    axis.y = broadcast(light.y) - axis.py;
  }
  cut.low = slope(axis.w(t.px, t.py), axis.t(t.px, t.py), PackReal(-kBeyond));
  cut.high = slope(axis.w(t.qx, t.qy), axis.t(t.qx, t.qy), PackReal(kBeyond));
  PackMask outside = eye.outside2 > PackReal(1e-6);
  if (!arc.whole) {
    // Seen from outside, the near side runs clockwise: the arc's first end is the high one.
    const PackMask first = eye.u * broadcast(arc.u0) + eye.v * broadcast(arc.v0) > PackReal(1.0),
                   last = eye.u * broadcast(arc.u1) + eye.v * broadcast(arc.v1) > PackReal(1.0);
    const PackReal d = sqrt(eye.outside2 + PackReal(1.0)), middle = eye.u * broadcast(arc.um) + eye.v * broadcast(arc.vm);
    cut.high = select(first, min(cut.high, slope_to({arc.x0, arc.y0}, axis)), cut.high);
    cut.low = select(last, max(cut.low, slope_to({arc.x1, arc.y1}, axis)), cut.low);
    outside = outside && (first || last || middle > broadcast(arc.least_cosine) * d);
  }
  cut.high = select(outside, cut.high, cut.low);
}

STERADIAN_INLINE void add_arc(const TileLight& light, TileBuffer& tile, int i) {
  Axis axis;
  axis.px = load(tile.x + i);
  axis.py = load(tile.y + i);
  const UnitPoint eye(light.shape, axis.px, axis.py);
  Cut cut;
  cut.kept = light.scratch;
  open_arc(light, eye, axis, cut);
  if (cut.dark() || !cut_blockers(light, axis, cut)) return;
  ArcSum sum;
  const bool plain = light.profile == 0 && light.inverse_range == 0.0f && !light.linear;
  const ArcIntegrand integrand(light, eye);
  cut.for_each_gap([&](PackReal from, PackReal to) {
    if (plain)
      sum.constant += PackKernels().trig_atan2_unwrapped(to - from, PackReal(1.0) + from * to);
    else
      integrand.add(axis, from, to, sum);
  });
  const PackReal scale(0.159154943091895336), constant = sum.constant * scale, ramp = sum.ramp * scale;
  add(tile.red + i, broadcast(light.red) * constant + broadcast(light.red_slope) * ramp);
  add(tile.green + i, broadcast(light.green) * constant + broadcast(light.green_slope) * ramp);
  add(tile.blue + i, broadcast(light.blue) * constant + broadcast(light.blue_slope) * ramp);
}

__attribute__((flatten)) void add_arcs(const TileLight& light, TileBuffer& tile, unsigned blocks) {
  for (int i = 0; i < kTilePixels; i += static_cast<int>(kLanes))
    if ((blocks >> (i / 16) & 1) != 0) add_arc(light, tile, i);
}

__attribute__((flatten)) void add_light(const TileLight& light, TileBuffer& tile, unsigned blocks) {
  if (light.kind == TileKind::arc) {
    add_arcs(light, tile, blocks);
    return;
  }
  const bool edge = light.kind == TileKind::edge;
  if (!edge && light.inverse_range > 0.0f) {
    add_ranged_disk(light, tile, blocks);
    return;
  }
  for (int i = 0; i < kTilePixels; i += static_cast<int>(kLanes)) {
    if ((blocks >> (i / 16) & 1) == 0) continue;
    if (edge)
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

}  // namespace steradian::plane::STERADIAN_ISA
