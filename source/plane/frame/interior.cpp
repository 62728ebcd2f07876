#include "plane/frame/interior.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace steradian::plane {
namespace {

struct Disk {
  Vec2d center;
  double radius;
};

Disk around(const Curve& c) {
  if (c.kind == Curve::Kind::segment) return {(c.a + c.b) * 0.5, 0.5 * length(c.b - c.a)};
  return {c.ellipse.center, std::sqrt(dot(c.ellipse.x, c.ellipse.x) + dot(c.ellipse.y, c.ellipse.y))};
}

}  // namespace

std::vector<const Curve*> curves_that_matter_within(const std::vector<const Curve*>& curves, std::size_t own, Vec2d center, double radius) {
  std::vector<const Curve*> result;
  std::vector<Disk> others;
  for (std::size_t i = own; i < curves.size(); ++i) others.push_back(around(*curves[i]));
  for (std::size_t i = 0; i < own; ++i) {
    // Within the wider of the two radii of the line between the point and what it may hide.
    const Disk mine = around(*curves[i]);
    const Vec2d at = mine.center - center;
    const bool matters = std::any_of(others.begin(), others.end(), [&](const Disk& other) {
      const Vec2d to = other.center - center;
      const double l2 = dot(to, to), t = l2 > 0 ? std::clamp(dot(at, to) / l2, 0.0, 1.0) : 0;
      const double limit = std::max(radius, other.radius) + mine.radius;
      const Vec2d away = at - to * t;
      return dot(away, away) <= limit * limit;
    });
    if (matters) result.push_back(curves[i]);
  }
  result.insert(result.end(), curves.begin() + static_cast<std::ptrdiff_t>(own), curves.end());
  return result;
}

std::optional<Curve> clipped_to_circle(const Curve& segment, const Ellipse& circle) {
  const Vec2d d = segment.b - segment.a, c = segment.a - circle.center;
  const double a = dot(d, d), h = dot(c, d), k = dot(c, c) - dot(circle.x, circle.x), det = h * h - a * k;
  if (det <= 0) return {};
  const double root = std::sqrt(det), t0 = std::max((-h - root) / a, 0.0), t1 = std::min((-h + root) / a, 1.0);
  if (t0 >= t1) return {};
  Curve part = segment;
  part.a = segment.a + d * t0;
  part.b = segment.a + d * t1;
  return part;
}

std::optional<Curve> circle_clipped_to_circle(const Curve& other, const Ellipse& circle) {
  const Vec2d to = circle.center - other.ellipse.center;
  const double d = length(to), r = length(circle.x), s = length(other.ellipse.x);
  if (d + s <= r) return other;
  if (d >= r + s || d + r <= s) return {};
  Curve part = other;
  const Vec2d unit = other.ellipse.to_unit(circle.center);
  const double half = std::acos(std::clamp((d * d + s * s - r * r) / (2 * d * s), -1.0, 1.0));
  part.tau0 = std::atan2(unit.y, unit.x) - half;
  part.tau_span = 2 * half;
  part.a = part.ellipse.at(part.tau0);
  part.b = part.ellipse.at(part.tau0 + part.tau_span);
  return part;
}

double open_share(const std::vector<Curve>& chords, Vec2d p) {
  constexpr double pi = std::numbers::pi;
  struct Interval {
    double begin, end;
  };
  thread_local std::vector<Interval> taken;
  taken.clear();
  for (const Curve& chord : chords) {
    const Vec2d a = chord.a - p, b = chord.b - p;
    const double turn = cross(a, b);
    if (turn == 0 || (turn > 0 && !chord.two_sided)) continue;  // on its line; behind it: inside an occluder
    const Vec2d from = turn > 0 ? a : b;
    const double begin = std::atan2(from.y, from.x), end = begin + std::fabs(std::atan2(turn, dot(a, b)));
    taken.push_back({begin, std::min(end, pi)});
    if (end > pi) taken.push_back({-pi, end - 2 * pi});
  }
  std::sort(taken.begin(), taken.end(), [](const Interval& a, const Interval& b) { return a.begin < b.begin; });
  double sum = 0, reached = -pi;
  for (const Interval& i : taken) {
    sum += std::max(i.end - std::max(i.begin, reached), 0.0);
    reached = std::max(reached, i.end);
  }
  return 1 - sum / (2 * pi);
}

}  // namespace steradian::plane
