#include "render/lights/light_bounds.h"

#include <algorithm>
#include <cmath>

namespace steradian {
namespace {

// Largest and least products of two numbers from two intervals.
float largest_product(Interval<float> a, Interval<float> b) {
  return std::max({a.low * b.low, a.low * b.high, a.high * b.low, a.high * b.high});
}
float least_product(Interval<float> a, Interval<float> b) {
  return std::min({a.low * b.low, a.low * b.high, a.high * b.low, a.high * b.high});
}

// Largest or least height of the vertex v above the surfaces' horizons.
float height(Vec3f v, const Box3f& positions, const Box3f& normals, float (*product)(Interval<float>, Interval<float>)) {
  const Vec3f low = v - positions.high, high = v - positions.low;
  return product({low.x, high.x}, {normals.low.x, normals.high.x}) + product({low.y, high.y}, {normals.low.y, normals.high.y}) +
         product({low.z, high.z}, {normals.low.z, normals.high.z});
}
float largest_height(Vec3f v, const Box3f& positions, const Box3f& normals) { return height(v, positions, normals, largest_product); }
float least_height(Vec3f v, const Box3f& positions, const Box3f& normals) { return height(v, positions, normals, least_product); }

// Range of the box' heights above a plane.
Interval<float> heights(const Box3f& box, Vec3f normal, Vec3f point) {
  Interval<float> h;
  for (int i = 0; i < 8; ++i) {
    const Vec3f p{(i & 1) != 0 ? box.high.x : box.low.x, (i & 2) != 0 ? box.high.y : box.low.y, (i & 4) != 0 ? box.high.z : box.low.z};
    h.add(dot(p - point, normal));
  }
  return h;
}

bool faces(const auto& flat, const Box3f& positions) { return flat.two_sided || heights(positions, flat.normal, flat.point).high > 0; }
bool faces(const packed::FloatEllipsoid&, const Box3f&) { return true; }
bool faces(const packed::FloatCapsule&, const Box3f&) { return true; }
bool faces(const packed::Punctual&, const Box3f&) { return true; }
bool faces(const packed::Pieces&, const Box3f&) { return true; }

bool reaches(const PackLight& light, const Box3f& positions, const Box3f& normals) {
  if (const auto* punctual = std::get_if<packed::Punctual>(&light.shape);
      punctual != nullptr && punctual->kind == PunctualKind::directional) {
    return largest_height(-static_cast<Vec3f>(punctual->direction), {Vec3f{}, Vec3f{}}, normals) > 0;
  }
  return std::visit(
      [&](const auto& shape) {
        return faces(shape, positions) &&
               shape.any_bound([&](Vec3f point, float radius) { return largest_height(point, positions, normals) > -radius; });
      },
      light.shape);
}

// True if the light's shape lies completely above the horizons. (SeenWhole enlarges it by `spread`.)
bool above(const auto& shape, const Box3f& positions, const Box3f& normals) {
  return !shape.any_bound([&](Vec3f point, float radius) { return !(least_height(point, positions, normals) > radius); });
}
bool before(const auto& flat, const Box3f& positions) {
  const float low = heights(positions, flat.normal, flat.point).low;
  const auto square = [](float a, float b) { return std::max(a * a, b * b); };
  const Vec3f &l = positions.low, &h = positions.high;
  const float positions2 = square(l.x, h.x) + square(l.y, h.y) + square(l.z, h.z);
  return low > 0 && low * low > static_cast<float>(packed::kRounding2) * (positions2 + dot(flat.point, flat.point));
}

struct SeenWhole {
  const Box3f& positions;
  const Box3f& normals;
  float spread;
  bool operator()(const packed::FloatPolygon& p) const { return before(p, positions) && above(p, positions, normals); }
  bool operator()(packed::FloatDisk d) const {
    d.x *= spread;
    d.y *= spread;
    return before(d, positions) && above(d, positions, normals);
  }
  bool operator()(packed::FloatEllipsoid e) const {
    for (Vec3f* axis : {&e.x, &e.y, &e.z}) *axis *= spread;
    return above(e, positions, normals);
  }
  bool operator()(packed::FloatCapsule c) const {
    c.radius *= spread;
    return above(c, positions, normals);
  }
  bool operator()(const packed::Punctual&) const { return false; }
  bool operator()(const packed::Pieces&) const { return false; }
};

}  // namespace

void add(SurfaceBounds& to, const SurfaceBounds& other) {
  to.positions.add(other.positions);
  to.normals.add(other.normals);
}

void add(SurfaceBounds& to, const SurfaceTile& tile, std::size_t first, std::size_t count) {
  for (std::size_t i = first; i < first + count; ++i) {
    if (tile.material[i] == nullptr) continue;
    to.positions.add(Vec3f{tile.position.x[i], tile.position.y[i], tile.position.z[i]});
    to.normals.add(Vec3f{tile.normal.x[i], tile.normal.y[i], tile.normal.z[i]});
    if (tile.coat[i] > 0) to.normals.add(Vec3f{tile.coat_normal.x[i], tile.coat_normal.y[i], tile.coat_normal.z[i]});
  }
}

bool reaches(const PackLight& light, const SurfaceBounds& surfaces) { return reaches(light, surfaces.positions, surfaces.normals); }

bool sees_whole(const PackLight& light, const SurfaceBounds& surfaces, float spread) {
  return std::visit(SeenWhole{surfaces.positions, surfaces.normals, spread}, light.shape);
}

}  // namespace steradian
