// PlaneRegion: the part of a flat light that a point sees, in the light's plane, and how much of it lies in a rectangle.
#pragma once

#include <vector>

#include "core/box.h"
#include "steradian/vector2.h"

namespace steradian {

class PlaneRegion {
 public:
  void clear() { edges_.clear(); }
  // Adds an edge of the boundary; the region lies on its left. Edges come in any order.
  void add(Vec2d a, Vec2d b) { edges_.push_back({a, b}); }
  // Area of the region's part in a rectangle. Negative if the edges run the other way round.
  double area_in(const Box2d& box) const;
  // The same area with its centroid; the centroid is the rectangle's middle where the area is 0.
  struct Part {
    double area;
    Vec2d centroid;
  };
  Part part_in(const Box2d& box) const;
  // The edges within a row, for all of its rectangles. It keeps the memory of `row`.
  void cut_row(double low, double high, PlaneRegion& row) const;
  // The region in coordinates whose x axis is the unit vector `x`.
  PlaneRegion turned(Vec2d x) const;
  Box2d bounds() const;

 private:
  struct BoundaryEdge {
    Vec2d a, b;
  };
  std::vector<BoundaryEdge> edges_;
};

}  // namespace steradian
