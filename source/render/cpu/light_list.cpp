#include "render/cpu/light_list.h"

#include <algorithm>
#include <cmath>

#include "ltc/textured_light.h"
#include "steradian/error.h"

namespace steradian {
namespace {

Vec3f single(Vec3d v) { return static_cast<Vec3f>(v); }

// Three axes of one length, at right angles, up to the rounding of a node's rotation.
bool is_ball(const AreaLight& a) {
  const double r2 = dot(a.x, a.x), least = 1e-6 * r2;
  const auto off = [&](double x) { return std::fabs(x) > least; };
  return !off(dot(a.y, a.y) - r2) && !off(dot(a.z, a.z) - r2) && !off(dot(a.x, a.y)) && !off(dot(a.y, a.z)) && !off(dot(a.z, a.x));
}

PackLight from_ellipsoid(const AreaLight& a) {
  PackLight light;
  light.kind = PackLight::Kind::ellipsoid;
  light.radiance = single(a.polygon.radiance);
  light.center = single(a.center);
  light.axis_x = single(a.x);
  light.axis_y = single(a.y);
  light.axis_z = single(a.z);
  const double det = dot(a.x, cross(a.y, a.z));
  light.unit_x = single(cross(a.y, a.z) / det);
  light.unit_y = single(cross(a.z, a.x) / det);
  light.unit_z = single(cross(a.x, a.y) / det);
  if (is_ball(a)) {
    light.radius = static_cast<float>(length(a.x));
    light.end_a = light.end_b = light.center;
  }
  return light;
}

PackLight from_disk(const AreaLight& a) {
  PackLight light;
  light.kind = PackLight::Kind::ellipse;
  light.radiance = single(a.polygon.radiance);
  light.two_sided = a.polygon.two_sided;
  light.center = light.plane_point = single(a.center);
  light.axis_x = single(a.x);
  light.axis_y = single(a.y);
  const Vec3d normal = cross(a.x, a.y);
  light.plane_normal = single(normal / length(normal));  // not a number where it has no area
  return light;
}

PackLight from_capsule(const AreaLight& a) {
  PackLight light;
  light.kind = PackLight::Kind::capsule;
  light.radiance = single(a.polygon.radiance);
  light.end_a = single(capsule_of(a).end_a);
  light.end_b = single(capsule_of(a).end_b);
  light.radius = static_cast<float>(a.radius);
  return light;
}

PackLight from_area_light(const AreaLight& a) {
  switch (a.shape) {
    case LightShape::disk: return from_disk(a);
    case LightShape::sphere: return from_ellipsoid(a);
    case LightShape::capsule: return from_capsule(a);
    case LightShape::polygon: break;
  }
  return prepare_light(prepare_polygon(a.polygon));
}

PackLight from_punctual(const PunctualLight& p) {
  PackLight light;
  light.kind = p.kind == PunctualKind::point  ? PackLight::Kind::point
               : p.kind == PunctualKind::spot ? PackLight::Kind::spot
                                              : PackLight::Kind::directional;
  light.radiance = single(p.intensity);
  light.position = single(p.position);
  light.direction = single(p.direction);
  if (std::isfinite(p.range) && p.range > 0) light.inverse_range2 = static_cast<float>(1 / (p.range * p.range));
  if (p.kind == PunctualKind::spot) {  // KHR_lights_punctual, "inner and outer cone angles"
    const double scale = 1 / std::max(0.001, p.cos_inner - p.cos_outer);
    light.spot_scale = static_cast<float>(scale);
    light.spot_offset = static_cast<float>(-p.cos_outer * scale);
  }
  return light;
}

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
float largest_product(Interval a, Interval b) {
  return std::max({a.low * b.low, a.low * b.high, a.high * b.low, a.high * b.high});
}

// Largest height of the vertex v above the horizon of any surface of the tile.
float largest_height(Vec3f v, const Box& positions, const Box& normals) {
  const auto along = [](float c, Interval p, Interval n) {
    return largest_product({c - p.high, c - p.low}, n);
  };
  return along(v.x, positions.x, normals.x) + along(v.y, positions.y, normals.y) + along(v.z, positions.z, normals.z);
}

// Distance range of the box from a plane.
Interval heights(const Box& box, Vec3f normal, Vec3f point) {
  Interval h;
  for (int i = 0; i < 8; ++i) {
    const Vec3f p{(i & 1) != 0 ? box.x.high : box.x.low, (i & 2) != 0 ? box.y.high : box.y.low,
                  (i & 4) != 0 ? box.z.high : box.z.low};
    h.add(dot(p - point, normal));
  }
  return h;
}

bool reaches(const PackLight& light, const Box& positions, const Box& normals) {
  switch (light.kind) {
    case PackLight::Kind::polygon: {
      if (!light.two_sided && heights(positions, light.plane_normal, light.plane_point).high <= 0) return false;
      return std::any_of(light.vertices.begin(), light.vertices.end(),
                         [&](Vec3f v) { return largest_height(v, positions, normals) > 0; });
    }
    case PackLight::Kind::ellipse:
      if (!light.two_sided && heights(positions, light.plane_normal, light.plane_point).high <= 0) return false;
      [[fallthrough]];  // axis_z is 0
    case PackLight::Kind::ellipsoid:
      for (int i = 0; i < 8; ++i) {  // corners of the box around the ellipsoid
        const Vec3f v = light.center + light.axis_x * ((i & 1) != 0 ? 1.0f : -1.0f) +
                        light.axis_y * ((i & 2) != 0 ? 1.0f : -1.0f) + light.axis_z * ((i & 4) != 0 ? 1.0f : -1.0f);
        if (largest_height(v, positions, normals) > 0) return true;
      }
      return false;
    case PackLight::Kind::capsule:
      return std::max(largest_height(light.end_a, positions, normals), largest_height(light.end_b, positions, normals)) >
             -light.radius;
    case PackLight::Kind::point:
    case PackLight::Kind::spot: return largest_height(light.position, positions, normals) > 0;
    case PackLight::Kind::directional: {
      const Interval zero{0, 0};
      return largest_height(-light.direction, {zero, zero, zero}, normals) > 0;
    }
  }
  return true;
}

}  // namespace

PackLight prepare_light(const PreparedPolygon& polygon) {
  PackLight light;
  light.polygon = polygon;
  light.radiance = single(polygon.radiance);
  for (const Vec3d& v : polygon.vertices) light.vertices.push_back(single(v));
  light.contours = polygon.contours;
  light.plane_normal = single(polygon.normal);
  light.plane_point = single(polygon.centroid);
  light.two_sided = polygon.two_sided;
  return light;
}

std::vector<PackLight> prepare_lights(const Scene& scene) {
  std::vector<PackLight> lights;
  const auto shines = [](Vec3f r) { return r.x > 0 || r.y > 0 || r.z > 0; };
  for (const AreaLight& a : scene.area_lights) {
    PackLight light = from_area_light(a);
    light.area = &a;
    if (light.kind == PackLight::Kind::polygon && light.vertices.empty()) continue;
    if (light.kind == PackLight::Kind::capsule && !(light.radius > 0)) continue;
    if (!is_finite(light.unit_x) || !is_finite(light.plane_normal) || !shines(light.radiance)) continue;
    if (a.texture && a.texture->use.present())
      light.textured = std::make_shared<TexturedLight>(a, light.polygon, scene.images);
    lights.push_back(std::move(light));
  }
  for (const PunctualLight& p : scene.punctual_lights) {
    PackLight light = from_punctual(p);
    if (shines(light.radiance)) lights.push_back(std::move(light));
  }
  return lights;
}

std::vector<const PackLight*> lights_reaching(const std::vector<PackLight>& lights, const SurfaceTile& tile) {
  Box positions, normals;
  for (std::size_t i = 0; i < kTilePixels; ++i) {
    if (tile.material[i] == nullptr) continue;
    positions.add({tile.position.x[i], tile.position.y[i], tile.position.z[i]});
    normals.add({tile.normal.x[i], tile.normal.y[i], tile.normal.z[i]});
  }
  std::vector<const PackLight*> result;
  for (const PackLight& light : lights)
    if (reaches(light, positions, normals)) result.push_back(&light);
  return result;
}

}  // namespace steradian
