// Counts along segments, for sixteen points at once: by rays to the left, and from segment to segment.
#include <cstring>

#include "shadow/lanes/lanes_pack.h"

STERADIAN_BEGIN_ISA
namespace {

using namespace shadow;

constexpr float kFar = 1e9f;

// Count of a ray to the left from e's middle, in some lanes.
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
      const PackMask here = mask_at(both, i);
      const PackMask level = here && min(start, end) <= m && max(start, end) >= m && two * min(ax, get(f.bx, i)) <= get(mx, i);
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

// Change of the count on a segment's left up to positions t on it, in some lanes. unsure: lanes where another crossing is too near to
// decide.
struct Before {
  LaneInts change;
  std::uint32_t unsure;
};
Before before(const LaneWork& work, std::uint32_t number, const LaneReals& t, std::uint32_t lanes) {
  const PackReal apart = broadcast(1e-6f);  // floats below 1 are 6e-8 off
  Before result;
  LaneInts close;
  each_pack([&](std::size_t i) {
    put(result.change, i, PackInt(0));
    put(close, i, PackInt(0));
  });
  for (std::uint32_t k = work.crossing_first[number]; k < work.crossing_first[number + 1]; ++k) {
    std::uint32_t nearer = 0;  // lanes that have not passed t
    each_pack([&](std::size_t i) {
      const PackReal d = get(work.sorted_t[k], i) - get(t, i);
      put(result.change, i, get(result.change, i) + where(d < PackReal(0.0), get(work.sorted_change[k], i)));
      put(close, i, get(close, i) + where(abs(d) <= apart, PackInt(1)));
      nearer |= bits_of(d <= apart) << i;
    });
    if ((nearer & lanes) == 0) break;
  }
  result.unsure = lane_bits([&](std::size_t i) { return get(close, i) > PackInt(1); });
  return result;
}

// Takes counts of a segment from the segments that it crosses, if those are known.
void take_across(const LaneWork& work, std::uint32_t number) {
  SegmentLanes& g = work.segments[number];
  for (std::uint32_t k = work.crossing_first[number]; k < work.crossing_first[number + 1] && g.known != g.present; ++k) {
    const CrossingLanes& c = work.crossings.data[work.crossing_list[k] / 2];
    const bool as_f = work.crossing_list[k] % 2 != 0;
    const std::uint32_t other = as_f ? c.e : c.f;
    const SegmentLanes& e = work.segments[other];
    std::uint32_t lanes = c.mask & e.known & ~static_cast<std::uint32_t>(g.known | e.tied | g.tied);
    if (lanes == 0) continue;
    const Before on_e = before(work, other, as_f ? c.t_e : c.t_f, lanes), on_g = before(work, number, as_f ? c.t_f : c.t_e, lanes);
    lanes &= ~(on_e.unsure | on_g.unsure);
    const std::uint32_t from_right = as_f ? c.e_to_left : c.f_to_left;  // e comes from g's right
    each_pack([&](std::size_t i) {
      // The count on e's left before the crossing is on g's right before g's crossing, or on g's left after it.
      const PackInt count = get(e.left, i) + get(on_e.change, i);
      const PackInt left_of_g = select(mask_at(from_right, i), count + get(g.weight, i), count - get(e.weight, i));
      put(g.left, i, select(mask_at(lanes, i), left_of_g - get(on_g.change, i), get(g.left, i)));
    });
    g.known = narrow(g.known | lanes);
  }
}

// Finds the counts of segments that receive none from others.
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
    // The count is on the -x side, which is e's left if e runs up.
    const PackInt at_middle = get(count, i) + where(mask_at(~up, i), get(e.weight, i));
    put(e.left, i, select(mask_at(lanes, i), at_middle - get(e.change_to_middle, i), get(e.left, i)));
  });
  e.known = e.present;
}

// Passes counts of e on to the segments that continue from one of its ends.
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
      // g goes on in the same direction, or it runs against it: then its left is e's right.
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
  // Sum up to the lists' ends, from which filling goes back to their beginnings.
  for (std::size_t s = 1; s <= work.count; ++s) first[s] += first[s - 1];
  for (std::size_t k = work.crossings.size; k-- > 0;) {
    const CrossingLanes& c = work.crossings.data[k];
    const auto add = [&](std::uint32_t number, std::uint32_t by, const LaneReals& t, std::uint32_t to_left, std::uint32_t after,
                         int which) {
      const std::uint32_t at = --first[number];
      work.crossing_list[at] = static_cast<std::uint32_t>(2 * k) + (which != 0);
      SegmentLanes& s = work.segments[number];
      s.crossed = narrow(s.crossed | c.mask);
      s.tied = narrow(s.tied | c.tied);
      each_pack([&](std::size_t i) {
        const PackMask here = mask_at(c.mask, i);
        const PackInt w = get(work.segments[by].weight, i), turn = where(here, select(mask_at(to_left, i), w, PackInt(0) - w));
        put(s.change, i, get(s.change, i) + turn);
        put(s.change_to_middle, i, get(s.change_to_middle, i) + where(mask_at(~after, i), turn));
        put(work.sorted_t[at], i, select(here, get(t, i), PackReal(2.0)));
        put(work.sorted_change[at], i, turn);
      });
    };
    add(c.f, c.e, c.t_f, c.f_to_left, c.after_f, 1);
    add(c.e, c.f, c.t_e, c.e_to_left, c.after_e, 0);
  }
}

// Sorts numbers with their associated values, each lane by itself.
// Source: Batcher's merge exchange; Knuth, The Art of Computer Programming, volume 3, section 5.2.2, algorithm M.
void sort(LaneReals* t, LaneInts* change, std::size_t n) {
  std::size_t top = 1;
  while (2 * top < n) top *= 2;
  const auto exchange = [&](std::size_t at, std::size_t with) {
    each_pack([&](std::size_t i) {
      const PackReal a = get(t[at], i), b = get(t[with], i);
      const PackInt of_a = get(change[at], i), of_b = get(change[with], i);
      const PackMask swap = b < a;
      put(t[at], i, min(a, b));
      put(t[with], i, max(a, b));
      put(change[at], i, select(swap, of_b, of_a));
      put(change[with], i, select(swap, of_a, of_b));
    });
  };
  for (std::size_t p = n > 1 ? top : 0; p > 0; p /= 2)
    for (std::size_t q = top, r = 0, d = p;; d = q - p, q /= 2, r = p) {
      for (std::size_t i = 0; i + d < n; ++i)
        if ((i & p) == r) exchange(i, i + d);
      if (q == p) break;
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

}  // namespace

__attribute__((flatten)) void count_in_lanes(LaneWork& work, const LaneView& view) {
  std::size_t event_count = 0;
  for (std::size_t s = 0; s < work.count; ++s) {
    SegmentLanes& e = work.segments[s];
    e.known = e.crossed = e.bounds = e.tied = 0;
    each_pack([&](std::size_t i) {
      put(e.left, i, PackInt(0));
      put(e.change, i, PackInt(0));
      put(e.change_to_middle, i, PackInt(0));
    });
    if ((e.left_a | e.left_b) != 0) work.events[event_count++] = static_cast<std::uint32_t>(s);
  }
  list_crossings(work);
  for (std::size_t s = 0; s < work.count; ++s) {
    const std::uint32_t first = work.crossing_first[s];
    sort(work.sorted_t + first, work.sorted_change + first, work.crossing_first[s + 1] - first);
  }
  list_ends(work);
  const auto go_on = [&](std::uint32_t from) {
    std::size_t depth = 0;
    work.stack[depth++] = from;
    while (depth > 0) {
      const std::uint32_t next = work.stack[--depth];
      hand_on(work, next, 0, depth);
      hand_on(work, next, 1, depth);
    }
  };
  const auto is_known = [&](std::uint32_t s) { return work.segments[s].known == work.segments[s].present; };
  // Start from the light's outline, which many segments cross. Use rays where no crossing leads. A solid light has its outline among the
  // edges.
  const std::uint32_t start = work.outline < work.count ? work.outline : 0;
  for (const int by_rays : {0, 1})
    for (std::uint32_t k = 0, s = start; k < work.count; ++k, s = s + 1 < work.count ? s + 1 : 0) {
      if (is_known(s)) continue;
      const LaneBits known = work.segments[s].known;
      take_across(work, s);
      if (!is_known(s) && (by_rays != 0 || k == 0)) start_counts(work, view, event_count, s);
      if (work.segments[s].known != known) go_on(s);
    }
}

STERADIAN_END_ISA
