#include "plane/exact/on_curve.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace steradian::plane {
namespace {

using std::numbers::pi;

// A bound of the error by which coordinates that were rounded move a point relative to the curve.
double rounding_at(const Curve& c, Vec2d p) {
  const auto size = [](Vec2d v) { return std::fabs(v.x) + std::fabs(v.y); };
  const double curve =
      c.kind == Curve::Kind::segment ? size(c.a) + size(c.b) : size(c.ellipse.center) + size(c.ellipse.x) + size(c.ellipse.y);
  return 0x1p-49 * (size(p) + curve);
}

// Does the arc run over the direction of a point in the ellipse's space?
bool runs_over(const Curve& arc, Vec2d unit) {
  const double from_start = angle_of(unit) - arc.tau0;
  return from_start - 2 * pi * std::floor(from_start / (2 * pi)) <= arc.tau_span;
}

Vec2d tangent_at(const Curve& c, Vec2d p) {
  if (c.kind == Curve::Kind::segment) return c.b - c.a;
  const Vec2d unit = c.ellipse.to_unit(p);
  return c.ellipse.y * unit.x - c.ellipse.x * unit.y;
}

}  // namespace

double distance_to(const Curve& c, Vec2d p) {
  if (c.kind == Curve::Kind::segment) return distance_to_segment(p, c.a, c.b);
  const PlaneEllipse& e = c.ellipse;
  const Vec2d unit = e.to_unit(p);
  if (!runs_over(c, unit)) return std::min(length(p - c.a), length(p - c.b));
  const double d = length(unit);
  // The gradient of d has the length of this vector over d times the determinant.
  const Vec2d outward{unit.x * e.y.y - unit.y * e.x.y, unit.y * e.x.x - unit.x * e.y.x};
  return std::fabs(d - 1) * d * std::fabs(cross(e.x, e.y)) / std::max(length(outward), 1e-300);
}

bool is_on(const Curve& c, Vec2d p) { return distance_to(c, p) <= rounding_at(c, p); }

std::vector<Vec2d> places_beside(const std::vector<const Curve*>& curves, Vec2d p) {
  std::vector<double> tangents;
  double rounding = 0;
  for (const Curve* c : curves) {
    const Vec2d along = tangent_at(*c, p);
    tangents.push_back(angle_of(along));
    tangents.push_back(angle_of(-along));
    rounding = std::max(rounding, rounding_at(*c, p));
  }
  std::sort(tangents.begin(), tangents.end());
  std::vector<std::pair<double, double>> wedges;  // width and middle
  for (std::size_t i = 0; i < tangents.size(); ++i) {
    const double next = i + 1 < tangents.size() ? tangents[i + 1] : tangents[0] + 2 * pi;
    wedges.push_back({next - tangents[i], 0.5 * (tangents[i] + next)});
  }
  std::stable_sort(wedges.begin(), wedges.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
  std::vector<Vec2d> places;
  for (double step : {4.0, 16.0, 64.0})
    for (const auto& [width, middle] : wedges)
      if (width > 1e-6) places.push_back(p + direction_at(middle) * (step * rounding / std::sin(0.5 * width)));
  return places;
}

}  // namespace steradian::plane
