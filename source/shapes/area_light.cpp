#include "steradian/area_light.h"

#include <cmath>

#include "steradian/capsule_light.h"
#include "steradian/error.h"

namespace steradian {
namespace {
constexpr double kPi = 3.14159265358979324;
}

double luminance(Vec3d rgb) { return 0.2126 * rgb.x + 0.7152 * rgb.y + 0.0722 * rgb.z; }

PolygonLight equal_area_polygon(const Ellipse& ellipse, Vec3d radiance, int vertices) {
  if (vertices < 3) throw Error("", "a polygon needs at least 3 vertices, asked for " + std::to_string(vertices));
  // The inscribed K-gon has the share sin(d) / d of the ellipse's area, d = 2 pi / K.
  const double step = 2 * kPi / vertices;
  const double out = std::sqrt(step / std::sin(step));
  PolygonLight light;
  light.radiance = radiance;
  light.vertices.reserve(static_cast<std::size_t>(vertices));
  for (int k = 0; k < vertices; ++k)
    light.vertices.push_back(ellipse.center + ellipse.x * (out * std::cos(k * step)) + ellipse.y * (out * std::sin(k * step)));
  return light;
}

std::optional<Ellipse> silhouette(Vec3d center, Vec3d x, Vec3d y, Vec3d z, Vec3d position) {
  const double determinant = dot(cross(x, y), z);
  if (!(std::fabs(determinant) > 0)) return {};
  // Into the space where the ellipsoid is the unit sphere: the inverse of the columns x, y, z.
  const Vec3d to_point = position - center;
  const Vec3d p = Vec3d{dot(cross(y, z), to_point), dot(cross(z, x), to_point), dot(cross(x, y), to_point)} / determinant;
  const double distance = length(p);
  if (!(distance > 1) || !std::isfinite(distance)) return {};
  // A point at distance d sees the circle of radius sqrt(1 - 1/d^2) in the plane at height 1/d.
  const Frame frame = Frame::from_normal(p / distance);
  const double radius = std::sqrt((1 - 1 / distance) * (1 + 1 / distance));
  const auto to_world = [&](Vec3d v) { return x * v.x + y * v.y + z * v.z; };
  Ellipse result{center + to_world(frame.z / distance), to_world(frame.x * radius), to_world(frame.y * radius)};
  if (determinant < 0) result.x = -result.x;
  return result;
}

Capsule capsule_of(const AreaLight& light) { return {light.center - light.x, light.center + light.x, light.radius}; }

PolygonLight polygon_seen_from(const AreaLight& light, Vec3d position, int vertices) {
  if (!light.is_solid()) return light.polygon;
  if (light.shape == LightShape::capsule) {
    PolygonLight seen = polygon_of_equal_steps(capsule_of(light), position, vertices);
    seen.radiance = light.polygon.radiance;
    return seen;
  }
  const auto outline = silhouette(light.center, light.x, light.y, light.z, position);
  if (outline) return equal_area_polygon(*outline, light.polygon.radiance, vertices);
  PolygonLight nothing;
  nothing.radiance = light.polygon.radiance;
  return nothing;
}

Vec3d texture_radiance(const LightTexture& texture, const std::vector<Image>& images, Vec3d p) {
  const Vec3d r = p - texture.origin;
  const Vec4f t = sample_texture(
      images, texture.use, {static_cast<float>(dot(r, texture.du) + texture.u0), static_cast<float>(dot(r, texture.dv) + texture.v0)});
  return texture.factor * static_cast<Vec3d>(Vec3f{t.x, t.y, t.z});
}

}  // namespace steradian
