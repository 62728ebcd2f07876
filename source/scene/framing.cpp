#include "scene/framing.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include "core/lattices.h"

namespace steradian::scene {
namespace {

const Vec3d kTowardsCamera = {0.6, 0.7, 1};  // from a scene without a camera: 31 degrees up, so that a box shows its top

struct Sphere {
  Vec3d center;
  double radius = 1;
};

Sphere bounding_sphere(const Scene& scene) {
  const double radius = length(scene.bounds_max - scene.bounds_min) / 2;
  // The camera keeps a distance even from a scene of one point or an empty one.
  return {(scene.bounds_min + scene.bounds_max) * 0.5, radius > 0 ? radius : 1};
}

}  // namespace

Box3d box_around(const std::vector<Mesh>& meshes) {
  Box3d box;
  for (const Mesh& mesh : meshes)
    for (const Vec3f& p : mesh.positions) box.add(static_cast<Vec3d>(p));
  return box;
}

Vec3d far_middle(const Box3d& box) {
  constexpr double kFar = 16;  // sizes
  if (box.is_empty()) return {};
  const Vec3d size = box.size(), middle = (box.low + box.high) * 0.5;
  const double largest = std::max({std::fabs(middle.x), std::fabs(middle.y), std::fabs(middle.z)});
  return largest > kFar * std::max({size.x, size.y, size.z}) ? middle : Vec3d{};
}

void measure_bounds(Scene& scene) {
  const Box3d box = box_around(scene.meshes);
  if (box.is_empty()) return;
  scene.bounds_min = box.low;
  scene.bounds_max = box.high;
}

Camera framing_camera(const Scene& scene, double aspect) {
  constexpr double kMargin = 1.05;
  Camera camera;
  camera.name = "default";
  camera.z = normalized(kTowardsCamera);
  camera.x = normalized(cross(Vec3d{0, 1, 0}, camera.z));
  camera.y = cross(camera.z, camera.x);
  const double up = std::tan(camera.yfov / 2) / kMargin, across = up * aspect;

  // A point at (x, y, z) in the camera's axes is in the picture where +-y < up (d - z) and +-x < across (d - z). Here d is the camera's z.
  // Each pair of opposite sides demands a d once the camera is in the middle between them.
  double right = -INFINITY, left = -INFINITY, top = -INFINITY, bottom = -INFINITY, nearest = -INFINITY;
  const bool only_lights = std::all_of(scene.meshes.begin(), scene.meshes.end(), [](const Mesh& mesh) { return mesh.is_light_shape; });
  for (const Mesh& mesh : scene.meshes) {
    if (mesh.is_light_shape && !only_lights) continue;
    for (const Vec3f& p : mesh.positions) {
      const auto v = static_cast<Vec3d>(p);
      const double x = dot(v, camera.x), y = dot(v, camera.y), z = dot(v, camera.z);
      right = std::max(right, x + across * z);
      left = std::max(left, -x + across * z);
      top = std::max(top, y + up * z);
      bottom = std::max(bottom, -y + up * z);
      nearest = std::max(nearest, z);
    }
  }
  const Sphere sphere = bounding_sphere(scene);
  if (!std::isfinite(nearest) || scene.bounds_min == scene.bounds_max) {
    camera.position = sphere.center + camera.z * (kMargin * sphere.radius / std::sin(camera.yfov / 2));
    return camera;
  }
  // The camera keeps a distance even from a point, or from a line along the view.
  const double d = std::max({(right + left) / (2 * across), (top + bottom) / (2 * up), nearest + 0.05 * sphere.radius});
  camera.position = camera.x * ((right - left) / 2) + camera.y * ((top - bottom) / 2) + camera.z * d;
  return camera;
}

namespace {

const Vec3d kTowardsKey = {-0.4, 0.8, 0.6};

// A square that faces the scene's centre from three radii away, with a half side of one radius. The irradiance there [radiance 1 is pi] on
// a surface that faces the square: radiance (2 r)^2 / (3 r)^2.
AreaLight square_light(const Scene& scene, const char* name, Vec3d towards, double irradiance) {
  const Sphere sphere = bounding_sphere(scene);
  const double r = sphere.radius;
  const Vec3d to_light = normalized(towards);
  const Frame frame = Frame::from_normal(-to_light);
  AreaLight light;
  light.name = name;
  const Vec3d center = sphere.center + to_light * (3 * r);
  const Vec3d x = frame.x * r, y = frame.y * r;
  light.shape = Polygon{{center - x - y, center + x - y, center + x + y, center - x + y}, {}};
  const double radiance = irradiance * 9 / 4;
  light.radiance = {radiance, radiance, radiance};
  light.power = luminance(light.radiance) * 4 * r * r;
  return light;
}

}  // namespace

AreaLight default_light(const Scene& scene) { return square_light(scene, "default", kTowardsKey, std::numbers::pi); }

namespace {

PunctualLight directional_light(const char* name, Vec3d direction, double irradiance) {
  PunctualLight light;
  light.name = name;
  light.kind = PunctualKind::directional;
  light.direction = direction;
  light.intensity = {irradiance, irradiance, irradiance};
  return light;
}

}  // namespace

PunctualLight default_fill() { return directional_light("default fill", -normalized(kTowardsCamera), std::numbers::pi / 4); }

namespace {

struct SurfacePoint {
  Vec3d position, normal;
};

// Points spread evenly over the triangles that face the camera and do not emit.
std::vector<SurfacePoint> points_in_view(const Scene& scene, const Camera& camera, int count) {
  struct Piece {
    Vec3d corner, e1, e2, normal;
    double area;
  };
  std::vector<Piece> pieces;
  double total = 0;
  for (const Mesh& mesh : scene.meshes)
    for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
      if (mesh.is_emitter() && mesh.triangle_lights[t] >= 0) continue;
      const auto at = [&](std::size_t c) { return static_cast<Vec3d>(mesh.positions[mesh.indices[3 * t + c]]); };
      const Vec3d a = at(0), e1 = at(1) - a, e2 = at(2) - a, n = cross(e1, e2);
      if (!(dot(n, camera.position - a) > 0)) continue;
      pieces.push_back({a, e1, e2, normalized(n), length(n) / 2});
      total += pieces.back().area;
    }
  std::vector<SurfacePoint> points;
  double before = 0;
  for (const Piece& piece : pieces) {
    before += piece.area;
    while (static_cast<int>(points.size()) < count && (static_cast<double>(points.size()) + 0.5) * total < before * count) {
      // Points that are even over the unit square, folded into the triangle.
      const auto i = static_cast<double>(points.size() + 1);
      auto [u, v] = r2_place(i);
      if (u + v > 1) u = 1 - u, v = 1 - v;
      points.push_back({piece.corner + piece.e1 * u + piece.e2 * v, piece.normal});
    }
  }
  return points;
}

// The median luminance, without shadows, that the scene's flat lights send to the surfaces in view: half of them get at least as much.
double median_irradiance(const Scene& scene, const Camera& camera) {
  constexpr std::size_t kMostEdges = 1'000'000;  // edges to integrate, some fifty milliseconds' worth
  struct Light {
    PreparedPolygon polygon;
    double luminance;
  };
  std::vector<Light> lights;
  std::size_t edges = 0;
  for (const AreaLight& light : scene.area_lights) {
    if (!light.is_flat()) continue;
    lights.push_back({prepare_polygon(flat_polygon(light)), luminance(light.radiance)});
    edges += lights.back().polygon.vertices.size();
  }
  const std::size_t count = std::clamp(kMostEdges / std::max(edges, std::size_t{1}), std::size_t{15}, std::size_t{255});
  std::vector<double> values;
  for (const SurfacePoint& p : points_in_view(scene, camera, static_cast<int>(count))) {
    double sum = 0;
    for (const Light& light : lights) sum += light.luminance * polygon_irradiance(light.polygon, p.position, p.normal);
    values.push_back(sum);
  }
  if (values.empty()) return INFINITY;  // nothing to light
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace

bool wants_light(const Scene& scene, const Camera& camera) {
  if (!scene.punctual_lights.empty()) return false;
  if (scene.area_lights.empty()) return true;
  double power = 0;
  for (const AreaLight& light : scene.area_lights) {
    if (!light.texture) return false;
    power += light.power;
  }
  double area = 0, emitting = 0;
  for (const Mesh& mesh : scene.meshes) {
    double of_mesh = 0;
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
      const auto at = [&](std::size_t c) { return static_cast<Vec3d>(mesh.positions[mesh.indices[i + c]]); };
      of_mesh += length(cross(at(1) - at(0), at(2) - at(0))) / 2;
    }
    area += of_mesh;
    if (mesh.is_emitter()) emitting += of_mesh;
  }
  if (power < default_light(scene).power / 30 && emitting > area / 2) return true;
  return median_irradiance(scene, camera) < std::numbers::pi / 1000;
}

void add_lights(Scene& scene, const std::vector<AddedLight>& lights) {
  for (const AddedLight light : lights) switch (light) {
      case AddedLight::none: break;
      case AddedLight::standard:
        scene.area_lights.push_back(default_light(scene));
        scene.punctual_lights.push_back(default_fill());
        break;
      case AddedLight::sun: scene.punctual_lights.push_back(directional_light("sun", -normalized(kTowardsKey), std::numbers::pi)); break;
      case AddedLight::studio:
        scene.area_lights.push_back(square_light(scene, "key", {-0.8, 0.7, 0.8}, std::numbers::pi));
        scene.area_lights.push_back(square_light(scene, "fill", {1, 0.3, 0.7}, std::numbers::pi / 4));
        scene.area_lights.push_back(square_light(scene, "rim", {0.4, 0.8, -1}, std::numbers::pi / 2));
        break;
    }
}

}  // namespace steradian::scene
