#include "shadow/arrangement.h"

#include <algorithm>
#include <span>

namespace steradian::shadow {
namespace {

// A vertex, or twice a midpoint: scale is 1 or 2.
struct Doubled {
  std::int64_t x, y, dx, dy;
};
Doubled once(const Cell& c) { return {c.x, c.y, c.dx, c.dy}; }
Doubled midpoint(const Segment& e) {
  return {std::int64_t{e.a.x} + e.b.x, std::int64_t{e.a.y} + e.b.y, std::int64_t{e.a.dx} + e.b.dx, std::int64_t{e.a.dy} + e.b.dy};
}

// The three orders of (f.b - f.a) x (p - f.a) in the displacement's e.
struct Side {
  std::int64_t d0, d1, d2;
  int sign() const {
    const std::int64_t d = d0 != 0 ? d0 : d1 != 0 ? d1 : d2;
    return d < 0 ? -1 : 1;
  }
};

Side side(const Segment& f, const Doubled& p, int scale) {
  const std::int64_t fx = f.b.x - f.a.x, fy = f.b.y - f.a.y, gx = f.b.dx - f.a.dx, gy = f.b.dy - f.a.dy;
  const std::int64_t px = p.x - std::int64_t{scale} * f.a.x, py = p.y - std::int64_t{scale} * f.a.y;
  const std::int64_t qx = p.dx - std::int64_t{scale} * f.a.dx, qy = p.dy - std::int64_t{scale} * f.a.dy;
  return {fx * py - fy * px, fx * qy - fy * qx + gx * py - gy * px, gx * qy - gy * qx};
}

// Whether a vertex lies above twice a midpoint's height.
bool above(const Cell& c, const Doubled& m) {
  const std::int64_t y = 2 * std::int64_t{c.y};
  return y > m.y || (y == m.y && 2 * std::int64_t{c.dy} > m.dy);
}

bool runs_up(const Segment& e) { return e.b.y > e.a.y || (e.b.y == e.a.y && e.b.dy > e.a.dy); }

bool apart(const Segment& e, const Segment& f) {
  const auto out = [](std::int32_t ea, std::int32_t eb, std::int32_t fa, std::int32_t fb) {
    return std::max(ea, eb) < std::min(fa, fb) || std::max(fa, fb) < std::min(ea, eb);
  };
  return out(e.a.x, e.b.x, f.a.x, f.b.x) || out(e.a.y, e.b.y, f.a.y, f.b.y);
}

bool share_an_end(const Segment& e, const Segment& f) {
  return e.a.id == f.a.id || e.a.id == f.b.id || e.b.id == f.a.id || e.b.id == f.b.id;
}

// The segments that e may cross or that a ray to the left from its middle may: those whose heights it shares and that do not lie
// to its right. Kept apart from the segments, so that the compiler compares several at once.
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
  // Ascending.
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

struct Crossing {
  bool after;  // e's midpoint
  double t;
  std::int32_t change;
  bool operator<(const Crossing& c) const { return after != c.after ? c.after : t < c.t; }
};

// Where f crosses e, whose midpoint lies on the given side of f.
bool crossing_of(const Segment& e, const Segment& f, int middle, Crossing& result) {
  if (share_an_end(e, f) || apart(e, f)) return false;
  const Side a = side(f, once(e.a), 1), b = side(f, once(e.b), 1);
  if (a.sign() == b.sign()) return false;
  if (side(e, once(f.a), 1).sign() == side(e, once(f.b), 1).sign()) return false;
  const auto at = [](std::int64_t from, std::int64_t to) { return static_cast<double>(from) / static_cast<double>(from - to); };
  result.t = a.d0 != b.d0 ? at(a.d0, b.d0) : a.d1 != b.d1 ? at(a.d1, b.d1) : 0.5;
  result.t = std::clamp(result.t, 0.0, 1.0);
  result.change = b.sign() > 0 ? f.weight : -f.weight;
  result.after = middle != b.sign();
  return true;
}

}  // namespace

int side_of(const Segment& f, const Cell& p) { return side(f, once(p), 1).sign(); }
int side_of_midpoint(const Segment& f, const Segment& e) { return side(f, midpoint(e), 2).sign(); }

void arrange(const SegmentSet& set, std::vector<Piece>& pieces) {
  pieces.clear();
  thread_local std::vector<Crossing> crossings;
  Neighbours neighbours(set.segments);
  for (std::uint32_t i = 0; i < set.segments.size(); ++i) {
    const Segment& e = set.segments[i];
    if (e.weight == 0 || (e.a.x == e.b.x && e.a.y == e.b.y)) continue;
    const Doubled m = midpoint(e);
    std::int32_t count = set.base;
    for (const LeftEvent& event : set.events) {
      const std::int64_t y = 2 * std::int64_t{event.y};
      if (y < m.y || (y == m.y && 2 * std::int64_t{event.dy} < m.dy)) count += event.weight;
    }
    crossings.clear();
    for (const std::uint32_t j : neighbours.of(e)) {
      if (j == i) continue;
      const Segment& f = set.segments[j];
      const bool start_above = above(f.a, m), end_above = above(f.b, m);
      const bool apart_from_ray = start_above == end_above;
      if (apart_from_ray && apart(e, f)) continue;
      const int middle = side(f, m, 2).sign();
      // Upwards with m on its right: the way from the left to m goes from its left to its right.
      if (!apart_from_ray) {
        if (end_above && middle < 0) count -= f.weight;
        if (start_above && middle > 0) count += f.weight;
      }
      Crossing crossing;
      if (crossing_of(e, f, middle, crossing)) crossings.push_back(crossing);
    }
    std::sort(crossings.begin(), crossings.end());

    // `count` is that on the -x side at the midpoint: e's left if e runs up.
    std::int32_t left = runs_up(e) ? count : count + e.weight;
    for (const Crossing& c : crossings)
      if (!c.after) left -= c.change;
    double t = 0;
    const auto piece_to = [&](double end) {
      if (!(end > t)) return;
      const double fx = e.b.x - e.a.x, fy = e.b.y - e.a.y;
      const auto at_x = [&](double s) { return s == 1 ? e.b.x : e.a.x + s * fx; };
      const auto at_y = [&](double s) { return s == 1 ? e.b.y : e.a.y + s * fy; };
      pieces.push_back({at_x(t), at_y(t), at_x(end), at_y(end), left, left - e.weight, i});
      t = end;
    };
    for (const Crossing& c : crossings) {
      piece_to(c.t);
      left += c.change;
    }
    piece_to(1);
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
  return count;
}

}  // namespace steradian::shadow
