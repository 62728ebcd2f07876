#include "drawing/plane_body.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace steradian::view {
namespace {

// The number of times that the contours run around a point, counter-clockwise in a plane whose y points up.
int winding(const PlaneBody& body, Vec2d p) {
  int around = 0;
  for (const auto& contour : body.contours)
    for (std::size_t i = 0; i < contour.size(); ++i) {
      const Vec2d a = contour[i], b = contour[(i + 1) % contour.size()];
      if ((a.y <= p.y) == (b.y <= p.y)) continue;
      const double side = cross(b - a, p - a);
      if (b.y > a.y ? side > 0 : side < 0) around += b.y > a.y ? 1 : -1;
    }
  return around;
}

bool inside(const PlaneBody& body, Vec2d p) {
  switch (body.shape) {
    case PlaneBody::Shape::polygon: {
      const int around = winding(body, p);
      return body.even_odd ? around % 2 != 0 : around != 0;
    }
    case PlaneBody::Shape::ellipse: {
      const double area = cross(body.x_axis, body.y_axis);
      if (area == 0) return false;
      const Vec2d d = p - body.center;
      return std::hypot(cross(d, body.y_axis) / area, cross(body.x_axis, d) / area) <= 1;
    }
    case PlaneBody::Shape::capsule: return distance_to_segment(p, body.contours[0][0], body.contours[0][1]) <= body.radius;
    case PlaneBody::Shape::polyline: return false;
  }
  return false;
}

double distance_to_outline(const PlaneBody& body, Vec2d p) {
  double nearest = std::numeric_limits<double>::max();
  for (const auto& contour : body.contours) {
    const std::size_t edges = contour.size() < 2 ? 0 : contour.size() - (body.shape == PlaneBody::Shape::polygon ? 0 : 1);
    for (std::size_t i = 0; i < edges; ++i)
      nearest = std::min(nearest, distance_to_segment(p, contour[i], contour[(i + 1) % contour.size()]));
  }
  if (body.shape == PlaneBody::Shape::capsule) nearest -= body.radius;
  if (body.shape == PlaneBody::Shape::ellipse) nearest = length(p - body.center) - std::min(length(body.x_axis), length(body.y_axis));
  return nearest;
}

// `point` maps places, `direction` maps vectors without a place.
template <class Point, class Direction>
PlaneBody mapped(PlaneBody body, Point point, Direction direction) {
  for (auto& contour : body.contours)
    for (Vec2d& p : contour) p = point(p);
  body.center = point(body.center);
  body.x_axis = direction(body.x_axis);
  body.y_axis = direction(body.y_axis);
  if (!body.light) return body;
  if (body.light->gradient) {
    body.light->gradient->from = point(body.light->gradient->from);
    body.light->gradient->to = point(body.light->gradient->to);
  }
  body.light->spot_axis = direction(body.light->spot_axis);
  return body;
}

}  // namespace

std::optional<std::size_t> body_at(const PlaneScene& scene, Vec2d point, double reach) {
  for (std::size_t i = scene.bodies.size(); i-- > 0;)
    if (inside(scene.bodies[i], point)) return i;
  std::optional<std::size_t> best;
  double nearest = reach;
  for (std::size_t i = 0; i < scene.bodies.size(); ++i)
    if (const double d = distance_to_outline(scene.bodies[i], point); d <= nearest) {
      nearest = d;
      best = i;
    }
  return best;
}

PlaneBody moved(PlaneBody body, Vec2d by) {
  return mapped(
      std::move(body), [&](Vec2d p) { return p + by; }, [](Vec2d d) { return d; });
}

PlaneBody scaled(PlaneBody body, Vec2d about, double factor) {
  const Vec2d axis = body.light ? body.light->spot_axis : Vec2d{};
  body = mapped(
      std::move(body), [&](Vec2d p) { return about + (p - about) * factor; }, [&](Vec2d d) { return d * factor; });
  if (body.light) body.light->spot_axis = axis;
  body.radius *= factor;
  return body;
}

PlaneBody turned(PlaneBody body, Vec2d about, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  const auto turn = [&](Vec2d d) { return Vec2d{c * d.x - s * d.y, s * d.x + c * d.y}; };
  return mapped(
      std::move(body), [&](Vec2d p) { return about + turn(p - about); }, turn);
}

}  // namespace steradian::view
