#include "render/lights/light_list.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "integrals/textured/profiled_light.h"
#include "integrals/textured/textured_light.h"
#include "render/lights/light_bounds.h"
#include "steradian/error.h"

namespace steradian {
namespace {

struct PackedShape {
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
  PackLight light = std::visit(PackedShape{a}, a.shape);
  light.radiance = static_cast<Vec3f>(a.radiance);
  light.area = &a;
  return light;
}

// True if the light has an area or a volume.
bool has_extent(const packed::FloatPolygon& light) { return !light.vertices.empty(); }
bool has_extent(const packed::FloatDisk& light) { return is_finite(light.normal); }
bool has_extent(const packed::FloatEllipsoid& light) { return is_finite(light.inverse_x); }
bool has_extent(const packed::FloatCapsule& light) { return light.radius > 0; }
bool has_extent(const packed::Punctual&) { return true; }
bool has_extent(const packed::Pieces&) { return true; }

// Foot of the ball's centre on an edge, if points of the ball see the edge under nearly half a turn.
std::optional<Vec3d> foot_on_long_edge(Vec3d a, Vec3d b, Vec3d center, double radius) {
  constexpr double kBend = 0.014;  // rest to half a turn [rad] at which an edge's plane is known to 1e-5
  constexpr double kLong = 20;     // an edge's least length on each side, in the ball's radii: points of a tile may touch any shorter edge
  const double span = length(b - a);
  if (!(span > 2 * kLong * radius)) return std::nullopt;
  const Vec3d along = (b - a) / span;
  const double before = dot(center - a, along), arm = std::min(before, span - before);
  const Vec3d foot = a + along * before;
  if (arm < kLong * radius || length(center - foot) - radius > kBend * arm) return std::nullopt;
  return foot;
}

// Lights share the table of their profile. Each takes up to 1.2 MB, so a file of many profiles has tables for the first ones only.
class ProfileTables {
 public:
  std::shared_ptr<const ProfileTable> of(const std::shared_ptr<const LightProfile>& profile) {
    constexpr std::size_t kMostTables = 64;
    const auto found = tables_.find(profile.get());
    if (found != tables_.end()) return found->second;
    if (tables_.size() == kMostTables) return nullptr;
    return tables_[profile.get()] = std::make_shared<const ProfileTable>(*profile);
  }

 private:
  std::map<const LightProfile*, std::shared_ptr<const ProfileTable>> tables_;
};

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
  ProfileTables tables;
  for (const AreaLight& a : scene.area_lights) {
    PackLight light = from_area_light(a);
    if (a.texture && a.texture->use.present() && !light.polygon.vertices.empty())
      light.textured = std::make_shared<TexturedLight>(a, light.polygon, scene.images);
    if (a.emission) light.profiled = std::make_shared<ProfiledLight>(a, tables.of(a.emission->profile));
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

std::optional<packed::FloatPolygon> with_long_edges_cut(const PreparedPolygon& light, Vec3d center, double radius) {
  PreparedPolygon cut;  // stays empty up to the first long edge; most tiles have none
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
  SurfaceBounds bounds;
  add(bounds, tile, 0, kTilePixels);
  return lights_reaching(lights, bounds);
}

ReachingLights lights_reaching(std::span<const PackLight* const> lights, const SurfaceBounds& surfaces) {
  ReachingLights result;
  const Box3d box{static_cast<Vec3d>(surfaces.positions.low), static_cast<Vec3d>(surfaces.positions.high)};
  for (const PackLight* light : lights) {
    if (!reaches(*light, surfaces)) continue;
    result.lights.push_back(light);
    if (!light->is_polygon()) continue;
    std::optional<packed::FloatPolygon> cut = with_long_edges_cut(light->polygon, box.center(), box.radius());
    if (!cut) continue;
    result.cut.push_back(std::make_unique<PackLight>(*light));
    result.cut.back()->shape = std::move(*cut);
    result.lights.back() = result.cut.back().get();
  }
  return result;
}

}  // namespace steradian
