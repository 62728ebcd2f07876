#include "render/cpu/light_list.h"

#include <algorithm>
#include <cmath>

#include "integrals/ltc/textured_light.h"
#include "integrals/profiled_light.h"
#include "steradian/error.h"

namespace steradian {
namespace {

struct Packed {
  const AreaLight& light;
  PackLight of(auto shape) const {
    PackLight result;
    result.shape = shape;
    return result;
  }
  PackLight operator()(const Polygon&) const { return prepare_light(prepare_polygon(flat_polygon(light))); }
  PackLight operator()(const Ellipse& e) const { return of(packed::prepare_disk(e, light.two_sided)); }
  PackLight operator()(const Ellipsoid& e) const { return of(packed::prepare_ellipsoid(e)); }
  PackLight operator()(const Capsule& c) const { return of(packed::prepare_capsule(c)); }
  PackLight operator()(const Line& l) const { return (*this)(Capsule{l.end_a, l.end_b, 0}); }
};

PackLight from_area_light(const AreaLight& a) {
  PackLight light = std::visit(Packed{a}, a.shape);
  light.radiance = static_cast<Vec3f>(a.radiance);
  light.area = &a;
  return light;
}

// Whether it has an area or a volume.
bool has_extent(const packed::Polygon& light) { return !light.vertices.empty(); }
bool has_extent(const packed::Disk& light) { return is_finite(light.normal); }
bool has_extent(const packed::Ellipsoid& light) { return is_finite(light.inverse_x); }
bool has_extent(const packed::Capsule& light) { return light.radius > 0; }
bool has_extent(const packed::Punctual&) { return true; }
bool has_extent(const packed::Pieces&) { return true; }

struct Interval {
  float low = INFINITY, high = -INFINITY;
  void add(float x) {
    low = std::min(low, x);
    high = std::max(high, x);
  }
};

struct Box {
  Interval x, y, z;
  void add(Vec3f v) {
    x.add(v.x);
    y.add(v.y);
    z.add(v.z);
  }
};

// Largest product of two numbers from two intervals.
float largest_product(Interval a, Interval b) { return std::max({a.low * b.low, a.low * b.high, a.high * b.low, a.high * b.high}); }

// Largest height of the vertex v above the horizon of any surface of the tile.
float largest_height(Vec3f v, const Box& positions, const Box& normals) {
  const auto along = [](float c, Interval p, Interval n) { return largest_product({c - p.high, c - p.low}, n); };
  return along(v.x, positions.x, normals.x) + along(v.y, positions.y, normals.y) + along(v.z, positions.z, normals.z);
}

// Distance range of the box from a plane.
Interval heights(const Box& box, Vec3f normal, Vec3f point) {
  Interval h;
  for (int i = 0; i < 8; ++i) {
    const Vec3f p{(i & 1) != 0 ? box.x.high : box.x.low, (i & 2) != 0 ? box.y.high : box.y.low, (i & 4) != 0 ? box.z.high : box.z.low};
    h.add(dot(p - point, normal));
  }
  return h;
}

bool faces(const auto& flat, const Box& positions) { return flat.two_sided || heights(positions, flat.normal, flat.point).high > 0; }
bool faces(const packed::Ellipsoid&, const Box&) { return true; }
bool faces(const packed::Capsule&, const Box&) { return true; }
bool faces(const packed::Punctual&, const Box&) { return true; }
bool faces(const packed::Pieces&, const Box&) { return true; }

bool reaches(const PackLight& light, const Box& positions, const Box& normals) {
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

// Where an edge passes the ball, if points of the ball see it under nearly half a turn.
std::optional<Vec3d> foot_on_long_edge(Vec3d a, Vec3d b, Vec3d center, double radius) {
  constexpr double kBend = 0.014;  // what is left of half a turn [rad] where an edge's plane is known to 1e-5
  constexpr double kLong = 20;     // an edge's least length on each side, in the ball's radii: points of a tile may touch any shorter edge
  const double span = length(b - a);
  if (!(span > 2 * kLong * radius)) return std::nullopt;
  const Vec3d along = (b - a) / span;
  const double before = dot(center - a, along), arm = std::min(before, span - before);
  const Vec3d foot = a + along * before;
  if (arm < kLong * radius || length(center - foot) - radius > kBend * arm) return std::nullopt;
  return foot;
}

}  // namespace

PackLight prepare_light(const PreparedPolygon& polygon) {
  PackLight light;
  light.shape = packed::prepare(polygon);
  light.polygon = polygon;
  light.radiance = static_cast<Vec3f>(polygon.radiance);
  return light;
}

std::vector<PackLight> prepare_lights(const Scene& scene, std::span<const AreaLight> beside) {
  std::vector<PackLight> lights;
  const auto add = [&](PackLight light) {
    const Vec3f& r = light.radiance;
    const bool shines = r.x > 0 || r.y > 0 || r.z > 0;
    if (shines && std::visit([](const auto& shape) { return has_extent(shape); }, light.shape)) {
      light.index = lights.size();
      lights.push_back(std::move(light));
    }
  };
  for (const AreaLight& a : scene.area_lights) {
    PackLight light = from_area_light(a);
    if (a.texture && a.texture->use.present() && !light.polygon.vertices.empty())
      light.textured = std::make_shared<TexturedLight>(a, light.polygon, scene.images);
    if (a.emission) light.profiled = std::make_shared<ProfiledLight>(a);
    add(std::move(light));
  }
  for (const AreaLight& a : beside) add(from_area_light(a));
  for (const PunctualLight& p : scene.punctual_lights) {
    PackLight light;
    light.shape = packed::prepare(p);
    light.radiance = static_cast<Vec3f>(p.intensity);
    add(std::move(light));
  }
  return lights;
}

std::optional<packed::Polygon> with_long_edges_cut(const PreparedPolygon& light, Vec3d center, double radius) {
  PreparedPolygon cut;  // stays empty up to the first long edge: there is none in most tiles
  std::size_t contour = 0;
  for (std::size_t i = 0; i < light.vertices.size(); ++i) {
    while (i == light.contours[contour + 1]) ++contour;
    const bool last = i + 1 == light.contours[contour + 1];
    const Vec3d a = light.vertices[i], b = light.vertices[last ? light.contours[contour] : i + 1];
    const std::optional<Vec3d> foot = foot_on_long_edge(a, b, center, radius);
    if (foot && cut.contours.empty()) {
      cut = light;
      cut.vertices.resize(i);
      cut.contours.resize(contour + 1);
    }
    if (cut.contours.empty()) continue;
    cut.vertices.push_back(a);
    if (foot)
      for (const double at : {-2.0, 0.0, 2.0}) cut.vertices.push_back(*foot + normalized(b - a) * (at * radius));
    if (last) cut.contours.push_back(cut.vertices.size());
  }
  if (cut.contours.empty()) return std::nullopt;
  return packed::prepare(cut);
}

ReachingLights lights_reaching(std::span<const PackLight* const> lights, const SurfaceTile& tile) {
  Box positions, normals;
  for (std::size_t i = 0; i < kTilePixels; ++i) {
    if (tile.material[i] == nullptr) continue;
    positions.add({tile.position.x[i], tile.position.y[i], tile.position.z[i]});
    normals.add({tile.normal.x[i], tile.normal.y[i], tile.normal.z[i]});
    if (tile.coat[i] > 0) normals.add({tile.coat_normal.x[i], tile.coat_normal.y[i], tile.coat_normal.z[i]});
  }
  const auto low = [](const Box& b) { return Vec3f{b.x.low, b.y.low, b.z.low}; };
  const auto high = [](const Box& b) { return Vec3f{b.x.high, b.y.high, b.z.high}; };
  return lights_reaching(lights, {low(positions), high(positions), low(normals), high(normals)});
}

ReachingLights lights_reaching(std::span<const PackLight* const> lights, const SurfaceBounds& surfaces) {
  const auto box = [](Vec3f low, Vec3f high) { return Box{{low.x, high.x}, {low.y, high.y}, {low.z, high.z}}; };
  const Box positions = box(surfaces.low, surfaces.high), normals = box(surfaces.normal_low, surfaces.normal_high);
  ReachingLights result;
  result.low = surfaces.low;
  result.high = surfaces.high;
  const auto low = static_cast<Vec3d>(result.low), high = static_cast<Vec3d>(result.high);
  for (const PackLight* light : lights) {
    if (!reaches(*light, positions, normals)) continue;
    result.lights.push_back(light);
    if (!light->is_polygon()) continue;
    std::optional<packed::Polygon> cut = with_long_edges_cut(light->polygon, (low + high) / 2, length(high - low) / 2);
    if (!cut) continue;
    result.cut.push_back(std::make_unique<PackLight>(*light));
    result.cut.back()->shape = std::move(*cut);
    result.lights.back() = result.cut.back().get();
  }
  return result;
}

}  // namespace steradian
