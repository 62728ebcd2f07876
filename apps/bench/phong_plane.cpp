#include "bench/phong_plane.h"

#include <cmath>
#include <numbers>

namespace steradian::moment {
namespace {

constexpr Vec3d kEye{0, 1.6, 6}, kTarget{0, 0.7, 0};
constexpr double kFieldOfView = 40 * std::numbers::pi / 180;
constexpr std::size_t kWidestPack = 16;

NamedLight upright(std::string name, std::vector<Vec3d> outline) {
  PolygonLight light;
  light.vertices = std::move(outline);
  const std::size_t edges = light.vertices.size();
  return {std::move(name), prepare_polygon(light), edges, light.vertices};
}

}  // namespace

std::vector<NamedLight> comparison_lights() {
  std::vector<NamedLight> lights;
  // Counter-clockwise as seen from the camera's side.
  lights.push_back(upright("quad", {{-1, 0.2, -1.5}, {1, 0.2, -1.5}, {1, 1.7, -1.5}, {-1, 1.7, -1.5}}));
  std::vector<Vec3d> star;
  for (int i = 0; i < 10; ++i) {
    const double angle = std::numbers::pi * (0.5 + i / 5.0), radius = i % 2 ? 0.4 : 1;
    star.push_back({radius * std::cos(angle), 1.1 + radius * std::sin(angle), -1.5});
  }
  lights.push_back(upright("star", star));
  lights.push_back(upright("triangle", {{-1.4, 0.1, -1.0}, {1.6, 0.4, -2.0}, {0.9, 1.9, -1.8}}));
  return lights;
}

PhongPlane make_phong_plane(int width, int height) {
  PhongPlane plane;
  plane.width = width;
  plane.height = height;
  const Vec3d forward = normalized(kTarget - kEye), right = normalized(cross(forward, Vec3d{0, 1, 0})), up = cross(right, forward);
  const double scale = 2 * std::tan(kFieldOfView / 2) / height;
  for (int j = 0; j < height; ++j)
    for (int i = 0; i < width; ++i) {
      const Vec3d ray = forward + right * (scale * (i + 0.5 - width / 2.0)) - up * (scale * (j + 0.5 - height / 2.0));
      if (ray.y > -1e-3) continue;
      const Vec3f p(kEye + ray * (-kEye.y / ray.y));
      const Vec3f v(normalized(-ray));
      plane.pixels.push_back(j * width + i);
      plane.x.push_back(p.x);
      plane.y.push_back(0.0f);
      plane.z.push_back(p.z);
      plane.nx.push_back(0.0f);
      plane.ny.push_back(1.0f);
      plane.nz.push_back(0.0f);
      plane.vx.push_back(v.x);
      plane.vy.push_back(v.y);
      plane.vz.push_back(v.z);
    }
  plane.count = plane.x.size();
  for (auto* array : {&plane.x, &plane.y, &plane.z, &plane.nx, &plane.ny, &plane.nz, &plane.vx, &plane.vy, &plane.vz})
    while (array->size() % kWidestPack != 0) array->push_back(array->back());
  return plane;
}

Points PhongPlane::points() const {
  return {x.size(), {x.data(), y.data(), z.data()}, {nx.data(), ny.data(), nz.data()}, {vx.data(), vy.data(), vz.data()}};
}

ShadingPoint PhongPlane::at(std::size_t i) const {
  return {Vec3d(Vec3f{x[i], y[i], z[i]}), Vec3d(Vec3f{nx[i], ny[i], nz[i]}), normalized(Vec3d(Vec3f{vx[i], vy[i], vz[i]}))};
}

}  // namespace steradian::moment
