// What a place on a wall sees in front of it: in every direction, the curve that is hit first.
//
// Directions are slopes, normal + slope x along, from left to right of the half plane in front of the wall: they need no trigonometry, and
// what ends in a common corner ends in the same number.
#pragma once

#include <vector>

#include "plane/bounce/depth_order.h"
#include "plane/exact/envelope.h"

namespace steradian::plane {

struct SeenPart {
  double begin, end;  // slopes, rising
  const Curve* curve;
  bool back;  // seen on its inner face
};

// The world as places on walls look at it.
class Outlook {
 public:
  explicit Outlook(const World& world);

  // From a place on a curve, from outside of all bodies; the normal is a unit. By rising slope, gaps where nothing is.
  void look(const Curve* own, Vec2d from, Vec2d normal, std::vector<SeenPart>& parts) const;

  std::size_t count() const { return world_.curves.size(); }

 private:
  const World& world_;
  DepthOrder order_;
  std::vector<const Curve*> others_;  // what is not in the order
};

// The unit direction of a slope.
inline Vec2d direction_of(double slope, Vec2d normal) {
  const Vec2d u = normal + Vec2d{-normal.y, normal.x} * slope;
  return u / length(u);
}

// The same part by angles: two where it goes across the angle pi.
struct SeenAngles {
  Visible parts[2];
  int count;
};
SeenAngles angles_of(const SeenPart& part, Vec2d normal);

}  // namespace steradian::plane
