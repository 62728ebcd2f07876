#include "plane/exact/edge_rows.h"

#include <algorithm>
#include <cmath>

namespace steradian::plane {
namespace {

bool crosses_properly(const Edge& e, const Edge& f) {
  const double c_side = cross(e.b - e.a, f.a - e.a), d_side = cross(e.b - e.a, f.b - e.a);
  const double a_side = cross(f.b - f.a, e.a - f.a), b_side = cross(f.b - f.a, e.b - f.a);
  return c_side * d_side < 0 && a_side * b_side < 0;
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
  // As many rows as edges, or fewer, so that tall edges do not fill all of them: at most eight entries an edge.
  std::size_t rows = edges_.size(), entries = 0;
  for (;; rows = (rows + 1) / 2) {
    scale_ = high > low ? static_cast<double>(rows) / (high - low) : 0;
    first_.assign(rows + 1, 0);
    entries = 0;
    for (const Edge& e : edges_) entries += row(std::max(e.a.y, e.b.y)) - row(std::min(e.a.y, e.b.y)) + 1;
    if (rows == 1 || entries <= 8 * edges_.size()) break;
  }
  const auto for_each_row = [&](const Edge& e, auto call) {
    for (std::size_t r = row(std::min(e.a.y, e.b.y)); r <= row(std::max(e.a.y, e.b.y)); ++r) call(r);
  };
  for (const Edge& e : edges_) for_each_row(e, [&](std::size_t r) { ++first_[r + 1]; });
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

bool EdgeRows::may_cross() const {
  if (edges_.empty()) return false;
  std::size_t pairs_left = 500 * edges_.size() + 10'000;
  for (std::size_t r = 0; r + 1 < first_.size(); ++r)
    for (std::size_t i = first_[r]; i < first_[r + 1]; ++i) {
      const Edge& e = edges_[edge_[i]];
      for (std::size_t k = i + 1; k < first_[r + 1]; ++k) {
        if (pairs_left-- == 0) return true;
        if (crosses_properly(e, edges_[edge_[k]])) return true;
      }
    }
  return false;
}

}  // namespace steradian::plane
