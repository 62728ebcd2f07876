#include "render/lights/light_bounds.h"

#include <algorithm>
#include <cmath>

namespace steradian {
namespace {

struct Interval {
  float low = INFINITY, high = -INFINITY;
  void add(float x) {
    low = std::min(low, x);
    high = std::max(high, x);
  }
};

Vec3f lowest(Vec3f a, Vec3f b) { return {std::min(a.x, b.x), std::min(a.y, b.y), std::min(a.z, b.z)}; }
Vec3f highest(Vec3f a, Vec3f b) { return {std::max(a.x, b.x), std::max(a.y, b.y), std::max(a.z, b.z)}; }

struct LightBox {
  Interval x, y, z;
};
LightBox box_of(Vec3f low, Vec3f high) { return {{low.x, high.x}, {low.y, high.y}, {low.z, high.z}}; }

// Largest and least products of two numbers from two intervals.
float largest_product(Interval a, Interval b) { return std::max({a.low * b.low, a.low * b.high, a.high * b.low, a.high * b.high}); }
float least_product(Interval a, Interval b) { return std::min({a.low * b.low, a.low * b.high, a.high * b.low, a.high * b.high}); }

// Largest or least height of the vertex v above the surfaces' horizons.
float height(Vec3f v, const LightBox& positions, const LightBox& normals, float (*product)(Interval, Interval)) {
  const auto along = [&](float c, Interval p, Interval n) { return product({c - p.high, c - p.low}, n); };
  return along(v.x, positions.x, normals.x) + along(v.y, positions.y, normals.y) + along(v.z, positions.z, normals.z);
}
float largest_height(Vec3f v, const LightBox& positions, const LightBox& normals) { return height(v, positions, normals, largest_product); }
float least_height(Vec3f v, const LightBox& positions, const LightBox& normals) { return height(v, positions, normals, least_product); }

// Range of the box' heights above a plane.
Interval heights(const LightBox& box, Vec3f normal, Vec3f point) {
  Interval h;
  for (int i = 0; i < 8; ++i) {
    const Vec3f p{(i & 1) != 0 ? box.x.high : box.x.low, (i & 2) != 0 ? box.y.high : box.y.low, (i & 4) != 0 ? box.z.high : box.z.low};
    h.add(dot(p - point, normal));
  }
  return h;
}

bool faces(const auto& flat, const LightBox& positions) { return flat.two_sided || heights(positions, flat.normal, flat.point).high > 0; }
bool faces(const packed::Ellipsoid&, const LightBox&) { return true; }
bool faces(const packed::Capsule&, const LightBox&) { return true; }
bool faces(const packed::Punctual&, const LightBox&) { return true; }
bool faces(const packed::Pieces&, const LightBox&) { return true; }

bool reaches(const PackLight& light, const LightBox& positions, const LightBox& normals) {
  if (const auto* punctual = std::get_if<packed::Punctual>(&light.shape);
      punctual != nullptr && punctual->kind == PunctualKind::directional) {
    const Interval zero{0, 0};
    return largest_height(-static_cast<Vec3f>(punctual->direction), {zero, zero, zero}, normals) > 0;
  }
  return std::visit(
      [&](const auto& shape) {
        return faces(shape, positions) &&
               shape.any_bound([&](Vec3f point, float radius) { return largest_height(point, positions, normals) > -radius; });
      },
      light.shape);
}

// True if the light's shape lies completely above the horizons. (SeenWhole enlarges it by `spread`.)
bool above(const auto& shape, const LightBox& positions, const LightBox& normals) {
  return !shape.any_bound([&](Vec3f point, float radius) { return !(least_height(point, positions, normals) > radius); });
}
bool before(const auto& flat, const LightBox& positions) { return heights(positions, flat.normal, flat.point).low > 0; }

struct SeenWhole {
  const LightBox& positions;
  const LightBox& normals;
  float spread;
  bool operator()(const packed::Polygon& p) const { return before(p, positions) && above(p, positions, normals); }
  bool operator()(packed::Disk d) const {
    d.x *= spread;
    d.y *= spread;
    return before(d, positions) && above(d, positions, normals);
  }
  bool operator()(packed::Ellipsoid e) const {
    for (Vec3f* axis : {&e.x, &e.y, &e.z}) *axis *= spread;
    return above(e, positions, normals);
  }
  bool operator()(packed::Capsule c) const {
    c.radius *= spread;
    return above(c, positions, normals);
  }
  bool operator()(const packed::Punctual&) const { return false; }
  bool operator()(const packed::Pieces&) const { return false; }
};

}  // namespace

void add(SurfaceBounds& to, const SurfaceBounds& other) {
  to.low = lowest(to.low, other.low);
  to.high = highest(to.high, other.high);
  to.normal_low = lowest(to.normal_low, other.normal_low);
  to.normal_high = highest(to.normal_high, other.normal_high);
}

void add(SurfaceBounds& to, const SurfaceTile& tile, std::size_t first, std::size_t count) {
  for (std::size_t i = first; i < first + count; ++i) {
    if (tile.material[i] == nullptr) continue;
    const Vec3f p{tile.position.x[i], tile.position.y[i], tile.position.z[i]}, n{tile.normal.x[i], tile.normal.y[i], tile.normal.z[i]};
    add(to, {p, p, n, n});
    if (!(tile.coat[i] > 0)) continue;
    const Vec3f c{tile.coat_normal.x[i], tile.coat_normal.y[i], tile.coat_normal.z[i]};
    add(to, {p, p, c, c});
  }
}

bool reaches(const PackLight& light, const SurfaceBounds& surfaces) {
  return reaches(light, box_of(surfaces.low, surfaces.high), box_of(surfaces.normal_low, surfaces.normal_high));
}

bool sees_whole(const PackLight& light, const SurfaceBounds& surfaces, float spread) {
  const LightBox positions = box_of(surfaces.low, surfaces.high), normals = box_of(surfaces.normal_low, surfaces.normal_high);
  return std::visit(SeenWhole{positions, normals, spread}, light.shape);
}

}  // namespace steradian
