#include "shadow/region/arrangement.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <optional>
#include <span>

namespace steradian::shadow {
namespace {

// A vertex (scale 1) or twice a midpoint (scale 2).
struct Doubled {
  std::int64_t x, y, dx, dy;
};
Doubled once(const SnappedVertex& c) { return {c.x, c.y, c.dx, c.dy}; }
Doubled midpoint(const Segment& e) {
  return {std::int64_t{e.a.x} + e.b.x, std::int64_t{e.a.y} + e.b.y, std::int64_t{e.a.dx} + e.b.dx, std::int64_t{e.a.dy} + e.b.dy};
}

// Terms of order 0, 1 and 2 of (f.b - f.a) x (p - f.a) in the displacement's e.
struct DisplacedSide {
  std::int64_t d0, d1, d2;
  int sign() const {
    const std::int64_t d = d0 != 0 ? d0 : d1 != 0 ? d1 : d2;
    return d < 0 ? -1 : 1;
  }
};

DisplacedSide side(const Segment& f, const Doubled& p, int scale) {
  const std::int64_t fx = f.b.x - f.a.x, fy = f.b.y - f.a.y, gx = f.b.dx - f.a.dx, gy = f.b.dy - f.a.dy;
  const std::int64_t px = p.x - std::int64_t{scale} * f.a.x, py = p.y - std::int64_t{scale} * f.a.y;
  const std::int64_t qx = p.dx - std::int64_t{scale} * f.a.dx, qy = p.dy - std::int64_t{scale} * f.a.dy;
  return {fx * py - fy * px, fx * qy - fy * qx + gx * py - gy * px, gx * qy - gy * qx};
}

// Returns true if a vertex lies above twice a midpoint's height.
bool above(const SnappedVertex& c, const Doubled& m) {
  const std::int64_t y = 2 * std::int64_t{c.y};
  return y > m.y || (y == m.y && 2 * std::int64_t{c.dy} > m.dy);
}

bool apart(const Segment& e, const Segment& f) {
  const auto out = [](std::int32_t ea, std::int32_t eb, std::int32_t fa, std::int32_t fb) {
    return std::max(ea, eb) < std::min(fa, fb) || std::max(fa, fb) < std::min(ea, eb);
  };
  return out(e.a.x, e.b.x, f.a.x, f.b.x) || out(e.a.y, e.b.y, f.a.y, f.b.y);
}

bool share_an_end(const Segment& e, const Segment& f) {
  return e.a.id == f.a.id || e.a.id == f.b.id || e.b.id == f.a.id || e.b.id == f.b.id;
}

// Segments that e or a left ray from its middle may cross: their heights overlap, and they do not lie to e's right. The bounds are stored
// apart from the segments, so that the compiler compares several at once.
class Neighbours {
 public:
  explicit Neighbours(const std::vector<Segment>& segments) : count_(segments.size()) {
    for (std::vector<std::int32_t>* v : {&low_, &high_, &left_}) v->resize(count_);
    for (std::size_t i = 0; i < count_; ++i) {
      const Segment& s = segments[i];
      low_[i] = std::min(s.a.y, s.b.y);
      high_[i] = std::max(s.a.y, s.b.y);
      left_[i] = std::min(s.a.x, s.b.x);
    }
    found_.resize(count_);
  }
  // Indices in ascending order.
  std::span<const std::uint32_t> of(const Segment& e) {
    const std::int32_t low = std::min(e.a.y, e.b.y), high = std::max(e.a.y, e.b.y), right = std::max(e.a.x, e.b.x);
    std::size_t n = 0;
    for (std::size_t i = 0; i < count_; ++i) {
      found_[n] = static_cast<std::uint32_t>(i);
      n += static_cast<std::size_t>((low_[i] <= high) & (high_[i] >= low) & (left_[i] <= right));
    }
    return {found_.data(), n};
  }

 private:
  std::size_t count_;
  std::vector<std::int32_t> low_, high_, left_;
  std::vector<std::uint32_t> found_;
};

double place_between(const DisplacedSide& from, const DisplacedSide& to) {
  const auto at = [](std::int64_t a, std::int64_t b) { return static_cast<double>(a) / static_cast<double>(a - b); };
  return std::clamp(from.d0 != to.d0 ? at(from.d0, to.d0) : from.d1 != to.d1 ? at(from.d1, to.d1) : 0.5, 0.0, 1.0);
}

}  // namespace

bool runs_up(const Segment& e) { return e.b.y > e.a.y || (e.b.y == e.a.y && e.b.dy > e.a.dy); }

bool cross(const Segment& e, const Segment& f, CrossingPair& result) {
  if (share_an_end(e, f) || apart(e, f)) return false;
  const DisplacedSide ea = side(f, once(e.a), 1), eb = side(f, once(e.b), 1);
  if (ea.sign() == eb.sign()) return false;
  const DisplacedSide fa = side(e, once(f.a), 1), fb = side(e, once(f.b), 1);
  if (fa.sign() == fb.sign()) return false;
  const auto crossing = [](const Segment& g, const Segment& by, const DisplacedSide& from, const DisplacedSide& to) -> Crossing {
    return {side(by, midpoint(g), 2).sign() != to.sign(), place_between(from, to), to.sign() > 0 ? by.weight : -by.weight};
  };
  result = {crossing(e, f, ea, eb), crossing(f, e, fa, fb)};
  return true;
}

int side_of(const Segment& f, const SnappedVertex& p) { return side(f, once(p), 1).sign(); }
int side_of_midpoint(const Segment& f, const Segment& e) { return side(f, midpoint(e), 2).sign(); }

namespace {

// Change that f adds to the count of a left ray. middle: side of f on which the ray starts.
std::int32_t left_ray_crosses(const Segment& f, int middle, bool start_above, bool end_above) {
  if (start_above == end_above) return 0;
  // f runs upwards with m on its right: the way from the left to m leads from f's left to its right.
  if (end_above && middle < 0) return -f.weight;
  if (start_above && middle > 0) return f.weight;
  return 0;
}

bool lies_below(const LeftEvent& event, const Doubled& m) {
  const std::int64_t y = 2 * std::int64_t{event.y};
  return y < m.y || (y == m.y && 2 * std::int64_t{event.dy} < m.dy);
}

std::int32_t count_at_the_box(const SegmentSet& set, const Doubled& m) {
  std::int32_t count = set.base;
  for (const LeftEvent& event : set.events)
    if (lies_below(event, m)) count += event.weight;
  return count;
}

bool has_pieces(const Segment& e) { return e.weight != 0 && (e.a.x != e.b.x || e.a.y != e.b.y); }

// left: count on the left at e's start.
void add_pieces(const Segment& e, std::uint32_t number, std::int32_t left, const Crossing* begin, const Crossing* end,
                std::vector<Piece>& pieces) {
  const double fx = e.b.x - e.a.x, fy = e.b.y - e.a.y;
  const auto at_x = [&](double s) { return s == 1 ? e.b.x : e.a.x + s * fx; };
  const auto at_y = [&](double s) { return s == 1 ? e.b.y : e.a.y + s * fy; };
  double t = 0, x = e.a.x, y = e.a.y;
  const auto piece_to = [&](double next) {
    if (!(next > t)) return;
    const double to_x = at_x(next), to_y = at_y(next);
    pieces.push_back({x, y, to_x, to_y, left, left - e.weight, number});
    t = next;
    x = to_x;
    y = to_y;
  };
  for (const Crossing* c = begin; c != end; ++c) {
    piece_to(c->t);
    left += c->change;
  }
  piece_to(1);
}

// Count on e's left at its start, from the count of the left ray. The ray counts the -x side, which is e's left if e runs up.
std::int32_t left_at_start(const Segment& e, std::int32_t count, const Crossing* begin, const Crossing* end) {
  std::int32_t left = runs_up(e) ? count : count + e.weight;
  for (const Crossing* c = begin; c != end; ++c)
    if (!c->after) left -= c->change;
  return left;
}

}  // namespace

std::int32_t left_ray_crosses(const Segment& e, const Segment& f) {
  const Doubled m = midpoint(e);
  const bool start_above = above(f.a, m), end_above = above(f.b, m);
  return start_above == end_above ? 0 : left_ray_crosses(f, side(f, m, 2).sign(), start_above, end_above);
}

bool lies_below_middle(const LeftEvent& event, const Segment& e) { return lies_below(event, midpoint(e)); }

void arrange(const SegmentSet& set, std::vector<Piece>& pieces) {
  pieces.clear();
  std::vector<Crossing> crossings;
  Neighbours neighbours(set.segments);
  for (std::uint32_t i = 0; i < set.segments.size(); ++i) {
    const Segment& e = set.segments[i];
    if (!has_pieces(e)) continue;
    const Doubled m = midpoint(e);
    std::int32_t count = count_at_the_box(set, m);
    crossings.clear();
    for (const std::uint32_t j : neighbours.of(e)) {
      if (j == i) continue;
      const Segment& f = set.segments[j];
      const bool start_above = above(f.a, m), end_above = above(f.b, m);
      if (start_above == end_above && apart(e, f)) continue;
      const int middle = side(f, m, 2).sign();
      count += left_ray_crosses(f, middle, start_above, end_above);
      CrossingPair pair;
      if (cross(e, f, pair)) crossings.push_back(pair.on_e);
    }
    std::sort(crossings.begin(), crossings.end());
    const Crossing *begin = crossings.data(), *end = begin + crossings.size();
    add_pieces(e, i, left_at_start(e, count, begin, end), begin, end, pieces);
  }
}

void SegmentArrays::sort(const SegmentSet& set) {
  constexpr std::size_t kFew = 32, kRows = 64;
  constexpr std::int32_t kRow = 2 * kCells / static_cast<std::int32_t>(kRows), kLong = 2 * kRow;
  const auto n = static_cast<std::uint32_t>(set.segments.size());
  order.resize(n);
  place.resize(n);
  if (n <= kFew) {
    std::iota(order.begin(), order.end(), 0u);
    std::iota(place.begin(), place.end(), 0u);
    return;
  }
  // Counting sort into rows of the box; row 0 holds the long segments.
  std::array<std::uint32_t, kRows + 2> first{};
  const auto row_of = [&](const Segment& s) {
    const std::int32_t low = std::min(s.a.y, s.b.y), high = std::max(s.a.y, s.b.y);
    return high - low > kLong ? std::size_t{0} : 1 + std::min(static_cast<std::size_t>((low + kCells) / kRow), kRows - 1);
  };
  for (const Segment& s : set.segments) ++first[row_of(s) + 1];
  std::partial_sum(first.begin(), first.end(), first.begin());
  for (std::uint32_t i = 0; i < n; ++i) order[place[i] = first[row_of(set.segments[i])]++] = i;
}

void SegmentArrays::assign(const SegmentSet& set) {
  constexpr float kFar = 1e9f;
  sort(set);
  const std::size_t n = set.segments.size(), room = padded(n), blocks = room / kPadding;
  for (std::vector<float>* v : {&ax, &ay, &bx, &by}) v->resize(room);
  weight.resize(room);
  found.resize(room);
  block_low.assign(blocks, kFar);
  block_high.assign(blocks, -kFar);
  block_left.assign(blocks, kFar);
  block_right.assign(blocks, -kFar);
  for (std::size_t i = 0; i < n; ++i) {
    const Segment& s = set.segments[order[i]];
    ax[i] = static_cast<float>(s.a.x);
    ay[i] = static_cast<float>(s.a.y);
    bx[i] = static_cast<float>(s.b.x);
    by[i] = static_cast<float>(s.b.y);
    weight[i] = s.weight;
    const std::size_t block = i / kPadding;
    block_low[block] = std::min(block_low[block], std::min(ay[i], by[i]));
    block_high[block] = std::max(block_high[block], std::max(ay[i], by[i]));
    block_left[block] = std::min(block_left[block], std::min(ax[i], bx[i]));
    block_right[block] = std::max(block_right[block], std::max(ax[i], bx[i]));
  }
  for (std::size_t i = n; i < room; ++i) {
    ax[i] = ay[i] = bx[i] = by[i] = kFar;
    weight[i] = 0;
  }
}

namespace {

// Segments by vertex. At a vertex that exactly two segments share, the counts on their sides carry over from one to the other.
class Chains {
 public:
  void assign(const std::vector<Segment>& segments) {
    std::int32_t most = -1;
    for (const Segment& s : segments) most = std::max({most, s.place_a, s.place_b});
    vertices_.assign(static_cast<std::size_t>(most + 1), {});
    for (std::uint32_t i = 0; i < segments.size(); ++i)
      for (const std::int32_t place : {segments[i].place_a, segments[i].place_b})
        if (place >= 0) {
          ++vertices_[static_cast<std::size_t>(place)].degree;
          vertices_[static_cast<std::size_t>(place)].both ^= i;
        }
  }
  // The other segment at a vertex that exactly two share, else none.
  std::optional<std::uint32_t> other(std::int32_t place, std::uint32_t segment) const {
    if (place < 0 || vertices_[static_cast<std::size_t>(place)].degree != 2) return {};
    return vertices_[static_cast<std::size_t>(place)].both ^ segment;
  }

 private:
  struct Vertex {
    std::uint32_t degree = 0, both = 0;  // both: exclusive or of two segments' numbers
  };
  std::vector<Vertex> vertices_;
};

// A segment's range in the list of crossings, and its count.
struct Along {
  std::size_t first = 0, count = 0;
  std::int32_t change = 0;  // sum over all crossings
  std::int32_t left = 0;    // count at the start
  bool known = false;
};

}  // namespace

void arrange(const ShadowTable& packs, const SegmentSet& set, SegmentArrays& arrays, std::vector<Piece>& pieces) {
  pieces.clear();
  arrays.assign(set);
  const SegmentView view = arrays.view();
  thread_local Chains chains;
  struct Found {
    std::uint32_t segment;
    Crossing crossing;
  };
  thread_local std::vector<Found> found_crossings;
  thread_local std::vector<Crossing> crossings;
  thread_local std::vector<Along> along;
  chains.assign(set.segments);
  found_crossings.clear();
  along.assign(set.segments.size(), {});
  std::uint32_t* found = arrays.found.data();
  for (std::uint32_t place = 0; place < set.segments.size(); ++place) {
    const std::uint32_t i = arrays.order[place];
    const std::size_t count = packs.may_cross(view, place, found);
    for (std::size_t k = 0; k < count; ++k) {
      const std::uint32_t j = arrays.order[found[k]];
      CrossingPair pair;
      if (!cross(set.segments[i], set.segments[j], pair)) continue;
      found_crossings.push_back({i, pair.on_e});
      found_crossings.push_back({j, pair.on_f});
    }
  }
  // Sort the crossings into one list per segment.
  for (const Found& f : found_crossings) ++along[f.segment].count;
  std::size_t first = 0;
  for (Along& a : along) {
    a.first = first;
    first += a.count;
    a.count = 0;
  }
  crossings.resize(first);
  for (const Found& f : found_crossings) {
    Along& a = along[f.segment];
    crossings[a.first + a.count++] = f.crossing;
    a.change += f.crossing.change;
  }
  for (const Along& a : along)
    if (a.count > 1)
      std::sort(crossings.begin() + static_cast<std::ptrdiff_t>(a.first),
                crossings.begin() + static_cast<std::ptrdiff_t>(a.first + a.count));

  // Passes the count of a segment on along its chain, from its end or from its start.
  const auto hand_on = [&](std::uint32_t i, bool from_end) {
    while (true) {
      const Segment& e = set.segments[i];
      const std::optional<std::uint32_t> next = chains.other(from_end ? e.place_b : e.place_a, i);
      if (!next || along[*next].known) return;
      const Segment& g = set.segments[*next];
      const std::int32_t left = along[i].left + (from_end ? along[i].change : 0), right = left - e.weight;
      const bool at_start = g.place_a == (from_end ? e.place_b : e.place_a);
      // g goes on in the same direction, or it runs against it: then its left is e's right.
      const std::int32_t of_g = at_start == from_end ? left : right;
      along[*next].left = at_start ? of_g : of_g - along[*next].change;
      along[*next].known = true;
      i = *next;
      from_end = at_start;
    }
  };
  for (std::uint32_t i = 0; i < set.segments.size(); ++i) {
    if (along[i].known) continue;
    const Segment& e = set.segments[i];
    const Doubled m = midpoint(e);
    const LeftRay ray = packs.left_ray(view, arrays.place[i], found);
    std::int32_t count = count_at_the_box(set, m) + ray.count;
    for (std::size_t k = 0; k < ray.uncertain; ++k) {
      const std::uint32_t j = arrays.order[found[k]];
      if (j == i) continue;
      const Segment& f = set.segments[j];
      const bool start_above = above(f.a, m), end_above = above(f.b, m);
      if (start_above != end_above) count += left_ray_crosses(f, side(f, m, 2).sign(), start_above, end_above);
    }
    const Crossing* begin = crossings.data() + along[i].first;
    along[i].left = left_at_start(e, count, begin, begin + along[i].count);
    along[i].known = true;
    hand_on(i, true);
    hand_on(i, false);
  }
  for (std::uint32_t i = 0; i < set.segments.size(); ++i) {
    if (!has_pieces(set.segments[i])) continue;
    const Crossing* begin = crossings.data() + along[i].first;
    add_pieces(set.segments[i], i, along[i].left, begin, begin + along[i].count, pieces);
  }
}

std::int32_t count_at(const SegmentSet& set, double x, double y) {
  std::int32_t count = set.base;
  for (const LeftEvent& event : set.events)
    if (event.y < y) count += event.weight;
  for (const Segment& f : set.segments) {
    const bool start_above = f.a.y > y, end_above = f.b.y > y;
    if (start_above == end_above) continue;
    const double fx = f.b.x - f.a.x, fy = f.b.y - f.a.y;
    const double d = fx * (y - f.a.y) - fy * (x - f.a.x);
    if (end_above && d < 0) count -= f.weight;
    if (start_above && d > 0) count += f.weight;
  }
  return set.layered ? without_layers(count) : count;
}

}  // namespace steradian::shadow
