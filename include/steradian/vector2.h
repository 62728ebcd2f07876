// Vec2d: plain vectors of the plane, for scenes and hosts.
#pragma once

#include <algorithm>
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
// Positive if b is counter-clockwise from a (x to the right, y up; in SVG's y-down it looks clockwise).
constexpr double cross(Vec2d a, Vec2d b) { return a.x * b.y - a.y * b.x; }
// Valid for coordinates up to 1e150: the squares must not leave the range.
inline double length(Vec2d a) { return std::sqrt(dot(a, a)); }
inline double angle_of(Vec2d a) { return std::atan2(a.y, a.x); }
inline Vec2d direction_at(double angle) { return {std::cos(angle), std::sin(angle)}; }
// The point of the segment from a to b that is nearest to p.
constexpr Vec2d nearest_on_segment(Vec2d a, Vec2d b, Vec2d p) {
  const Vec2d ab = b - a;
  const double l = dot(ab, ab);
  return l > 0 ? a + ab * std::clamp(dot(p - a, ab) / l, 0.0, 1.0) : a;
}
inline double distance_to_segment(Vec2d p, Vec2d a, Vec2d b) { return length(p - nearest_on_segment(a, b, p)); }
inline bool is_finite(Vec2d a) { return std::isfinite(a.x) && std::isfinite(a.y); }

}  // namespace steradian
