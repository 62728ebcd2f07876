#include "plane/svg/stroke.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace steradian::plane::svg {
namespace {

using std::numbers::pi;

// The side to the left along the line.
class Side {
 public:
  Side(double radius, double tolerance) : radius_(radius), step_(4 * std::asin(std::sqrt(0.5 * std::min(tolerance / radius, 1.0)))) {}

  std::vector<Vec2d> points;

  // Adds the points at a vertex between two directions; the lengths are those of the segments before and behind it.
  void turn(Vec2d at, Vec2d before, Vec2d after, double length_before, double length_after) {
    const double angle = std::atan2(cross(before, after), dot(before, after));
    if (angle <= 0) return bend(at, before, angle);
    // On the inside the two sides meet, if they are long enough. Otherwise they go through the vertex, which lies entirely within.
    const double back = radius_ * std::tan(0.5 * angle);
    if (back < 0.5 * std::min(length_before, length_after) && angle < 3) {
      points.push_back(at + left(before) * radius_ - before * back);
    } else {
      points.push_back(at + left(before) * radius_);
      points.push_back(at);
      points.push_back(at + left(after) * radius_);
    }
  }

  // Adds points around the outside of a vertex, clockwise: an angle of at most 0.
  void bend(Vec2d at, Vec2d before, double angle) {
    const int n = static_cast<int>(std::ceil(-angle / step_));
    const double first = angle_of(left(before));
    // One point in the middle is enough if the arc is that flat.
    if (n <= 1) {
      points.push_back(at + direction_at(first + 0.5 * angle) * radius_);
      return;
    }
    for (int i = 0; i <= n; ++i) points.push_back(at + direction_at(first + angle * i / n) * radius_);
  }

 private:
  static Vec2d left(Vec2d along) { return {-along.y, along.x}; }
  double radius_, step_;
};

void walk(const std::vector<Vec2d>& line, bool closed, Side& side) {
  const std::size_t n = line.size();
  const auto segment = [&](std::size_t i) { return line[(i + 1) % n] - line[i % n]; };
  const auto turn = [&](std::size_t i) {
    const Vec2d before = segment(i + n - 1), after = segment(i);
    const double l = length(before), m = length(after);
    side.turn(line[i % n], before / l, after / m, l, m);
  };
  for (std::size_t i = closed ? 0 : 1; i + (closed ? 0 : 1) < n; ++i) turn(i);
  if (!closed) {
    const Vec2d last = segment(n - 2);
    side.bend(line[n - 1], last / length(last), -pi);
  }
}

}  // namespace

PlaneBody stroke_of(const std::vector<Vec2d>& line, bool closed, double radius, double tolerance) {
  std::vector<Vec2d> points;
  for (Vec2d p : line)
    if (points.empty() || !(p == points.back())) points.push_back(p);
  while (closed && points.size() > 1 && points.front() == points.back()) points.pop_back();
  PlaneBody body;
  if (points.size() <= 2) {
    body.shape = PlaneBody::Shape::capsule;
    body.radius = radius;
    body.contours = {{points.front(), points.back()}};
    return body;
  }
  Side side(radius, tolerance);
  walk(points, closed, side);
  if (closed) body.contours.push_back(std::move(side.points)), side.points.clear();
  std::reverse(points.begin(), points.end());
  walk(points, closed, side);
  body.contours.push_back(std::move(side.points));
  return body;
}

}  // namespace steradian::plane::svg
