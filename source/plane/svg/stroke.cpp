#include "plane/svg/stroke.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "plane/svg/clip.h"

namespace steradian::plane::svg {
namespace {

using std::numbers::pi;

constexpr double kMostTurnPieces = 10'000;

// Largest angle of a piece of a circle that stays within the tolerance.
double step_of(double radius, double tolerance) {
  return std::max(4 * std::asin(std::sqrt(0.5 * std::min(tolerance / radius, 1.0))), 2 * pi / kMostTurnPieces);
}

Vec2d left(Vec2d along) { return {-along.y, along.x}; }

// The side to the left along the line.
class StrokeSide {
 public:
  StrokeSide(const Stroke& stroke, double tolerance) : stroke_(stroke), radius_(stroke.radius), step_(step_of(stroke.radius, tolerance)) {}

  std::vector<Vec2d> points;

  // Adds the points at a vertex between two directions; the lengths are those of the segments before and behind it.
  void turn(Vec2d at, Vec2d before, Vec2d after, double length_before, double length_after) {
    double angle = std::atan2(cross(before, after), dot(before, after));
    if (std::fabs(angle) == pi) angle = -pi;  // straight back: both sides are outside
    if (angle <= 0) return join(at, before, after, angle);
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

  // Adds the end of an open line, from its left to its right.
  void end(Vec2d at, Vec2d along) {
    if (stroke_.cap == Cap::round) return bend(at, along, -pi);
    const Vec2d tip = stroke_.cap == Cap::square ? at + along * radius_ : at;
    points.push_back(tip + left(along) * radius_);
    points.push_back(tip - left(along) * radius_);
  }

 private:
  // The outside of a vertex, clockwise: an angle of at most 0.
  void join(Vec2d at, Vec2d before, Vec2d after, double angle) {
    if (stroke_.join == Join::round) return bend(at, before, angle);
    const double half_cosine = std::cos(0.5 * angle);
    const bool flat = -angle <= std::min(step_, 0.5);  // a corner within the tolerance, also of a bevel
    if (flat || (stroke_.join == Join::miter && half_cosine * stroke_.miter_limit >= 1)) {
      points.push_back(at + (left(before) + left(after)) * (radius_ / (2 * half_cosine * half_cosine)));
      return;
    }
    points.push_back(at + left(before) * radius_);
    points.push_back(at + left(after) * radius_);
  }

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

  const Stroke& stroke_;
  double radius_, step_;
};

void walk(const std::vector<Vec2d>& line, bool closed, StrokeSide& side) {
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
    side.end(line[n - 1], last / length(last));
  }
}

PlaneBody capsule(Vec2d from, Vec2d to, double radius) {
  PlaneBody body;
  body.shape = PlaneBody::Shape::capsule;
  body.radius = radius;
  body.contours = {{from, to}};
  return body;
}

// A line that does not leave its first point: a dot of the pen, or nothing.
PlaneBody dot_of(Vec2d at, const Stroke& stroke) {
  if (stroke.cap == Cap::round) return capsule(at, at, stroke.radius);
  const Vec2d x{stroke.radius, 0}, y{0, stroke.radius};
  return stroke.cap == Cap::square ? plane_polygon({at - x - y, at + x - y, at + x + y, at - x + y}) : PlaneBody{};
}

Transform inverse(const Transform& t) {
  const double det = t.determinant();
  Transform i{t.d / det, -t.b / det, -t.c / det, t.a / det, 0, 0};
  i.e = -(i.a * t.e + i.c * t.f);
  i.f = -(i.b * t.e + i.d * t.f);
  return i;
}

// The factors by which a transform stretches the most and the least.
struct StretchFactors {
  double most, least;
};
StretchFactors stretch_of(const Transform& t) {
  const double sum = std::hypot(t.a + t.d, t.b - t.c), difference = std::hypot(t.a - t.d, t.b + t.c);
  return {0.5 * (sum + difference), 0.5 * std::fabs(sum - difference)};
}

constexpr double kRound = 1e-12, kFlat = 1e-6;  // of a transformed circle

}  // namespace

PlaneBody stroke_of(const std::vector<Vec2d>& line, bool closed, const Stroke& stroke, double tolerance) {
  std::vector<Vec2d> points;
  for (Vec2d p : line)
    if (points.empty() || length(p - points.back()) > 0) points.push_back(p);
  while (closed && points.size() > 1 && !(length(points.front() - points.back()) > 0)) points.pop_back();
  if (points.empty()) return {};
  if (points.size() == 1) return dot_of(points.front(), stroke);
  Stroke drawn = stroke;
  if (points.size() == 2 && closed) {
    // There and back: its corners are its ends.
    closed = false;
    drawn.cap = stroke.join == Join::round ? Cap::round : Cap::butt;
  }
  if (points.size() == 2 && drawn.cap == Cap::round) return capsule(points[0], points[1], stroke.radius);
  StrokeSide side(drawn, tolerance);
  PlaneBody body;
  walk(points, closed, side);
  if (closed) body.contours.push_back(std::move(side.points)), side.points.clear();
  std::reverse(points.begin(), points.end());
  walk(points, closed, side);
  body.contours.push_back(std::move(side.points));
  return body;
}

PlaneBody stroke_after(const Transform& transform, const std::vector<Vec2d>& line, bool closed, const Stroke& stroke, double tolerance) {
  const StretchFactors stretch = stretch_of(transform);
  if (!(stretch.least > kFlat * stretch.most)) return {};
  if (stretch.most - stretch.least <= kRound * stretch.most) {
    Stroke scaled = stroke;
    scaled.radius *= stretch.most;
    return stroke_of(line, closed, scaled, tolerance);
  }
  const Transform back = inverse(transform);
  std::vector<Vec2d> own;
  own.reserve(line.size());
  for (const Vec2d p : line) own.push_back(back.apply(p));
  PlaneBody body = flattened(stroke_of(own, closed, stroke, tolerance / stretch.most), tolerance / stretch.most);
  for (auto& contour : body.contours)
    for (Vec2d& p : contour) p = transform.apply(p);
  return body;
}

std::uint64_t most_points(const Transform& transform, const std::vector<Vec2d>& line, const Stroke& stroke, double tolerance) {
  double turned = stroke.cap == Cap::round ? 2 * pi : 0;
  if (stroke.join == Join::round)
    for (std::size_t i = 1; i + 1 < line.size(); ++i) {
      const Vec2d before = line[i] - line[i - 1], after = line[i + 1] - line[i];
      turned += std::fabs(std::atan2(cross(before, after), dot(before, after)));
    }
  const double step = step_of(stroke.radius * stretch_of(transform).most, tolerance);
  return 6 * line.size() + static_cast<std::uint64_t>((turned + 2 * pi) / step);
}

}  // namespace steradian::plane::svg
