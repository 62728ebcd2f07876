#include "shadow/region/light_frame.h"

#include <algorithm>
#include <cmath>

namespace steradian::shadow {
namespace {

struct Rectangle {
  double x0 = INFINITY, x1 = -INFINITY, y0 = INFINITY, y1 = -INFINITY;
  double area() const { return (x1 - x0) * (y1 - y0); }
};

// Bounding rectangle of the first contour, the outline; holes lie within.
Rectangle bounds(const PreparedPolygon& light, Vec3d x, Vec3d y) {
  Rectangle r;
  for (std::size_t i = light.contours[0]; i < light.contours[1]; ++i) {
    const Vec3d d = light.vertices[i] - light.centroid;
    r.x0 = std::min(r.x0, dot(d, x));
    r.x1 = std::max(r.x1, dot(d, x));
    r.y0 = std::min(r.y0, dot(d, y));
    r.y1 = std::max(r.y1, dot(d, y));
  }
  return r;
}

struct Bounding {
  Vec3d x, y;
  Rectangle rectangle;
};

// The smallest rectangle lies along an edge of the hull; outlines have few other edges.
Bounding bounding_of(const PreparedPolygon& light, Vec3d z) {
  const std::size_t count = light.contours[1];
  Bounding best;
  double least = INFINITY;
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3d edge = light.vertices[(i + 1) % count] - light.vertices[i];
    const Vec3d x = normalized(edge - z * dot(edge, z)), y = cross(z, x);
    if (!(dot(x, x) > 0.5)) continue;
    const Rectangle r = bounds(light, x, y);
    if (r.area() < least * (1 - 1e-9)) {
      least = r.area();
      best = {x, y, r};
    }
  }
  return best;
}

constexpr double kMargin = 4e-5;

}  // namespace

double margin_of_plane(const PreparedPolygon& light) {
  const Bounding b = bounding_of(light, -light.normal);
  return kMargin * 0.5 * std::max(b.rectangle.x1 - b.rectangle.x0, b.rectangle.y1 - b.rectangle.y0);
}

void put_box(LightFrame& frame) {
  frame.box_x = frame.half_x * (1 + 1.0 / 64);
  frame.box_y = frame.half_y * (1 + 1.0 / 64);
  frame.eta = kMargin * std::max(frame.half_x, frame.half_y);
}

Vec3d LightFrame::way(Vec3d from, Vec3d place) const {
  const Vec3d to = place - from;
  if (body != nullptr) {
    // A corner of the polygon may see past the body.
    if (const auto span = body->span(from, to)) return to * std::clamp(span->enters - eta / length(to), 0.0, 1.0);
  }
  const double z = -to_local(from).z;
  return to * std::max((z - eta) / z, 0.0);
}

Eye eye_of(const LightFrame& frame, Vec3d anchor, Vec3d point) {
  const Vec3d at = frame.to_local(point), a = frame.to_local(anchor), p = frame.axes.to_local(point - anchor);
  return {{at.x, at.y, -at.z}, {p.x * a.z - a.x * p.z, p.y * a.z - a.y * p.z, -p.z}, -frame.eta - a.z};
}

LightFrame light_frame(const PreparedPolygon& light, int side) {
  const Vec3d z = side < 0 ? light.normal : -light.normal;
  const auto [best_x, best_y, best] = bounding_of(light, z);
  LightFrame frame;
  frame.axes = {best_x, best_y, z};
  frame.origin = light.centroid + best_x * (0.5 * (best.x0 + best.x1)) + best_y * (0.5 * (best.y0 + best.y1));
  frame.half_x = 0.5 * (best.x1 - best.x0);
  frame.half_y = 0.5 * (best.y1 - best.y0);
  put_box(frame);
  for (std::size_t c = 0; c + 1 < light.contours.size(); ++c) {
    std::vector<Corner> contour;
    for (std::size_t i = light.contours[c]; i < light.contours[c + 1]; ++i) {
      const Vec3d p = frame.to_local(light.vertices[i]);
      contour.push_back({p.x, p.y});
    }
    if (side < 0) std::reverse(contour.begin(), contour.end());
    frame.contours.push_back(std::move(contour));
  }
  return frame;
}

}  // namespace steradian::shadow
