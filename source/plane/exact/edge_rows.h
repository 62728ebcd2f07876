// The edges of a filled outline by the rows that they cross. They answer if a point is within, and if edges cross each other.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "steradian/plane.h"

namespace steradian::plane {

struct PlaneEdge {
  Vec2d a, b;
};

class EdgeRows {
 public:
  EdgeRows() = default;
  explicit EdgeRows(const std::vector<std::vector<Vec2d>>& contours);

  bool contains(Vec2d p, bool even_odd) const;

  // By edge, without edges of zero length: the points at which others cross it or touch it, other than at its ends, in the order from a to
  // b. Two edges that cross have the same point. The search tests no more than a few hundred pairs for each edge, for one meeting of each
  // edge. It returns nothing if that is not enough.
  using Meetings = std::vector<std::vector<Vec2d>>;
  std::optional<Meetings> meetings() const;

 private:
  std::size_t row(double y) const;

  std::vector<PlaneEdge> edges_;
  std::vector<std::size_t> first_;   // by row, and one more: start of its edges in
  std::vector<std::uint32_t> edge_;  // numbers of edges
  double low_ = 0, high_ = -1, scale_ = 0;
};

// Accumulates the contribution of edges, one after the other, to a point's winding number and to its crossings.
class Winding {
 public:
  explicit Winding(Vec2d at) : at_(at) {}
  void add(Vec2d from, Vec2d to) {
    const Vec2d a = from - at_, b = to - at_;
    const double side = cross(a, b);
    if (side == 0 && dot(a, b) <= 0) on_edge_ = true;
    if ((a.y <= 0) == (b.y <= 0) || (b.y > a.y) != (side > 0)) return;
    winding_ += b.y > a.y ? 1 : -1;
    ++crossings_;
  }
  bool within(bool even_odd) const { return on_edge_ || (even_odd ? crossings_ % 2 != 0 : winding_ != 0); }

 private:
  Vec2d at_;
  int winding_ = 0, crossings_ = 0;
  bool on_edge_ = false;
};

}  // namespace steradian::plane
