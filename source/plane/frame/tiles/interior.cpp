#include "plane/frame/tiles/interior.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>

namespace steradian::plane {
namespace {

struct InnerDisk {
  Vec2d center;
  double radius;
};

InnerDisk around(const Curve& c) {
  if (c.kind == Curve::Kind::segment) return {(c.a + c.b) * 0.5, 0.5 * length(c.b - c.a)};
  if (c.tau_span < std::numbers::pi) {
    // The disk around the chord, in the space where the ellipse is round, and from there in the plane.
    const PlaneEllipse& e = c.ellipse;
    const double longest = e.x == Vec2d{e.y.y, -e.y.x} ? length(e.x) : std::sqrt(dot(e.x, e.x) + dot(e.y, e.y));
    return {(e.at(c.tau0) + e.at(c.tau0 + c.tau_span)) * 0.5, longest * std::sin(0.5 * c.tau_span)};
  }
  return {c.ellipse.center, std::sqrt(dot(c.ellipse.x, c.ellipse.x) + dot(c.ellipse.y, c.ellipse.y))};
}

}  // namespace

std::vector<const Curve*> curves_that_matter_within(const std::vector<const Curve*>& curves, std::size_t own, Vec2d center, double radius) {
  std::vector<const Curve*> result;
  std::vector<InnerDisk> others;
  for (std::size_t i = own; i < curves.size(); ++i) others.push_back(around(*curves[i]));
  for (std::size_t i = 0; i < own; ++i) {
    // The curve matters within the wider of the two radii of the line between the point and the part that it may occlude.
    const InnerDisk mine = around(*curves[i]);
    const Vec2d at = mine.center - center;
    const bool matters = std::any_of(others.begin(), others.end(), [&](const InnerDisk& other) {
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

namespace {

// Does a sequence of edges run across all paths from one disk to the other? Between the two disks, all paths lie within the lines that
// touch both from outside.
bool divides(const std::vector<const Curve*>& edges, std::size_t count, const InnerDisk& from, const InnerDisk& to) {
  const Vec2d axis = to.center - from.center;
  const double d = length(axis), growth = to.radius - from.radius;
  if (d <= from.radius + to.radius) return false;
  const Vec2d along = axis / d;
  const double sine = growth / d, widen = 1 / std::sqrt(1 - sine * sine);
  bool low = false, high = false, under_way = false;
  const Curve* before = nullptr;
  for (std::size_t i = 0; i < count; ++i) {
    const Curve& c = *edges[i];
    const Vec2d a = c.a - from.center, b = c.b - from.center;
    const double xa = dot(along, a), xb = dot(along, b);
    const bool between = std::min(xa, xb) > from.radius && std::max(xa, xb) < d - to.radius;
    const bool follows = under_way && (before->b == c.a || before->a == c.b || before->a == c.a || before->b == c.b);
    under_way = between;
    before = &c;
    if (!between) continue;
    const double ya = cross(along, a), yb = cross(along, b);
    const double wide_a = (from.radius + sine * xa) * widen, wide_b = (from.radius + sine * xb) * widen;
    low = (follows && low) || ya < -wide_a || yb < -wide_b;
    high = (follows && high) || ya > wide_a || yb > wide_b;
    if (low && high) return true;
  }
  return false;
}

}  // namespace

SeenWithin seen_within(const LightInterior& polygon, Vec2d center, double radius) {
  std::vector<const Curve*> curves(polygon.curves.begin(), polygon.curves.begin() + static_cast<std::ptrdiff_t>(polygon.own));
  for (const Curve& part : polygon.parts)
    if (!divides(polygon.curves, polygon.own, {center, radius}, around(part))) curves.push_back(&part);
  SeenWithin seen;
  const std::size_t parts = curves.size() - polygon.own;
  if (parts == 0) return seen;
  seen.curves = curves_that_matter_within(curves, polygon.own, center, radius);
  seen.own = seen.curves.size() - parts;
  return seen;
}

void keep_seen_from(const SeenWithin& all, Vec2d p, SeenWithin& seen) {
  seen.curves.clear();
  const auto parts = all.curves.begin() + static_cast<std::ptrdiff_t>(all.own);
  const auto faces = [&](const Curve& c) {
    if (c.kind != Curve::Kind::segment) return true;
    // The same test as in an envelope. Rounding has moved the ends of a part off the line along which it is seen edge on.
    const double turn = cross(c.a - p, c.b - p);
    return std::fabs(turn) > 1e-10 * length(c.b - c.a) && (c.two_sided || turn < 0);
  };
  const auto within = [&](const Curve& edge, const Curve& part) {
    Vec2d a = part.a - p, b = part.b - p;
    if (part.kind != Curve::Kind::segment) {
      // Contact points of the tangents of the circle around it.
      const InnerDisk disk = around(part);
      const Vec2d to = disk.center - p, left{-to.y, to.x};
      const double d2 = dot(to, to), tangent2 = d2 - disk.radius * disk.radius;
      if (tangent2 <= 0) return true;
      const double share = tangent2 / d2, across = disk.radius * std::sqrt(tangent2) / d2;
      a = to * share - left * across;
      b = to * share + left * across;
      const double beyond = std::sqrt(d2) + disk.radius;
      const Vec2d c = edge.a - p, d = edge.b - p;
      if (std::min(dot(to, c), dot(to, d)) > beyond * std::sqrt(d2)) return false;
      return !((cross(a, c) < 0 && cross(a, d) < 0) || (cross(b, c) > 0 && cross(b, d) > 0));
    }
    if (cross(a, b) < 0) std::swap(a, b);
    const Vec2d c = edge.a - p, d = edge.b - p;
    const bool outside = (cross(a, c) < 0 && cross(a, d) < 0) || (cross(b, c) > 0 && cross(b, d) > 0) ||
                         (cross(b - a, c - a) < 0 && cross(b - a, d - a) < 0);
    return !outside;
  };
  for (std::size_t i = 0; i < all.own; ++i) {
    const Curve& edge = *all.curves[i];
    if (std::any_of(parts, all.curves.end(), [&](const Curve* part) { return faces(*part) && within(edge, *part); }))
      seen.curves.push_back(&edge);
  }
  seen.own = seen.curves.size();
  std::copy_if(parts, all.curves.end(), std::back_inserter(seen.curves), [&](const Curve* part) { return faces(*part); });
}

std::optional<Curve> clipped_to_circle(const Curve& segment, const PlaneEllipse& circle) {
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

std::optional<Curve> circle_clipped_to_circle(const Curve& other, const PlaneEllipse& circle) {
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

namespace {

const Curve& curve_of(const Curve& c) { return c; }
const Curve& curve_of(const Curve* c) { return *c; }

template <class Curves>
double share_between(const Curves& chords, Vec2d p) {
  thread_local std::vector<Interval<double>> taken;
  taken.clear();
  for (const auto& of : chords) {
    const Curve& chord = curve_of(of);
    const Vec2d a = chord.a - p, b = chord.b - p;
    const double turn = cross(a, b);
    if (turn == 0 || (turn > 0 && !chord.two_sided)) continue;  // on its line; behind it: inside an occluder
    const Vec2d from = turn > 0 ? a : b;
    const double begin = std::atan2(from.y, from.x), end = begin + std::fabs(std::atan2(turn, dot(a, b)));
    taken.push_back({begin, std::min(end, std::numbers::pi)});
    if (end > std::numbers::pi) taken.push_back({-std::numbers::pi, end - 2 * std::numbers::pi});
  }
  std::sort(taken.begin(), taken.end(), [](const Interval<double>& a, const Interval<double>& b) { return a.low < b.low; });
  double sum = 0, reached = -std::numbers::pi;
  for (const Interval<double>& i : taken) {
    sum += std::max(i.high - std::max(i.low, reached), 0.0);
    reached = std::max(reached, i.high);
  }
  return 1 - sum / (2 * std::numbers::pi);
}

}  // namespace

double open_share(const std::vector<Curve>& chords, Vec2d p) { return share_between(chords, p); }
double open_share(const std::vector<const Curve*>& chords, Vec2d p) { return share_between(chords, p); }

}  // namespace steradian::plane
