// Finds the segments that cross, for sixteen points at once.
#include "shadow/lanes/lanes_pack.h"

STERADIAN_BEGIN_ISA
namespace {

using namespace shadow;

// The lanes where two segments end in one vertex.
STERADIAN_INLINE std::uint32_t shared_ends(const SegmentLanes& e, const SegmentLanes& f) {
  std::uint32_t shared = 0;
  for (int i = 0; i < 2; ++i)
    for (int j = 0; j < 2; ++j)
      if (place_at(e, i) >= 0 && place_at(e, i) == place_at(f, j)) shared |= free_at(e, i) & free_at(f, j);
  return shared;
}

// Lanes in which e and f may cross, as far as floats tell.
STERADIAN_INLINE std::uint32_t may_cross(const SegmentLanes& e, const SegmentLanes& f) {
  return lane_bits([&](std::size_t i) {
    const PackReal fx = get(f.bx, i) - get(f.ax, i), fy = get(f.by, i) - get(f.ay, i);
    const PackReal ex = get(e.bx, i) - get(e.ax, i), ey = get(e.by, i) - get(e.ay, i);
    const PackReal px = get(e.ax, i) - get(f.ax, i), py = get(e.ay, i) - get(f.ay, i);
    const PackReal qx = px + ex, qy = py + ey, rx = fx - px, ry = fy - py;
    const auto side = [](PackReal dx, PackReal dy, PackReal x, PackReal y, PackReal& bound) {
      const PackReal p = dx * y, q = dy * x;
      bound = bound_of(p, q);
      return p - q;
    };
    PackReal ba, bb;
    const PackReal ea = side(fx, fy, px, py, ba), eb = side(fx, fy, qx, qy, bb);
    const PackMask misses_f = (ea > ba && eb > bb) || (ea < -ba && eb < -bb);
    const PackReal fa = side(ey, ex, py, px, ba), fb = side(ex, ey, rx, ry, bb);
    const PackMask misses_e = (fa > ba && fb > bb) || (fa < -ba && fb < -bb);
    return !(misses_f || misses_e);
  });
}

// Adds the crossing of e and f in some lanes; returns false if they cross in none.
bool cross_pair(const LaneWork& work, std::uint32_t number_e, std::uint32_t number_f, std::uint32_t lanes, CrossingLanes& to) {
  const SegmentLanes &e = work.segments[number_e], &f = work.segments[number_f];
  // Everything is exact in double: differences below 2^24, products below 2^48. Floats keep the signs.
  LaneReals ea, eb, fa, fb, middle_e, middle_f;
  for (std::size_t i = 0; i < kPoints; ++i) {
    const double fx = static_cast<double>(f.bx.at[i]) - static_cast<double>(f.ax.at[i]),
                 fy = static_cast<double>(f.by.at[i]) - static_cast<double>(f.ay.at[i]);
    const double ex = static_cast<double>(e.bx.at[i]) - static_cast<double>(e.ax.at[i]),
                 ey = static_cast<double>(e.by.at[i]) - static_cast<double>(e.ay.at[i]);
    const double px = static_cast<double>(e.ax.at[i]) - static_cast<double>(f.ax.at[i]),
                 py = static_cast<double>(e.ay.at[i]) - static_cast<double>(f.ay.at[i]);
    const double a = fx * py - fy * px, b = fx * (py + ey) - fy * (px + ex);
    const double c = ey * px - ex * py, d = ex * (fy - py) - ey * (fx - px);
    ea.at[i] = static_cast<float>(a);
    eb.at[i] = static_cast<float>(b);
    fa.at[i] = static_cast<float>(c);
    fb.at[i] = static_cast<float>(d);
    middle_e.at[i] = static_cast<float>(a + b);
    middle_f.at[i] = static_cast<float>(c + d);
    to.t_e.at[i] = static_cast<float>(a / (a - b));
    to.t_f.at[i] = static_cast<float>(c / (c - d));
  }
  std::uint32_t tied = 0, crosses = 0, e_to_left = 0, f_to_left = 0, after_e = 0, after_f = 0;
  const PackReal zero(0.0);
  each_pack([&](std::size_t i) {
    const auto is = [&](const LaneReals& r) { return get(r, i); };
    const auto add = [&](std::uint32_t& bits, const PackMask& m) { bits |= bits_of(m) << i; };
    const auto on_one_side = [&](const PackReal& a, const PackReal& b) { return (a > zero && b > zero) || (a < zero && b < zero); };
    const auto apart = [&](const LaneReals& a, const LaneReals& b, const LaneReals& c, const LaneReals& d) {
      return max(is(a), is(b)) < min(is(c), is(d)) || max(is(c), is(d)) < min(is(a), is(b));
    };
    // No infinitely small displacement brings these together. Most edges along one line, as buildings have them, are apart.
    const PackMask misses =
        on_one_side(is(ea), is(eb)) || on_one_side(is(fa), is(fb)) || apart(e.ax, e.bx, f.ax, f.bx) || apart(e.ay, e.by, f.ay, f.by);
    // The least of six absolute values is 0 if any of them is.
    add(tied, !misses && min(min(min(abs(is(ea)), abs(is(eb))), min(abs(is(fa)), abs(is(fb)))),
                             min(abs(is(middle_e)), abs(is(middle_f)))) <= zero);
    add(e_to_left, is(eb) > zero);
    add(f_to_left, is(fb) > zero);
    add(crosses, ((is(ea) > zero && is(eb) < zero) || (is(ea) < zero && is(eb) > zero)) &&
                     ((is(fa) > zero && is(fb) < zero) || (is(fa) < zero && is(fb) > zero)));
    add(after_e, (is(middle_e) > zero && is(eb) < zero) || (is(middle_e) < zero && is(eb) > zero));
    add(after_f, (is(middle_f) > zero && is(fb) < zero) || (is(middle_f) < zero && is(fb) > zero));
  });
  const std::uint32_t mask = lanes & crosses & ~tied;
  to.e = number_e;
  to.f = number_f;
  to.mask = narrow(mask);
  to.tied = narrow(lanes & tied);
  to.e_to_left = narrow(e_to_left & mask);
  to.f_to_left = narrow(f_to_left & mask);
  to.after_e = narrow(after_e & mask);
  to.after_f = narrow(after_f & mask);
  for_each_bit(lanes & tied, [&](std::size_t lane) { work.exact.cross(work.exact.self, number_e, number_f, lane, to); });
  return to.mask != 0;
}

}  // namespace

__attribute__((flatten)) void bound_in_lanes(const SegmentLanes* segments, std::size_t count, const BoxArrays& boxes) {
  for (std::size_t s = 0; s < count; ++s) {
    const SegmentLanes& e = segments[s];
    boxes.low_x[s] = least(e.present, [&](std::size_t i) { return min(get(e.ax, i), get(e.bx, i)); });
    boxes.high_x[s] = largest(e.present, [&](std::size_t i) { return max(get(e.ax, i), get(e.bx, i)); });
    boxes.low_y[s] = least(e.present, [&](std::size_t i) { return min(get(e.ay, i), get(e.by, i)); });
    boxes.high_y[s] = largest(e.present, [&](std::size_t i) { return max(get(e.ay, i), get(e.by, i)); });
  }
}

__attribute__((flatten)) bool cross_in_lanes(LaneWork& work) {
  const BoxArrays& b = work.boxes;
  work.crossings.size = 0;
  bool room = true;
  for (std::uint32_t e = 0; e < work.count; ++e) {
    near(b, work.count, e + 1, b.low_x[e], b.high_x[e], b.low_y[e], b.high_y[e], [&](std::uint32_t f) {
      const SegmentLanes &se = work.segments[e], &sf = work.segments[f];
      std::uint32_t lanes = static_cast<std::uint32_t>(se.present) & static_cast<std::uint32_t>(sf.present) & ~shared_ends(se, sf);
      if (lanes == 0) return;
      lanes &= may_cross(se, sf);
      if (lanes == 0) return;
      room = room && work.crossings.size < work.crossings.capacity;
      if (room && cross_pair(work, e, f, lanes, work.crossings.data[work.crossings.size])) ++work.crossings.size;
    });
    if (!room) return false;
  }
  return true;
}

STERADIAN_END_ISA
