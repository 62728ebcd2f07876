// shadow/frame/{objects,room,statue}: whole pictures at 1920 x 1080 with exact soft shadows of one quad light, on two threads. The pass
// `shadows` is their cost; /light=3 is the same under a light three times as wide and as deep.
//
//   objects   five balls and four tori on a floor: 46,656 triangles
//   room      a closed room with a table, a shelf and two boxes, of 15 boxes: large triangles, few edges
//   statue    one rough body of 82,012 triangles on a floor
#include <cmath>
#include <functional>
#include <memory>
#include <numbers>
#include <string>

#include "benches.h"
#include "frame.h"
#include "support/meshes.h"

namespace steradian::bench {
namespace {

// A grid of quadrilaterals over (u, v) in [0, 1]^2, at `at`.
Mesh grid(int columns, int rows, const std::function<Vec3f(double u, double v)>& at) {
  Mesh mesh;
  for (int j = 0; j <= rows; ++j)
    for (int i = 0; i <= columns; ++i) mesh.positions.push_back(at(static_cast<double>(i) / columns, static_cast<double>(j) / rows));
  const auto across = static_cast<std::uint32_t>(columns + 1);
  for (std::uint32_t j = 0; j < static_cast<std::uint32_t>(rows); ++j)
    for (std::uint32_t i = 0; i + 1 < across; ++i) {
      const std::uint32_t a = j * across + i, b = a + 1, c = a + across + 1, d = a + across;
      for (const std::uint32_t k : {a, b, c, a, c, d}) mesh.indices.push_back(k);
    }
  mesh.normals.assign(mesh.positions.size(), {});
  for (std::size_t t = 0; t < mesh.indices.size(); t += 3) {
    const Vec3f& p = mesh.positions[mesh.indices[t]];
    const Vec3f n = cross(mesh.positions[mesh.indices[t + 1]] - p, mesh.positions[mesh.indices[t + 2]] - p);
    for (std::size_t k = 0; k < 3; ++k) mesh.normals[mesh.indices[t + k]] += n;
  }
  for (Vec3f& n : mesh.normals) n = normalized(n);
  return mesh;
}

Vec3f shadow_at(Vec3d v) { return static_cast<Vec3f>(v); }

Mesh body(Vec3d center, int columns, int rows, const std::function<double(double turn, double rise)>& radius) {
  return grid(columns, rows, [=](double u, double v) {
    const double turn = 2 * std::numbers::pi * u, rise = std::numbers::pi * (v - 0.5), r = radius(turn, rise);
    return shadow_at(center + Vec3d{std::cos(rise) * std::sin(turn), std::sin(rise), std::cos(rise) * std::cos(turn)} * r);
  });
}

Mesh torus(Vec3d center, double large, double small) {
  return grid(72, 36, [=](double u, double v) {
    const double a = 2 * std::numbers::pi * u, b = 2 * std::numbers::pi * v, r = large + small * std::cos(b);
    return shadow_at(center + Vec3d{r * std::sin(a), small * std::sin(b), r * std::cos(a)});
  });
}

// side 1: the faces point outwards; -1: inwards.
Mesh box(Vec3d low, Vec3d high, double side) {
  Mesh mesh;
  for (int axis = 0; axis < 3; ++axis)
    for (const double end : {-1.0, 1.0}) {
      const auto first = static_cast<std::uint32_t>(mesh.positions.size());
      for (int corner = 0; corner < 4; ++corner) {
        const double s = corner == 1 || corner == 2 ? 1 : -1, t = corner >= 2 ? 1 : -1;
        const double turned = s * end * side;  // counter-clockwise from the visible side
        double c[3];
        c[axis] = end;
        c[(axis + 1) % 3] = turned;
        c[(axis + 2) % 3] = t;
        mesh.positions.push_back(shadow_at({c[0] < 0 ? low.x : high.x, c[1] < 0 ? low.y : high.y, c[2] < 0 ? low.z : high.z}));
        double n[3] = {0, 0, 0};
        n[axis] = end * side;
        mesh.normals.push_back(shadow_at({n[0], n[1], n[2]}));
      }
      for (const std::uint32_t k : {0u, 1u, 2u, 0u, 2u, 3u}) mesh.indices.push_back(first + k);
    }
  return mesh;
}

Mesh floor() {
  return grid(1, 1, [](double u, double v) { return shadow_at({16 * u - 8, 0, 8 - 16 * v}); });
}

std::vector<Mesh> objects() {
  std::vector<Mesh> meshes = {floor()};
  for (int i = 0; i < 9; ++i) {
    const Vec3d place{0.9 * (i % 3 - 1), 0.3, 0.9 * (i / 3 - 1)};
    meshes.push_back(i % 2 == 0 ? body(place, 72, 36, [](double, double) { return 0.28; }) : torus(place, 0.24, 0.09));
  }
  return meshes;
}

std::vector<Mesh> room() {
  std::vector<Mesh> meshes = {box({-3, 0, -3}, {3, 2.5, 5}, -1), box({-0.7, 0.7, -0.4}, {0.7, 0.75, 0.4}, 1)};
  for (const double x : {-0.68, 0.62})
    for (const double z : {-0.38, 0.32}) meshes.push_back(box({x, 0, z}, {x + 0.06, 0.7, z + 0.06}, 1));
  for (int i = 0; i < 4; ++i) meshes.push_back(box({-2.9, 0.3 + 0.5 * i, -2}, {-2.5, 0.33 + 0.5 * i, 0}, 1));
  for (const double z : {-2.03, 0.0}) meshes.push_back(box({-2.9, 0, z}, {-2.5, 2.1, z + 0.03}, 1));
  meshes.push_back(box({0.3, 0.75, -0.1}, {0.5, 0.9, 0.15}, 1));
  meshes.push_back(box({1.5, 0, -1}, {2.0, 0.5, -0.5}, 1));
  return meshes;
}

std::vector<Mesh> statue() {
  return {floor(), body({0, 0.75, 0}, 203, 202, [](double turn, double rise) {
            return 0.55 + 0.12 * std::sin(3 * turn) * std::cos(4 * rise) + 0.05 * std::sin(11 * turn + 3 * rise) * std::cos(rise);
          })};
}

Bench frame(const std::string& name, const std::vector<Mesh>& meshes, double height, double half) {
  auto work = std::make_shared<BenchFrame>();
  work->scene.meshes = meshes;
  work->scene.materials.resize(1);
  work->scene.materials[0].base_color = {0.5f, 0.5f, 0.5f, 1};
  work->scene.materials[0].metallic = 0;
  work->scene.materials[0].specular = 0;
  work->scene.cameras = {scene::camera_at({0, 2, 4}, {0, -1.5, -4}, 0.7)};
  AreaLight light;
  light.shape =
      Polygon{{{0.5 - half, height, -half}, {0.5 + half, height, -half}, {0.5 + half, height, half}, {0.5 - half, height, half}}, {}};
  light.radiance = {8, 8, 8};
  work->scene.area_lights = {light};
  work->options.width = 1920;
  work->options.height = 1080;
  work->options.method = "exact";
  work->options.shadows = Shadows::on;
  work->options.threads = 2;
  return bench_of(name, work);
}

}  // namespace

void add_shadow(BenchList& list) {
  const auto add = [&](const std::string& scene, std::vector<Mesh> (*meshes)(), double height) {
    for (const double width : {1.0, 3.0}) {
      const std::string name = "shadow/frame/" + scene + (width > 1 ? "/light=3" : "");
      list.add(name, [=](const BenchOptions&) {
        Bench bench = frame(name, meshes(), height, 0.25 * width);
        bench.once = scene == "statue";
        return bench;
      });
    }
  };
  add("objects", objects, 2.4);
  add("room", room, 2.4);
  add("statue", statue, 2.4);
}

}  // namespace steradian::bench
