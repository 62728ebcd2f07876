// Derivatives by differences. Exact light has no noise, so they keep all but four digits of the value.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "steradian/vector.h"

namespace steradian::methods {

// A step in fractions of the width over which a function changes. A central difference is off by step^2 / 6 of the third derivative, here
// 2e-9; rounding adds 1e-15 over the step.
inline constexpr double kStep = 1e-4;

// The derivative at 0 of a function of a number: Vec3d value(double). It is the median of the slopes of three intervals. Between smooth
// values that is the central one. If a rule changes its number of nodes within one of them, the value jumps there, and the others remain.
template <class Value>
Vec3d by_number(double step, const Value& value) {
  const Vec3d a = value(-2 * step), b = value(-step), c = value(step), d = value(2 * step);
  const Vec3d before = (b - a) / step, central = (c - b) / (2 * step), after = (d - c) / step;
  const auto median = [](double x, double y, double z) { return std::max(std::min(x, y), std::min(std::max(x, y), z)); };
  return {median(before.x, central.x, after.x), median(before.y, central.y, after.y), median(before.z, central.z, after.z)};
}

// The derivatives by a unit direction, one vector a channel, perpendicular to it: Vec3d value(Vec3d).
//
//   step  angle [rad]
template <class Value>
std::array<Vec3d, 3> by_direction(Vec3d direction, double step, const Value& value) {
  const Frame frame = Frame::from_normal(direction);
  std::array<Vec3d, 3> result{};
  for (const Vec3d& axis : {frame.x, frame.y}) {
    const Vec3d slope = by_number(step, [&](double angle) { return value(direction * std::cos(angle) + axis * std::sin(angle)); });
    result[0] += axis * slope.x;
    result[1] += axis * slope.y;
    result[2] += axis * slope.z;
  }
  return result;
}

}  // namespace steradian::methods
