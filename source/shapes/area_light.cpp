#include "steradian/area_light.h"

#include <cmath>
#include <numbers>
#include <utility>
#include <variant>

#include "steradian/capsule_light.h"
#include "steradian/error.h"

namespace steradian {
double luminance(Vec3d rgb) { return 0.2126 * rgb.x + 0.7152 * rgb.y + 0.0722 * rgb.z; }

PolygonLight equal_area_polygon(const Ellipse& ellipse, Vec3d radiance, int vertices) {
  if (vertices < 3) throw Error("", "a polygon needs at least 3 vertices, asked for " + std::to_string(vertices));
  // The inscribed K-gon has the fraction sin(d) / d of the ellipse's area, d = 2 pi / K.
  const double step = 2 * std::numbers::pi / vertices;
  const double out = std::sqrt(step / std::sin(step));
  PolygonLight light;
  light.radiance = radiance;
  light.vertices.reserve(static_cast<std::size_t>(vertices));
  for (int k = 0; k < vertices; ++k)
    light.vertices.push_back(ellipse.center + ellipse.x * (out * std::cos(k * step)) + ellipse.y * (out * std::sin(k * step)));
  return light;
}

std::optional<Ellipse> silhouette(const Ellipsoid& ellipsoid, Vec3d position) {
  const auto& [center, x, y, z] = ellipsoid;
  const double determinant = dot(cross(x, y), z);
  if (!(std::fabs(determinant) > 0)) return {};
  // Transforms the point into the space in which the ellipsoid is the unit sphere, by the inverse of the columns x, y, z.
  const Vec3d to_point = position - center;
  const Vec3d p = Vec3d{dot(cross(y, z), to_point), dot(cross(z, x), to_point), dot(cross(x, y), to_point)} / determinant;
  const double distance = length(p);
  if (!(distance > 1) || !std::isfinite(distance)) return {};
  // From a point at distance d the outline is the circle of radius sqrt(1 - 1/d^2) in the plane at height 1/d.
  const Frame frame = Frame::from_normal(p / distance);
  const double radius = std::sqrt((1 - 1 / distance) * (1 + 1 / distance));
  const auto to_world = [&ellipsoid](Vec3d v) { return ellipsoid.x * v.x + ellipsoid.y * v.y + ellipsoid.z * v.z; };
  Ellipse result{center + to_world(frame.z / distance), to_world(frame.x * radius), to_world(frame.y * radius)};
  if (determinant < 0) result.x = -result.x;
  return result;
}

AreaLight area_light(PolygonLight polygon) {
  return {Polygon{std::move(polygon.vertices), std::move(polygon.holes)}, polygon.radiance, polygon.two_sided};
}

namespace {

struct SeenFrom {
  Vec3d position;
  int vertices;

  PolygonLight operator()(const Polygon& polygon) const { return {polygon.vertices, polygon.holes, {}, false}; }
  PolygonLight operator()(const Ellipse& ellipse) const { return equal_area_polygon(ellipse, {}, vertices); }
  PolygonLight operator()(const Ellipsoid& ellipsoid) const {
    const std::optional<Ellipse> outline = silhouette(ellipsoid, position);
    return outline ? (*this)(*outline) : PolygonLight{};
  }
  PolygonLight operator()(const Capsule& capsule) const { return polygon_of_equal_steps(capsule, position, vertices); }
  PolygonLight operator()(const Line&) const { return {}; }
};

}  // namespace

PolygonLight polygon_seen_from(const AreaLight& light, Vec3d position, int vertices) {
  PolygonLight seen = std::visit(SeenFrom{position, vertices}, light.shape);
  seen.radiance = light.radiance;
  seen.two_sided = light.two_sided && light.is_flat();
  return seen;
}

PolygonLight flat_polygon(const AreaLight& light, int vertices) {
  if (!light.is_flat()) throw Error("light", "has a volume: its outline depends on who sees it", "polygon_seen_from");
  return polygon_seen_from(light, {}, vertices);
}

Vec3d texture_radiance(const LightTexture& texture, const std::vector<Image>& images, Vec3d p) {
  const Vec3d r = p - texture.origin;
  const Vec4f t = sample_texture(
      images, texture.use, {static_cast<float>(dot(r, texture.du) + texture.u0), static_cast<float>(dot(r, texture.dv) + texture.v0)});
  return texture.factor * static_cast<Vec3d>(Vec3f{t.x, t.y, t.z});
}

namespace {

// Axes with x cross y along the normal; the area is factor times that of the axes' rectangle.
struct FlatAxes {
  Vec3d x, y;
  double factor;
};

FlatAxes axes_of(const Shape& shape) {
  if (const auto* disk = std::get_if<Ellipse>(&shape)) return {disk->x, disk->y, std::numbers::pi};
  const auto* polygon = std::get_if<Polygon>(&shape);
  if (polygon == nullptr || polygon->vertices.size() != 4 || !polygon->holes.empty())
    throw Error("profile", "only rects and disks shine by a profile", "give one of those, or a point");
  const auto& v = polygon->vertices;
  return {v[1] - v[0], v[3] - v[0], 1};
}

// True if the profile sends anything beyond a quarter turn from z.
bool shines_back(const LightProfile& profile) {
  if (profile.type == LightProfile::Type::b) return false;
  for (std::size_t i = 0; i < profile.candela.size(); ++i)
    if (profile.vertical[i % profile.vertical.size()] > 90 && profile.candela[i] > 0) return true;
  return false;
}

}  // namespace

void set_emission(AreaLight& light, std::shared_ptr<const LightProfile> profile, Vec3d towards_x, Vec3d intensity) {
  const FlatAxes flat = axes_of(light.shape);
  const Vec3d normal = cross(flat.x, flat.y);
  light.two_sided = shines_back(*profile);
  light.radiance = {};
  light.power = 0;
  LightEmission emission{std::move(profile), {}, intensity, flat.factor * length(normal)};
  if (emission.area > 0) {
    emission.axes = profile_axes(normal, towards_x);
    const double flux = luminous_flux(*emission.profile);
    light.radiance = intensity * (flux / (std::numbers::pi * emission.area * (light.two_sided ? 2 : 1)));
    light.power = luminance(intensity) * flux / std::numbers::pi;
  }
  light.emission = std::move(emission);
}

Vec3d emitted_radiance(const LightEmission& e, Vec3d direction) {
  const double ahead = dot(direction, e.axes.aim);
  if (ahead == 0) return {};
  const double candela = intensity(*e.profile, {dot(direction, e.axes.x), dot(direction, e.axes.y), ahead});
  return e.intensity * (candela / (e.area * std::fabs(ahead)));
}

}  // namespace steradian
