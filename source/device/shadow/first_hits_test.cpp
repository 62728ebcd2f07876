// Embree and rays in double are the reference for a device's first hits of shadow-map rays; the host's map is the reference for the map.
#include "device/shadow/scene_rays.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <gtest/gtest.h>
#include <limits>
#include <optional>

#include "core/random.h"
#include "paths.h"
#include "steradian/load_scene.h"
#include "support/mixed_corner.h"

namespace steradian::vulkan::first_hits_test {
namespace {

using indirect::FirstHit;
using indirect::make_shadow_map;
using indirect::MapRay;
using indirect::ShadowMap;
using reference::Random;

// Records a device's rays and its answers.
class Recorded final : public indirect::FirstHits {
 public:
  explicit Recorded(indirect::FirstHits& of) : of_(of) {}
  std::size_t most() const override { return of_.most(); }
  MapRay* rays(std::size_t count) override { return of_.rays(count); }
  void find(std::size_t count) override {
    const MapRay* rays = of_.rays(count);
    of_.find(count);
    asked.insert(asked.end(), rays, rays + count);
    for (std::size_t i = 0; i < count; ++i) hits.push_back(of_.hit(i));
  }
  FirstHit hit(std::size_t ray) const override { return of_.hit(ray); }

  std::vector<MapRay> asked;
  std::vector<FirstHit> hits;

 private:
  indirect::FirstHits& of_;
};

bool same(FirstHit a, FirstHit b) { return a.mesh == b.mesh && (a.triangle == b.triangle || a.mesh == FirstHit::kNothing); }

FirstHit by_embree(const RayScene& rays, const MapRay& ray) {
  alignas(64) RTCRayHit16 packet{};
  alignas(64) int valid[16] = {-1};
  packet.ray.org_x[0] = ray.origin.x, packet.ray.org_y[0] = ray.origin.y, packet.ray.org_z[0] = ray.origin.z;
  packet.ray.dir_x[0] = ray.direction.x, packet.ray.dir_y[0] = ray.direction.y, packet.ray.dir_z[0] = ray.direction.z;
  packet.ray.tnear[0] = ray.begin;
  packet.ray.tfar[0] = std::numeric_limits<float>::infinity();
  packet.ray.mask[0] = 2;  // shadow casters
  packet.hit.geomID[0] = packet.hit.instID[0][0] = RTC_INVALID_GEOMETRY_ID;
  rays.intersect(valid, packet);
  return packet.hit.geomID[0] == RTC_INVALID_GEOMETRY_ID ? FirstHit{} : FirstHit{packet.hit.geomID[0], packet.hit.primID[0]};
}

std::array<Vec3d, 3> corners_of(const Scene& scene, std::size_t mesh, std::size_t triangle) {
  const Mesh& m = scene.meshes[mesh];
  const auto corner = [&](std::size_t c) { return static_cast<Vec3d>(m.positions[m.indices[3 * triangle + c]]); };
  return {corner(0), corner(1), corner(2)};
}

// First hit among all triangles that cast, in double.
FirstHit by_all(const Scene& scene, Vec3d origin, Vec3d direction, double begin) {
  FirstHit first;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t m = 0; m < scene.meshes.size(); ++m) {
    if (scene.meshes[m].is_light_shape || !scene.meshes[m].casts_shadow) continue;
    for (std::size_t t = 0; t < scene.meshes[m].triangle_count(); ++t) {
      const auto [a, b, c] = corners_of(scene, m, t);
      const Vec3d across = cross(direction, c - a), q = cross(origin - a, b - a);
      const double determinant = dot(b - a, across);
      if (determinant == 0) continue;
      const double u = dot(origin - a, across) / determinant, v = dot(direction, q) / determinant, at = dot(c - a, q) / determinant;
      if (!(u >= 0 && v >= 0 && u + v <= 1 && at >= begin && at < least)) continue;
      least = at;
      first = {static_cast<std::uint32_t>(m), static_cast<std::uint32_t>(t)};
    }
  }
  return first;
}

// Largest coordinate of a scene's vertices and of the rays' origins, which may be far away.
double size_of(const Scene& scene, const std::vector<MapRay>& rays) {
  double size = 0;
  const auto add = [&](Vec3f p) {
    for (const float x : {p.x, p.y, p.z}) size = std::max(size, static_cast<double>(std::fabs(x)));
  };
  for (const Mesh& mesh : scene.meshes)
    for (const Vec3f& p : mesh.positions) add(p);
  for (const MapRay& ray : rays) add(ray.origin);
  return size;
}

Vec3d in_box(Random& random) { return {random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)}; }

// Returns true if a ray meets the device's hit when it is moved by a millionth of the scene at its beginning and end. Corners relative to
// a ray's beginning round by 6e-8 of their distance, and again when its slant moves them.
bool is_near_a_tie(const Scene& scene, const MapRay& ray, FirstHit by_device, double size) {
  Random random(13);
  const Vec3d origin = static_cast<Vec3d>(ray.origin), direction = static_cast<Vec3d>(ray.direction);
  for (int k = 0; k < 64; ++k) {
    const Vec3d from = origin + in_box(random) * (1e-6 * size), to = origin + direction * size + in_box(random) * (1e-6 * size);
    if (same(by_all(scene, from, normalized(to - from), static_cast<double>(ray.begin)), by_device)) return true;
  }
  return false;
}

float apart(Vec3f a, Vec3f b) { return length(a - b); }

class VulkanMap : public testing::Test {
 protected:
  void SetUp() override {
    if (list_devices().empty()) GTEST_SKIP() << "no Vulkan device here: install mesa-vulkan-drivers for a software one";
  }
};

// Distance of a position from its ray.
double off_ray(const MapRay& ray, Vec3f place) {
  return length(cross(static_cast<Vec3d>(place) - static_cast<Vec3d>(ray.origin), static_cast<Vec3d>(ray.direction)));
}

// Texels that see the same triangle have the same fields. Their positions are on that triangle. Here they are also next to the ray, up to
// roundings of the scene's size, even where Embree's weights leave more.
void expect_same(const std::string& name, const Scene& scene, int count) {
  const RayScene rays(scene);
  DeviceFirstHits device(SceneRays::of(std::make_shared<const Device>(DeviceOptions{}), scene));
  Recorded recorded(device);
  const ShadowMap map = make_shadow_map(scene, rays, count, &recorded), host = make_shadow_map(scene, rays, count);
  ASSERT_EQ(map.count, host.count);
  ASSERT_EQ(recorded.asked.size(), map.count);
  const double size = size_of(scene, recorded.asked);
  std::size_t asked = 0, others = 0, certain = 0, lit = 0, unlike_lit = 0;
  double position = 0, embree_position = 0, normal = 0, incoming = 0, surface = 0, flux = 0, area = 0;
  for (std::size_t i = 0; i < map.count; ++i) {
    const MapRay& ray = recorded.asked[i];
    ASSERT_EQ(map.column[i], host.column[i]);
    ASSERT_EQ(map.row[i], host.row[i]);
    if (!(dot(ray.direction, ray.direction) > 0)) continue;
    ++asked;
    ASSERT_NE(recorded.hits[i].mesh, FirstHit::kUnknown) << name << " ray " << i;
    const FirstHit embree = by_embree(rays, ray);
    if (!same(recorded.hits[i], embree)) {
      ++others;
      certain += !is_near_a_tie(scene, ray, recorded.hits[i], size);
      continue;
    }
    if (embree.mesh == FirstHit::kNothing) continue;
    const bool lights = host.flux.x[i] + host.flux.y[i] + host.flux.z[i] > 0;
    lit += lights;
    if (lights != (map.flux.x[i] + map.flux.y[i] + map.flux.z[i] > 0)) {
      ++unlike_lit;
      continue;
    }
    if (!lights) continue;
    position = std::max(position, off_ray(ray, map.position[i]) / size);
    embree_position = std::max(embree_position, off_ray(ray, host.position[i]) / size);
    normal = std::max(normal, static_cast<double>(apart(map.normal[i], host.normal[i])));
    incoming = std::max(incoming, static_cast<double>(apart(map.incoming[i], host.incoming[i])));
    surface = std::max(surface, static_cast<double>(std::max({apart(map.albedo[i], host.albedo[i]), apart(map.f0[i], host.f0[i]),
                                                              apart(map.f90[i], host.f90[i]), std::fabs(map.alpha[i] - host.alpha[i])})));
    flux = std::max(flux, static_cast<double>(apart(map.flux[i], host.flux[i]) / length(host.flux[i])));
    area = std::max(area, static_cast<double>(std::fabs(map.area[i] / host.area[i] - 1)));
  }
  std::printf("%-10s %zu rays, %zu lit texels; %zu meet another triangle, %zu of them not near a tie; %zu lit on one side alone\n",
              name.c_str(), asked, lit, others, certain, unlike_lit);
  std::printf("  %.2f us a ray; off the ray, of the scene's size: %.1e, Embree's %.1e\n",
              1e3 * device.take_time() / static_cast<double>(map.count), position, embree_position);
  std::printf("  largest difference: normal %.1e, albedo, F0, F90, alpha %.1e, flux %.1e, area %.1e\n", normal, surface, flux, area);
  EXPECT_GT(lit, map.count / 20) << name;
  EXPECT_EQ(certain, 0u) << name;
  EXPECT_LE(others, asked / 1000) << name;
  EXPECT_EQ(unlike_lit, 0u) << name;
  EXPECT_LE(position, 1e-6) << name;
  EXPECT_EQ(incoming, 0) << name;
  EXPECT_LE(flux, 1e-5) << name;
  for (const double field : {normal, surface, area}) EXPECT_LE(field, 1e-3) << name;
}

// A scene under a sun, a point, a spot as wide as one, and a light with an area.
Scene under_every_kind() {
  Scene scene = indirect::mixed_corner();
  PunctualLight light = scene.punctual_lights.front();
  light.kind = PunctualKind::point;
  light.position = {-1, 1, 1};
  light.intensity = {2, 3, 4};
  light.range = 4;
  scene.punctual_lights.push_back(light);
  light.kind = PunctualKind::spot;
  light.position = {1, 2, 1.5};
  light.cos_inner = 0.2;
  light.cos_outer = 0.1;
  scene.punctual_lights.push_back(light);
  light.kind = PunctualKind::directional;
  light.direction = normalized(Vec3d{-0.3, -1, -0.5});
  scene.punctual_lights.push_back(light);
  AreaLight area;
  area.radiance = {5, 5, 5};
  area.two_sided = true;
  area.shape = Polygon{{{-0.5, 1.5, 1}, {0.5, 1.5, 1}, {0.5, 1.7, 1.5}, {-0.5, 1.7, 1.5}}, {}};
  scene.area_lights.push_back(area);
  return scene;
}

}  // namespace

TEST_F(VulkanMap, MeetsWhatTheHostsRaysMeet) {
  for (const char* name : {"ring", "gallery", "hall", "tubes"})
    expect_same(name, load_scene(test::kSourceDir + "/scenes/" + name + ".glb").scene, 1 << 14);
  expect_same("every kind", under_every_kind(), 1 << 12);
}

// Directions remain unit vectors in a scene of another size. VulkanRays.FindTheSameInEveryUnit has ways that grow with the scene.
TEST_F(VulkanMap, MeetsTheSameInEveryUnit) {
  const auto device = std::make_shared<const Device>(DeviceOptions{});
  Scene scene = load_scene(test::kSourceDir + "/scenes/gallery.glb").scene;
  const std::vector<Mesh> meshes = scene.meshes;
  constexpr std::size_t kRays = 10000;
  std::vector<FirstHit> met;
  std::size_t met_any = 0;
  for (const int exponent : {0, -60, -40, 20, 60}) {
    const float unit = std::ldexp(1.0f, exponent);
    for (std::size_t m = 0; m < meshes.size(); ++m)
      for (std::size_t i = 0; i < meshes[m].positions.size(); ++i) scene.meshes[m].positions[i] = meshes[m].positions[i] * unit;
    DeviceFirstHits hits(SceneRays::of(device, scene));
    Random random(19);
    MapRay* rays = hits.rays(kRays);
    for (std::size_t i = 0; i < kRays; ++i) {
      const Vec3d from = in_box(random) * 3.0, direction = normalized(in_box(random));
      rays[i] = {static_cast<Vec3f>(from) * unit, 1e-3f * unit, static_cast<Vec3f>(direction)};
    }
    hits.find(kRays);
    std::size_t other = 0;
    for (std::size_t i = 0; i < kRays; ++i) {
      const FirstHit hit = hits.hit(i);
      if (exponent == 0) {
        met.push_back(hit);
        met_any += hit.mesh != FirstHit::kNothing;
      }
      other += !same(hit, met[i]);
    }
    std::printf("of 2^%d the size: %zu of %zu rays meet another triangle\n", exponent, other, kRays);
    EXPECT_EQ(other, 0u) << exponent;
  }
  EXPECT_GT(met_any, kRays / 4);
}

// The host finds hits for traversals that do not end: triangles are stacked so that all boxes are met, but no triangle.
TEST_F(VulkanMap, AsksTheHostWhereAWalkDoesNotEnd) {
  Scene scene = indirect::mixed_corner();
  Mesh stack = scene.meshes.front();
  stack.positions.clear();
  stack.normals.clear();
  stack.indices.clear();
  for (std::uint32_t i = 0; i < 50000; ++i) {
    const float z = 2.0f + 0.2f * static_cast<float>(i) / 50000.0f;
    for (const Vec3f v : {Vec3f{-3, 3, z}, Vec3f{3, -3, z}, Vec3f{3, -3, z + 1e-5f}}) {
      stack.indices.push_back(static_cast<std::uint32_t>(stack.positions.size()));
      stack.positions.push_back(v);
      stack.normals.push_back({0, 0, 1});
    }
  }
  scene.meshes.push_back(stack);
  const RayScene rays(scene);
  DeviceFirstHits device(SceneRays::of(std::make_shared<const Device>(DeviceOptions{}), scene));
  Recorded recorded(device);
  const ShadowMap map = make_shadow_map(scene, rays, 1 << 8, &recorded), host = make_shadow_map(scene, rays, 1 << 8);
  std::size_t unknown = 0, unlike = 0;
  for (std::size_t i = 0; i < map.count; ++i) {
    if (recorded.hits[i].mesh != FirstHit::kUnknown) continue;
    ++unknown;
    unlike += apart(map.position[i], host.position[i]) > 0 || apart(map.flux[i], host.flux[i]) > 0;
  }
  std::printf("%zu of %zu rays are the host's\n", unknown, map.count);
  EXPECT_GT(unknown, map.count / 8);
  EXPECT_EQ(unlike, 0u);
}

}  // namespace steradian::vulkan::first_hits_test
