#include "plane/exact/edge_rows.h"

#include <algorithm>
#include <cmath>

namespace steradian::plane {
namespace {

constexpr double kTouchingEnds = 1e-9;  // fraction of an edge's length

// Points that two edges share except their ends: a crossing, or ends of one that lie on the other.
void add_meetings(const PlaneEdge& e, const PlaneEdge& f, std::vector<Vec2d>& of_e, std::vector<Vec2d>& of_f) {
  const Vec2d d = e.b - e.a, g = f.b - f.a;
  const double c_side = cross(d, f.a - e.a), d_side = cross(d, f.b - e.a), a_side = cross(g, e.a - f.a), b_side = cross(g, e.b - f.a);
  const auto touch = [](Vec2d along, Vec2d from, Vec2d p, double side, std::vector<Vec2d>& to) {
    const double length2 = dot(along, along), at = dot(p - from, along);
    if (std::fabs(side) <= kTouchingEnds * length2 && at > kTouchingEnds * length2 && at < (1 - kTouchingEnds) * length2) to.push_back(p);
    return std::fabs(side) <= kTouchingEnds * length2;
  };
  bool touches = touch(d, e.a, f.a, c_side, of_e);
  touches = touch(d, e.a, f.b, d_side, of_e) || touches;
  touches = touch(g, f.a, e.a, a_side, of_f) || touches;
  touches = touch(g, f.a, e.b, b_side, of_f) || touches;
  if (touches || !(c_side * d_side < 0 && a_side * b_side < 0)) return;
  const Vec2d at = e.a + d * (a_side / (a_side - b_side));
  of_e.push_back(at);
  of_f.push_back(at);
}

}  // namespace

EdgeRows::EdgeRows(const std::vector<std::vector<Vec2d>>& contours) {
  double low = 1e300, high = -1e300;
  for (const auto& contour : contours)
    for (std::size_t i = 0; i < contour.size(); ++i) {
      const Vec2d a = contour[i], b = contour[i + 1 < contour.size() ? i + 1 : 0];
      if (a == b) continue;
      edges_.push_back({a, b});
      low = std::min({low, a.y, b.y});
      high = std::max({high, a.y, b.y});
    }
  if (edges_.empty()) return;
  low_ = low;
  high_ = high;
  // As many rows as edges, or fewer, so that tall edges do not fill all of them: at most eight entries for each edge.
  std::size_t rows = edges_.size(), entries = 0;
  for (;; rows = (rows + 1) / 2) {
    scale_ = high > low ? static_cast<double>(rows) / (high - low) : 0;
    first_.assign(rows + 1, 0);
    entries = 0;
    for (const PlaneEdge& e : edges_) entries += row(std::max(e.a.y, e.b.y)) - row(std::min(e.a.y, e.b.y)) + 1;
    if (rows == 1 || entries <= 8 * edges_.size()) break;
  }
  const auto for_each_row = [&](const PlaneEdge& e, auto call) {
    for (std::size_t r = row(std::min(e.a.y, e.b.y)); r <= row(std::max(e.a.y, e.b.y)); ++r) call(r);
  };
  for (const PlaneEdge& e : edges_) for_each_row(e, [&](std::size_t r) { ++first_[r + 1]; });
  for (std::size_t r = 0; r < rows; ++r) first_[r + 1] += first_[r];
  edge_.resize(entries);
  std::vector<std::size_t> next(first_.begin(), first_.end() - 1);
  for (std::size_t i = 0; i < edges_.size(); ++i)
    for_each_row(edges_[i], [&](std::size_t r) { edge_[next[r]++] = static_cast<std::uint32_t>(i); });
}

std::size_t EdgeRows::row(double y) const {
  return std::min(static_cast<std::size_t>(std::max((y - low_) * scale_, 0.0)), first_.size() - 2);
}

bool EdgeRows::contains(Vec2d p, bool even_odd) const {
  if (!(p.y >= low_ && p.y <= high_)) return false;
  Winding winding(p);
  const std::size_t r = row(p.y);
  for (std::size_t k = first_[r]; k < first_[r + 1]; ++k) winding.add(edges_[edge_[k]].a, edges_[edge_[k]].b);
  return winding.within(even_odd);
}

std::optional<EdgeRows::Meetings> EdgeRows::meetings() const {
  Meetings meetings(edges_.size());
  const std::size_t most = edges_.size() + 64;
  std::size_t count = 0, pairs_left = 500 * edges_.size() + 10'000;
  for (std::size_t r = 0; r + 1 < first_.size(); ++r)
    for (std::size_t i = first_[r]; i < first_[r + 1]; ++i) {
      const PlaneEdge& e = edges_[edge_[i]];
      const std::size_t first_row = row(std::min(e.a.y, e.b.y));
      for (std::size_t k = i + 1; k < first_[r + 1]; ++k) {
        if (pairs_left-- == 0) return {};
        const PlaneEdge& f = edges_[edge_[k]];
        // A pair is tested only in the first of the rows that contain both.
        if (r != std::max(first_row, row(std::min(f.a.y, f.b.y)))) continue;
        if (std::max(e.a.x, e.b.x) < std::min(f.a.x, f.b.x) || std::max(f.a.x, f.b.x) < std::min(e.a.x, e.b.x)) continue;
        std::vector<Vec2d>&of_e = meetings[edge_[i]], &of_f = meetings[edge_[k]];
        count -= of_e.size() + of_f.size();
        add_meetings(e, f, of_e, of_f);
        count += of_e.size() + of_f.size();
        if (count > most) return {};
      }
    }
  for (std::size_t i = 0; i < edges_.size(); ++i) {
    const Vec2d along = edges_[i].b - edges_[i].a;
    std::sort(meetings[i].begin(), meetings[i].end(), [&](Vec2d p, Vec2d q) { return dot(p, along) < dot(q, along); });
  }
  return meetings;
}

}  // namespace steradian::plane
