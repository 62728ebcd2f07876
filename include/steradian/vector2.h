// Vec2d: plain vectors of the plane, for scenes and hosts.
#pragma once

#include <cmath>

namespace steradian {

struct Vec2d {
  double x = 0, y = 0;

  friend constexpr Vec2d operator+(Vec2d a, Vec2d b) { return {a.x + b.x, a.y + b.y}; }
  friend constexpr Vec2d operator-(Vec2d a, Vec2d b) { return {a.x - b.x, a.y - b.y}; }
  friend constexpr Vec2d operator-(Vec2d a) { return {-a.x, -a.y}; }
  friend constexpr Vec2d operator*(Vec2d a, double s) { return {a.x * s, a.y * s}; }
  friend constexpr Vec2d operator*(double s, Vec2d a) { return {a.x * s, a.y * s}; }
  friend constexpr Vec2d operator/(Vec2d a, double s) { return {a.x / s, a.y / s}; }
  friend constexpr bool operator==(Vec2d a, Vec2d b) { return a.x == b.x && a.y == b.y; }
};

constexpr double dot(Vec2d a, Vec2d b) { return a.x * b.x + a.y * b.y; }
// Positive where b is counter-clockwise from a (x to the right, y up; in SVG's y-down it looks clockwise).
constexpr double cross(Vec2d a, Vec2d b) { return a.x * b.y - a.y * b.x; }
// For coordinates up to 1e150: the squares must not leave the range.
inline double length(Vec2d a) { return std::sqrt(dot(a, a)); }
inline double angle_of(Vec2d a) { return std::atan2(a.y, a.x); }
inline bool is_finite(Vec2d a) { return std::isfinite(a.x) && std::isfinite(a.y); }

}  // namespace steradian
