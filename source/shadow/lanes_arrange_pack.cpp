// The arrangement of arrangement.h for sixteen points at once: which segments cross, and the counts along them.
#include <cstring>

#include "shadow/lanes_pack.h"

STERADIAN_BEGIN_ISA
namespace {

using namespace shadow;

constexpr float kFar = 1e9f;

STERADIAN_INLINE std::uint32_t free_at(const SegmentLanes& s, int end) {
  return static_cast<std::uint32_t>(s.present) & ~static_cast<std::uint32_t>(end == 0 ? s.clipped_a : s.clipped_b);
}
STERADIAN_INLINE std::int32_t place_at(const SegmentLanes& s, int end) { return end == 0 ? s.place_a : s.place_b; }

// The lanes where two segments end in one vertex.
STERADIAN_INLINE std::uint32_t shared_ends(const SegmentLanes& e, const SegmentLanes& f) {
  std::uint32_t shared = 0;
  for (int i = 0; i < 2; ++i)
    for (int j = 0; j < 2; ++j)
      if (place_at(e, i) >= 0 && place_at(e, i) == place_at(f, j)) shared |= free_at(e, i) & free_at(f, j);
  return shared;
}

// Over the lanes of a mask: of values at(i).
template <class At>
STERADIAN_INLINE float least(std::uint32_t lanes, At at) {
  PackReal result(1e9);
  each_pack([&](std::size_t i) { result = min(result, select(mask_at(lanes, i), at(i), PackReal(1e9))); });
  return least_of(result);
}
template <class At>
STERADIAN_INLINE float largest(std::uint32_t lanes, At at) {
  return -least(lanes, [&](std::size_t i) { return -at(i); });
}

// Calls use(segment) for those whose boxes may meet a range, from the place `first` on.
template <class Use>
STERADIAN_INLINE void near(const BoxArrays& b, std::size_t count, std::size_t first, float low_x, float high_x, float low_y, float high_y,
                           Use use) {
  const PackReal lx = broadcast(low_x), hx = broadcast(high_x), ly = broadcast(low_y), hy = broadcast(high_y);
  for (std::size_t block = first / kPadding; block < padded(count) / kPadding; ++block) {
    if (b.block_low_y[block] > high_y || b.block_high_y[block] < low_y || b.block_low_x[block] > high_x || b.block_high_x[block] < low_x)
      continue;
    std::uint32_t bits = lane_bits([&](std::size_t i) {
      const std::size_t at = block * kPadding + i;
      return load(b.low_y + at) <= hy && load(b.high_y + at) >= ly && load(b.low_x + at) <= hx && load(b.high_x + at) >= lx;
    });
    if (first > block * kPadding) bits &= ~((1u << (first - block * kPadding)) - 1u);
    for_each_bit(bits, [&](std::size_t lane) { use(b.order[block * kPadding + lane]); });
  }
}

// Floats hold differences of cells exactly; a product is off by 2^-24 of itself, and so is the difference of two.
STERADIAN_INLINE PackReal bound_of(PackReal p, PackReal q) { return PackReal(4e-7) * (abs(p) + abs(q)); }

// In which lanes e and f may cross, as far as floats tell.
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

// Adds the crossing of e and f in some lanes; false: in none of them.
bool cross_pair(const LaneWork& work, std::uint32_t number_e, std::uint32_t number_f, std::uint32_t lanes, CrossingLanes& to) {
  const SegmentLanes &e = work.segments[number_e], &f = work.segments[number_f];
  // In double all is exact: differences below 2^24, products below 2^48. Floats keep the signs.
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
    // The least of six sizes is 0 where any is.
    add(tied, min(min(min(abs(is(ea)), abs(is(eb))), min(abs(is(fa)), abs(is(fb)))), min(abs(is(middle_e)), abs(is(middle_f)))) <= zero);
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
  to.e_to_left = narrow(e_to_left & mask);
  to.f_to_left = narrow(f_to_left & mask);
  to.after_e = narrow(after_e & mask);
  to.after_f = narrow(after_f & mask);
  for_each_bit(lanes & tied, [&](std::size_t lane) { work.exact.cross(work.exact.self, number_e, number_f, lane, to); });
  return to.mask != 0;
}

// What a ray to the left from e's middle counts, in some lanes.
LaneInts left_ray(const LaneWork& work, const LaneView& view, std::size_t event_count, std::uint32_t number, std::uint32_t lanes) {
  const SegmentLanes& e = work.segments[number];
  LaneReals mx, my;
  LaneInts result;
  each_pack([&](std::size_t i) {
    put(mx, i, get(e.ax, i) + get(e.bx, i));  // twice the middle: whole numbers below 2^24
    put(my, i, get(e.ay, i) + get(e.by, i));
    put(result, i, get(view.base, i));
  });
  for (std::size_t k = 0; k < event_count; ++k) {
    const std::uint32_t number_f = work.events[k];
    const SegmentLanes& f = work.segments[number_f];
    for (int end = 0; end < 2; ++end) {
      const std::uint32_t at = lanes & static_cast<std::uint32_t>(end == 0 ? f.left_a : f.left_b);
      if (at == 0) continue;
      std::uint32_t below = 0, level = 0;
      each_pack([&](std::size_t i) {
        const PackReal y = PackReal(2.0) * get(end == 0 ? f.ay : f.by, i), m = get(my, i);
        below |= bits_of(y < m) << i;
        level |= bits_of(y <= m && y >= m) << i;
      });
      for_each_bit(at & level, [&](std::size_t lane) {
        if (work.exact.event_below(work.exact.self, number, number_f, end, lane)) below |= 1u << lane;
      });
      each_pack([&](std::size_t i) {
        const PackInt w = where(mask_at(at & below, i), get(f.weight, i));
        put(result, i, end == 0 ? get(result, i) + w : get(result, i) - w);
      });
    }
  }
  const auto half = [](const LaneReals& r) { return [&r](std::size_t i) { return PackReal(0.5) * get(r, i); }; };
  const float high_x = largest(lanes, [&](std::size_t i) { return max(get(e.ax, i), get(e.bx, i)); });
  near(work.boxes, work.count, 0, -kFar, high_x, least(lanes, half(my)), largest(lanes, half(my)), [&](std::uint32_t number_f) {
    const SegmentLanes& f = work.segments[number_f];
    const std::uint32_t both = number_f == number ? 0 : lanes & static_cast<std::uint32_t>(f.present);
    if (both == 0) return;
    std::uint32_t uncertain = 0;
    each_pack([&](std::size_t i) {
      const PackReal two(2.0), zero(0.0), ax = get(f.ax, i), ay = get(f.ay, i), m = get(my, i);
      const PackReal start = two * ay, end = two * get(f.by, i);
      const PackMask here = mask_at(both, i), level = here && min(start, end) <= m && max(start, end) >= m;
      const PackReal p = (get(f.bx, i) - ax) * (m - start), q = (get(f.by, i) - ay) * (get(mx, i) - two * ax);
      const PackReal d = p - q, bound = bound_of(p, q);
      const PackMask rises = start < m && end > m, falls = start > m && end<m, left = d> bound, right = d < -bound;
      uncertain |= bits_of(level && !((rises || falls) && (left || right))) << i;
      const PackInt w = get(f.weight, i);
      PackInt sum = get(result, i);
      sum = sum - where(here && rises && right, w);
      sum = sum + where(here && falls && left, w);
      put(result, i, sum);
    });
    for_each_bit(uncertain, [&](std::size_t lane) { result.at[lane] += work.exact.left_ray(work.exact.self, number, number_f, lane); });
  });
  return result;
}

// Finds the counts of segments that others do not hand on.
void start_counts(const LaneWork& work, const LaneView& view, std::size_t event_count, std::uint32_t number) {
  SegmentLanes& e = work.segments[number];
  const std::uint32_t lanes = static_cast<std::uint32_t>(e.present) & ~static_cast<std::uint32_t>(e.known);
  const LaneInts count = left_ray(work, view, event_count, number, lanes);
  std::uint32_t up = 0, level = 0;
  each_pack([&](std::size_t i) {
    up |= bits_of(get(e.by, i) > get(e.ay, i)) << i;
    level |= bits_of(!(get(e.by, i) > get(e.ay, i)) && !(get(e.by, i) < get(e.ay, i))) << i;
  });
  for_each_bit(lanes & level, [&](std::size_t lane) {
    if (work.exact.runs_up(work.exact.self, number, lane)) up |= 1u << lane;
  });
  each_pack([&](std::size_t i) {
    // The count is on the -x side: e's left if it runs up.
    const PackInt at_middle = get(count, i) + where(mask_at(~up, i), get(e.weight, i));
    put(e.left, i, select(mask_at(lanes, i), at_middle - get(e.change_to_middle, i), get(e.left, i)));
  });
  e.known = e.present;
}

// Hands counts of e on to what goes on from one of its ends.
void hand_on(const LaneWork& work, std::uint32_t number, int end, std::size_t& depth) {
  const SegmentLanes& e = work.segments[number];
  const std::int32_t place = place_at(e, end);
  if (place < 0) return;
  const std::uint32_t from = static_cast<std::uint32_t>(e.known) & free_at(e, end) & work.shared_by_two[place];
  if (from == 0) return;
  for (std::uint32_t k = work.end_first[place]; k < work.end_first[place + 1]; ++k) {
    const std::uint32_t next = work.ends[k] / 2;
    const int at = static_cast<int>(work.ends[k] % 2);
    SegmentLanes& g = work.segments[next];
    if (next == number) continue;
    const std::uint32_t lanes = from & free_at(g, at) & ~static_cast<std::uint32_t>(g.known);
    if (lanes == 0) continue;
    each_pack([&](std::size_t i) {
      PackInt count = get(e.left, i);
      if (end == 1) count = count + get(e.change, i);
      // The same walk goes on, or g runs against it: then its left is e's right.
      if (end == at) count = count - get(e.weight, i);
      if (at == 1) count = count - get(g.change, i);
      put(g.left, i, select(mask_at(lanes, i), count, get(g.left, i)));
    });
    g.known = narrow(g.known | lanes);
    work.stack[depth++] = next;
  }
}

void list_crossings(const LaneWork& work) {
  std::uint32_t* first = work.crossing_first;
  std::memset(first, 0, (work.count + 1) * sizeof *first);
  for (std::size_t k = 0; k < work.crossings.size; ++k) {
    const CrossingLanes& c = work.crossings.data[k];
    ++first[c.e];
    ++first[c.f];
  }
  // To the lists' ends, from where filling goes back to their beginnings.
  for (std::size_t s = 1; s <= work.count; ++s) first[s] += first[s - 1];
  for (std::size_t k = work.crossings.size; k-- > 0;) {
    const CrossingLanes& c = work.crossings.data[k];
    work.crossing_list[--first[c.e]] = static_cast<std::uint32_t>(2 * k);
    work.crossing_list[--first[c.f]] = static_cast<std::uint32_t>(2 * k + 1);
    const auto change = [&](SegmentLanes& s, const SegmentLanes& by, std::uint32_t to_left, std::uint32_t after) {
      s.crossed = narrow(s.crossed | c.mask);
      each_pack([&](std::size_t i) {
        const PackInt w = get(by.weight, i), turn = where(mask_at(c.mask, i), select(mask_at(to_left, i), w, PackInt(0) - w));
        put(s.change, i, get(s.change, i) + turn);
        put(s.change_to_middle, i, get(s.change_to_middle, i) + where(mask_at(~after, i), turn));
      });
    };
    SegmentLanes &e = work.segments[c.e], &f = work.segments[c.f];
    change(e, f, c.e_to_left, c.after_e);
    change(f, e, c.f_to_left, c.after_f);
  }
}

void list_ends(const LaneWork& work) {
  std::uint32_t* first = work.end_first;
  std::memset(first, 0, (work.place_count + 1) * sizeof *first);
  const auto each_end = [&](auto use) {
    for (std::size_t s = work.count; s-- > 0;)
      for (int end = 0; end < 2; ++end)
        if (place_at(work.segments[s], end) >= 0) use(place_at(work.segments[s], end), static_cast<std::uint32_t>(2 * s) + (end != 0));
  };
  each_end([&](std::int32_t place, std::uint32_t) { ++first[place]; });
  for (std::size_t p = 1; p <= work.place_count; ++p) first[p] += first[p - 1];
  each_end([&](std::int32_t place, std::uint32_t number) { work.ends[--first[place]] = number; });
  for (std::size_t p = 0; p < work.place_count; ++p) {
    std::uint32_t once = 0, twice = 0, more = 0;
    for (std::uint32_t k = first[p]; k < first[p + 1]; ++k) {
      const std::uint32_t at = free_at(work.segments[work.ends[k] / 2], static_cast<int>(work.ends[k] % 2));
      more |= twice & at;
      twice |= once & at;
      once |= at;
    }
    work.shared_by_two[p] = narrow(twice & ~more);
  }
}

// Shell's sort: lists are short.
void sort(float* t, std::int32_t* change, std::size_t n) {
  for (const std::size_t gap : {std::size_t{301}, std::size_t{57}, std::size_t{10}, std::size_t{1}})
    for (std::size_t i = gap; i < n; ++i) {
      const float key = t[i];
      const std::int32_t value = change[i];
      std::size_t k = i;
      for (; k >= gap && t[k - gap] > key; k -= gap) {
        t[k] = t[k - gap];
        change[k] = change[k - gap];
      }
      t[k] = key;
      change[k] = value;
    }
}

// Cuts a segment where others cross it, in some lanes; false: no room.
bool cut(LaneWork& work, std::uint32_t number, std::uint32_t lanes) {
  const SegmentLanes& e = work.segments[number];
  const std::uint32_t first = work.crossing_first[number], last = work.crossing_first[number + 1];
  const std::size_t most = last - first;
  std::size_t counts[kPoints] = {}, all = 0;
  for (std::uint32_t k = first; k < last; ++k) {
    const CrossingLanes& c = work.crossings.data[work.crossing_list[k] / 2];
    const bool as_e = work.crossing_list[k] % 2 == 0;
    const SegmentLanes& by = work.segments[as_e ? c.f : c.e];
    const LaneReals& t = as_e ? c.t_e : c.t_f;
    const std::uint32_t to_left = as_e ? c.e_to_left : c.f_to_left;
    for_each_bit(lanes & static_cast<std::uint32_t>(c.mask), [&](std::size_t lane) {
      const std::size_t at = lane * most + counts[lane]++;
      work.sorted_t[at] = t.at[lane];
      work.sorted_change[at] = (to_left >> lane & 1) != 0 ? by.weight.at[lane] : -by.weight.at[lane];
      ++all;
    });
  }
  if (work.pieces.size + all + kPoints > work.pieces.capacity) return false;
  for_each_bit(lanes, [&](std::size_t lane) {
    const std::size_t n = counts[lane];
    float* places = work.sorted_t + lane * most;
    std::int32_t* changes = work.sorted_change + lane * most;
    sort(places, changes, n);
    const float ax = e.ax.at[lane], ay = e.ay.at[lane], dx = e.bx.at[lane] - ax, dy = e.by.at[lane] - ay;
    float t = 0, x = ax, y = ay;
    std::int32_t left = e.left.at[lane];
    const auto piece_to = [&](float next, float to_x, float to_y) {
      if (!(next > t)) return;
      work.pieces.data[work.pieces.size++] = {x, y, to_x, to_y, left, e.weight.at[lane], number, static_cast<std::uint16_t>(lane), false};
      t = next;
      x = to_x;
      y = to_y;
    };
    for (std::size_t k = 0; k < n; ++k) {
      const float next = places[k];
      piece_to(next, ax + next * dx, ay + next * dy);
      left += changes[k];
    }
    piece_to(1, e.bx.at[lane], e.by.at[lane]);
  });
  return true;
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
  for (std::size_t place = 0; place < work.count; ++place) {
    const std::uint32_t e = b.order[place];
    near(b, work.count, place + 1, b.low_x[place], b.high_x[place], b.low_y[place], b.high_y[place], [&](std::uint32_t f) {
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

__attribute__((flatten)) bool count_in_lanes(LaneWork& work, const LaneView& view) {
  std::size_t event_count = 0;
  for (std::size_t s = 0; s < work.count; ++s) {
    SegmentLanes& e = work.segments[s];
    e.known = e.crossed = e.bounds = 0;
    each_pack([&](std::size_t i) {
      put(e.left, i, PackInt(0));
      put(e.change, i, PackInt(0));
      put(e.change_to_middle, i, PackInt(0));
    });
    if ((e.left_a | e.left_b) != 0) work.events[event_count++] = static_cast<std::uint32_t>(s);
  }
  list_crossings(work);
  list_ends(work);
  for (std::uint32_t s = 0; s < work.count; ++s) {
    if (work.segments[s].known == work.segments[s].present) continue;
    start_counts(work, view, event_count, s);
    std::size_t depth = 0;
    work.stack[depth++] = s;
    while (depth > 0) {
      const std::uint32_t next = work.stack[--depth];
      hand_on(work, next, 0, depth);
      hand_on(work, next, 1, depth);
    }
  }
  work.pieces.size = 0;
  for (std::uint32_t s = 0; s < work.count; ++s) {
    const std::uint32_t lanes = static_cast<std::uint32_t>(work.segments[s].crossed) & static_cast<std::uint32_t>(work.segments[s].present);
    if (lanes != 0 && !cut(work, s, lanes)) return false;
  }
  return true;
}

STERADIAN_END_ISA
