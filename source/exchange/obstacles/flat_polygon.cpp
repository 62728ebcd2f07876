#include "exchange/obstacles/flat_polygon.h"

#include <algorithm>
#include <cmath>

namespace steradian::exchange {

double area_of(const FlatPolygon& p) {
  double sum = 0;
  for (std::size_t i = 1; i + 1 < p.size(); ++i) sum += cross2(p[i] - p[0], p[i + 1] - p[0]);
  return 0.5 * sum;
}

Vec2d centroid_of(const FlatPolygon& p, double area) {
  Vec2d sum{};
  for (std::size_t i = 1; i + 1 < p.size(); ++i) sum = sum + (p[0] + p[i] + p[i + 1]) * (cross2(p[i] - p[0], p[i + 1] - p[0]) / (6 * area));
  return sum;
}

FlatPolygon part_beside(const FlatPolygon& p, Vec2d from, Vec2d along, double side, double near) {
  FlatPolygon result;
  std::vector<double> height(p.size());
  for (std::size_t i = 0; i < p.size(); ++i) {
    height[i] = side * cross2(along, p[i] - from);
    if (std::fabs(height[i]) <= near) height[i] = 0;
  }
  for (std::size_t i = 0; i < p.size(); ++i) {
    const std::size_t j = (i + 1) % p.size();
    if (height[i] >= 0) result.push_back(p[i]);
    if (height[i] > 0 && height[j] < 0) result.push_back(p[i] + (p[j] - p[i]) * (height[i] / (height[i] - height[j])));
    if (height[i] < 0 && height[j] > 0) result.push_back(p[j] + (p[i] - p[j]) * (height[j] / (height[j] - height[i])));
  }
  return result;
}

bool clip_to_polygon(EventSegment& s, const FlatPolygon& p, double near) {
  double t0 = 0, t1 = 1;
  const Vec2d way = s.b - s.a;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const Vec2d edge = p[(i + 1) % p.size()] - p[i];
    const double l = std::hypot(edge.x, edge.y);
    if (!(l > 0)) continue;
    // Events along an edge of the piece cut nothing.
    const double a = cross2(edge, s.a - p[i]) / l - near, b = cross2(edge, s.b - p[i]) / l - near;
    if (a < 0 && b < 0) return false;
    if (a < 0) t0 = std::max(t0, a / (a - b));
    if (b < 0) t1 = std::min(t1, a / (a - b));
  }
  if (!(t0 < t1)) return false;
  s = {s.a + way * t0, s.a + way * t1};
  return true;
}

}  // namespace steradian::exchange
