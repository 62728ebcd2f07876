#include "solve/moved_shape.h"

#include <algorithm>
#include <variant>

namespace steradian::solving {

std::optional<Ellipse> half_axes_of(const Polygon& p) {
  if (p.vertices.size() != 4 || !p.holes.empty()) return {};
  const auto& v = p.vertices;
  const Vec3d open = v[0] - v[1] + v[2] - v[3];
  const double size = length(v[2] - v[0]) + length(v[3] - v[1]);
  if (!(length(open) <= 1e-5 * size)) return {};
  return Ellipse{(v[0] + v[1] + v[2] + v[3]) * 0.25, (v[1] - v[0]) * 0.5, (v[3] - v[0]) * 0.5};
}

namespace {

Vec3d center_of(const Polygon& p) {
  Vec3d sum{};
  for (const Vec3d& v : p.vertices) sum += v;
  return p.vertices.empty() ? sum : sum / static_cast<double>(p.vertices.size());
}
Vec3d center_of(const Ellipse& e) { return e.center; }
Vec3d center_of(const Ellipsoid& e) { return e.center; }
Vec3d center_of(const Capsule& c) { return (c.end_a + c.end_b) * 0.5; }
Vec3d center_of(const Line& l) { return (l.end_a + l.end_b) * 0.5; }

Shape moved(const Polygon& p, const Motion& m) {
  Polygon result = p;
  if (const auto axes = half_axes_of(p)) {
    const Vec3d x = m.turned(axes->x) * m.f1, y = m.turned(axes->y) * m.f2, c = m.moved(axes->center);
    // The corners keep their distance from the parallelogram, which is a rounding.
    const Vec3d corners[] = {c - x - y, c + x - y, c + x + y, c - x + y};
    std::copy(std::begin(corners), std::end(corners), result.vertices.begin());
    return result;
  }
  for (Vec3d& v : result.vertices) v = m.moved(v);
  for (auto& hole : result.holes)
    for (Vec3d& v : hole) v = m.moved(v);
  return result;
}
Shape moved(const Ellipse& e, const Motion& m) { return Ellipse{m.moved(e.center), m.turned(e.x) * m.f1, m.turned(e.y) * m.f2}; }
Shape moved(const Ellipsoid& e, const Motion& m) {
  return Ellipsoid{m.moved(e.center), m.turned(e.x) * m.f1, m.turned(e.y) * m.f1, m.turned(e.z) * m.f1};
}
Shape moved(const Capsule& c, const Motion& m) {
  const Vec3d half = m.turned(c.end_b - c.end_a) * (0.5 * m.f1), center = m.moved(center_of(c));
  return Capsule{center - half, center + half, c.radius * m.f2};
}
Shape moved(const Line& l, const Motion& m) { return Line{m.moved(l.end_a), m.moved(l.end_b)}; }

}  // namespace

Vec3d center_of(const Shape& shape) {
  return std::visit([](const auto& s) { return center_of(s); }, shape);
}

std::vector<ShapeSize> sizes_of(const Shape& shape) {
  if (const auto* p = std::get_if<Polygon>(&shape)) {
    if (const auto axes = half_axes_of(*p)) return {{"width", 2 * length(axes->x)}, {"height", 2 * length(axes->y)}};
    return {};
  }
  if (const auto* e = std::get_if<Ellipse>(&shape)) return {{"diameter", 2 * std::max(length(e->x), length(e->y))}};
  if (const auto* e = std::get_if<Ellipsoid>(&shape)) return {{"diameter", 2 * std::max({length(e->x), length(e->y), length(e->z)})}};
  if (const auto* c = std::get_if<Capsule>(&shape)) return {{"length", length(c->end_b - c->end_a)}, {"diameter", 2 * c->radius}};
  return {};
}

double area_ratio(const Shape& shape, double f1, double f2) {
  if (const auto* c = std::get_if<Capsule>(&shape)) {
    const double between = length(c->end_b - c->end_a);
    return c->radius * (2 * c->radius + between) / (f2 * c->radius * (2 * f2 * c->radius + f1 * between));
  }
  return 1 / (f1 * f2);
}

Shape moved(const Shape& shape, const Motion& motion) {
  return std::visit([&](const auto& s) { return moved(s, motion); }, shape);
}

}  // namespace steradian::solving
