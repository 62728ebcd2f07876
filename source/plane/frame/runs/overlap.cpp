#include "plane/frame/runs/overlap.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "plane/exact/outline.h"
#include "plane/frame/runs/runs.h"

namespace steradian::plane {
namespace {

using std::numbers::pi;

// The normal in the plane of a line with this normal in the ellipse's unit space.
Vec2d normal_from_unit(const PlaneEllipse& e, Vec2d n) {
  const Vec2d v{e.y.y * n.x - e.x.y * n.y, e.x.x * n.y - e.y.x * n.x};
  return v / length(v);
}

Vec2d from_unit(const PlaneEllipse& e, Vec2d p) { return e.center + e.x * p.x + e.y * p.y; }

Vec2d outward_normal(const PlaneEllipse& e, Vec2d p) { return normal_from_unit(e, e.to_unit(p)); }

// The point of an ellipse nearest to the origin: the best of 64 places, then by thirds.
Vec2d nearest_to_origin(const PlaneEllipse& e) {
  constexpr int kPlaces = 64;
  const auto distance2 = [&](double tau) {
    const Vec2d p = e.at(tau);
    return dot(p, p);
  };
  double best = 0;
  for (int i = 1; i < kPlaces; ++i)
    if (const double tau = 2 * pi * i / kPlaces; distance2(tau) < distance2(best)) best = tau;
  double low = best - 2 * pi / kPlaces, high = best + 2 * pi / kPlaces;
  for (int i = 0; i < 60; ++i) {
    const double s = low + (high - low) / 3, t = high - (high - low) / 3;
    if (distance2(s) < distance2(t))
      high = t;
    else
      low = s;
  }
  return e.at(0.5 * (low + high));
}

void add_crossing(Vec2d at, Vec2d light_normal, Vec2d blocker_normal, Lens& lens) {
  lens.crossings[lens.count++] = {at, light_normal, blocker_normal, cross(light_normal, blocker_normal) > 0};
}

// The line half way between the unit circle of `space` and a point p outside it, both in unit space.
DividingLine line_to(const PlaneEllipse& space, Vec2d p) {
  const double d = length(p);
  return {normal_from_unit(space, p / d), from_unit(space, p * (0.5 * (1 + d) / d))};
}

Meeting meet_edge(const Emitter& e, const PlaneEllipse& blocker) {
  Meeting result;
  const Vec2d s = blocker.to_unit(e.a), t = blocker.to_unit(e.b), nearest = nearest_on_segment(s, t, {0, 0});
  if (length(nearest) >= 1 - kTouching) {
    result.line = line_to(blocker, nearest);
    result.line.normal = -result.line.normal;
    return result;
  }
  const Vec2d d = t - s;
  const double a = dot(d, d), h = dot(s, d), k = dot(s, s) - 1, root = std::sqrt(std::max(h * h - a * k, 0.0));
  result.kind = Meeting::Kind::cross;
  for (const double at : {(-h - root) / a, (-h + root) / a}) {
    if (!(at > 0 && at < 1)) continue;
    const Vec2d p = e.a + (e.b - e.a) * at;
    add_crossing(p, e.normal, outward_normal(blocker, p), result.lens);
  }
  if (result.lens.count == 0) result.kind = Meeting::Kind::hides;
  return result;
}

}  // namespace

PlaneEllipse ellipse_of(const Emitter& e) {
  return e.kind == Emitter::Kind::arc ? e.ellipse : PlaneEllipse{e.a, {e.radius, 0}, {0, e.radius}};
}

Meeting meet(const Emitter& e, const PlaneEllipse& blocker) {
  if (e.kind == Emitter::Kind::edge) return meet_edge(e, blocker);
  Meeting result;
  Curve light, other;
  light.kind = other.kind = Curve::Kind::arc;
  light.ellipse = ellipse_of(e);
  other.ellipse = blocker;
  const Crossings crossings = intersect(light, other);
  // A single crossing is a touch.
  if (crossings.count >= 2) {
    result.kind = Meeting::Kind::cross;
    for (int i = 0; i < crossings.count; ++i)
      add_crossing(crossings.at[i], outward_normal(light.ellipse, crossings.at[i]), outward_normal(blocker, crossings.at[i]), result.lens);
    return result;
  }
  const auto within = [](const PlaneEllipse& outer, const PlaneEllipse& inner) {
    const Vec2d p = outer.to_unit(inner.at(0)), q = outer.to_unit(inner.center);
    return dot(p, p) < 1 && dot(q, q) < 1;
  };
  if (within(light.ellipse, blocker)) {
    result.kind = Meeting::Kind::within;
  } else if (within(blocker, light.ellipse)) {
    result.kind = Meeting::Kind::hides;
  } else {
    const Vec2d origin = light.ellipse.center;
    const PlaneEllipse seen{light.ellipse.to_unit(blocker.center), light.ellipse.to_unit(origin + blocker.x),
                            light.ellipse.to_unit(origin + blocker.y)};
    result.line = line_to(light.ellipse, nearest_to_origin(seen));
  }
  return result;
}

bool comes_within(double gap, const Emitter& e, const Vec2d* v, std::size_t count) {
  if (e.kind != Emitter::Kind::edge) {
    const PlaneEllipse space = ellipse_of(e);
    double nearest = 1e300;
    bool inside = count > 2;
    for (std::size_t k = 0; k < count; ++k) {
      const Vec2d p = space.to_unit(v[k]), q = space.to_unit(v[(k + 1) % count]);
      nearest = std::min(nearest, length(nearest_on_segment(p, q, {0, 0})));
      inside = inside && cross(q - p, -p) > 0;
    }
    return inside || nearest < 1 + gap / e.radius;
  }
  const Vec2d ends[] = {e.a, e.b};
  const ConvexRegion light = is_run(e) ? region_of(e) : ConvexRegion{ends, 2};
  return gap_between(light, {v, count}, gap).width < gap;
}

SegmentParts parts_outside(const PlaneEllipse& ellipse, Vec2d p, Vec2d q) {
  const Vec2d c = ellipse.to_unit(p), d = ellipse.to_unit(q) - c;
  const double a = dot(d, d), h = dot(c, d), k = dot(c, c) - 1, det = h * h - a * k;
  SegmentParts parts;
  const auto add = [&](double from, double to) {
    parts.from[parts.count] = p + (q - p) * from;
    parts.to[parts.count++] = to == 1 ? q : p + (q - p) * to;
  };
  const double root = std::sqrt(std::max(det, 0.0)), t0 = (-h - root) / a, t1 = (-h + root) / a;
  if (det <= 0 || t0 >= 1 || t1 <= 0) {
    add(0, 1);
    return parts;
  }
  const double touch = kTouching / length(q - p);
  if (t0 > touch) add(0, t0);
  if (1 - t1 > touch) add(t1, 1);
  return parts;
}

}  // namespace steradian::plane
