// View from a place on a wall: for every direction in front of it, the curve that is hit first.
//
// Directions are slopes, normal + slope x along, from left to right of the half plane in front of the wall. They need no trigonometry, and
// parts that end in a common corner end at the same number.
#pragma once

#include <vector>

#include "plane/bounce/depth_order.h"
#include "plane/exact/envelope.h"

namespace steradian::plane {

struct SeenPart {
  double begin, end;  // slopes, rising
  const Curve* curve;
  bool back;  // is its inner face visible?
};

// The world for views from places on walls.
class Outlook {
 public:
  explicit Outlook(const World& world);

  // The view from a place on a curve, from outside of all bodies; the normal is a unit vector. The parts are sorted by rising slope, with
  // gaps where nothing is visible.
  void look(const Curve* own, Vec2d from, Vec2d normal, std::vector<SeenPart>& parts) const;

  std::size_t count() const { return world_.curves.size(); }

 private:
  const World& world_;
  DepthOrder order_;
  std::vector<const Curve*> others_;  // curves that are not in the order
};

// The unit direction of a slope.
inline Vec2d direction_of(double slope, Vec2d normal) {
  const Vec2d u = normal + Vec2d{-normal.y, normal.x} * slope;
  return u / length(u);
}

// The same part by angles: two if it crosses the angle pi.
struct SeenAngles {
  Visible parts[2];
  int count;
};
SeenAngles angles_of(const SeenPart& part, Vec2d normal);

}  // namespace steradian::plane
