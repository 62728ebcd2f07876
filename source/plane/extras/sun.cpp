#include "plane/extras/sun.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "plane/exact/gaps.h"

namespace steradian::plane {
namespace {

using std::numbers::pi;

// Slopes, along / ahead, in a sun's own frame: 1e-15 of a half turn lies beyond the steepest.
constexpr double kSteepest = 1e15;

class Opening {
 public:
  Opening(const PlaneSun& sun, Vec2d from)
      : from_(from), ahead_{std::cos(sun.direction), std::sin(sun.direction)}, along_{-ahead_.y, ahead_.x} {
    const double edge = sun.half_width >= 0.5 * pi - 1e-9 ? kSteepest : std::tan(sun.half_width);
    gaps().assign(1, {-edge, edge});
  }

  bool is_closed() const { return gaps().empty(); }

  void close(const Curve& c) {
    if (c.kind == Curve::Kind::segment) {
      const Vec2d a = c.a - from_, b = c.b - from_;
      const double side = cross(a, b);
      if (side < 0)
        close_between(b, a);
      else if (side > 0 && c.two_sided)
        close_between(a, b);
      return;
    }
    const Vec2d p = c.ellipse.to_unit(from_);
    const double d2 = dot(p, p);
    if (d2 <= 1) return;
    // Contact points of the tangents in the circle's space; tau runs against the angle.
    const double root = std::sqrt(d2 - 1);
    const Vec2d across{-p.y * root, p.x * root}, first = (p - across) / d2, last = (p + across) / d2;
    const auto place = [&](Vec2d unit) { return c.ellipse.center + c.ellipse.x * unit.x + c.ellipse.y * unit.y - from_; };
    if (c.tau_span >= 2 * pi - 1e-12) return close_between(place(last), place(first));
    const double begin = angle_of(first);
    double span = angle_of(last) - begin, shift = std::fmod(begin - c.tau0, 2 * pi);
    if (span < 0) span += 2 * pi;
    if (shift < 0) shift += 2 * pi;
    for (double at : {shift, shift - 2 * pi}) {
      const double low = std::max(at, 0.0), high = std::min(at + span, c.tau_span);
      if (high > low) close_between(c.ellipse.at(c.tau0 + high) - from_, c.ellipse.at(c.tau0 + low) - from_);
    }
  }

  void add(Vec3d radiance, PlaneLight& sum) const {
    for (const Gap& gap : gaps()) {
      const Vec2d low = direction(gap.begin), high = direction(gap.end);
      sum.radiance += radiance * std::atan2(gap.end - gap.begin, 1 + gap.begin * gap.end);
      sum.moment_x += radiance * (high.y - low.y);
      sum.moment_y += radiance * (low.x - high.x);
    }
  }

 private:
  struct Gap {
    double begin, end;
  };
  static std::vector<Gap>& gaps() {
    thread_local std::vector<Gap> gaps;
    return gaps;
  }

  Vec2d direction(double slope) const {
    const Vec2d u = ahead_ + along_ * slope;
    return u / length(u);
  }

  // Closes the directions of rising angle from a to b, less than half a turn.
  void close_between(Vec2d a, Vec2d b) {
    const double ahead_a = dot(a, ahead_), ahead_b = dot(b, ahead_);
    if (ahead_a <= 0 && ahead_b <= 0) return;
    const double begin = ahead_a <= 0 ? -kSteepest : dot(a, along_) / ahead_a, end = ahead_b <= 0 ? kSteepest : dot(b, along_) / ahead_b;
    take_between(gaps(), begin, end, [](const Gap& gap, double, double high) { return Gap{high, gap.end}; });
  }

  Vec2d from_, ahead_, along_;
};

}  // namespace

bool is_plain(const PlaneSun& sun) { return sun.half_width <= 0.5 * pi + 1e-9; }

void add_open_sun(const SunView& view, Vec2d from, PlaneLight& sum) {
  const PlaneSun& sun = *view.sun;
  if (sun.half_width > 0) {
    Opening opening(sun, from);
    for (const Curve* c : view.blocking) {
      opening.close(*c);
      if (opening.is_closed()) return;
    }
    return opening.add(sun.radiance, sum);
  }
  const Vec2d u{std::cos(sun.direction), std::sin(sun.direction)};
  if (std::any_of(view.blocking.begin(), view.blocking.end(), [&](const Curve* c) { return hit_curve(*c, from, u, -1).curve != nullptr; }))
    return;
  sum.radiance += sun.radiance;
  sum.moment_x += sun.radiance * u.x;
  sum.moment_y += sun.radiance * u.y;
}

}  // namespace steradian::plane
