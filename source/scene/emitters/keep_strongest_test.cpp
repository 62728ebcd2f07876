#include "scene/emitters/keep_strongest.h"

#include <gtest/gtest.h>

#include <cmath>

#include "scene/emitters/emitters.h"
#include "steradian/error.h"
#include "steradian/load_scene.h"
#include "support/gltf_test_file.h"
#include "support/meshes.h"
#include "support/rings.h"

namespace steradian::scene::keep_strongest_test {
namespace {

// A hollow ribbon of n faces, 2 wide. No two faces share a plane; the faces at the ends are the largest.
Mesh ribbon(int n, Vec3d at) {
  Mesh mesh;
  for (int i = 0; i <= n; ++i) {
    const double x = 2.0 * i / n, y = 0.3 * (x - 1) * (x - 1);
    for (const double z : {0.0, 0.3}) mesh.positions.push_back(static_cast<Vec3f>(at + Vec3d{x, y, z}));
  }
  for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(2 * n); i += 2)
    mesh.indices.insert(mesh.indices.end(), {i, i + 1, i + 2, i + 2, i + 1, i + 3});
  return mesh;
}

Scene emitting(std::vector<Mesh> meshes, double radiance) {
  Scene scene;
  SurfaceMaterial m;
  m.emissive = Vec3f{1, 1, 1} * static_cast<float>(radiance);
  scene.materials.push_back(m);
  scene.meshes = std::move(meshes);
  Budget budget;
  add_emitters(scene, budget, "a test");
  return scene;
}

double power(const Scene& scene) {
  double sum = 0;
  for (const AreaLight& light : scene.area_lights) sum += luminance(light.radiance) * prepare_polygon(flat_polygon(light)).area;
  return sum;
}

double irradiance(const Scene& scene, Vec3d position, Vec3d normal) {
  double sum = 0;
  for (const AreaLight& light : scene.area_lights)
    sum += luminance(light.radiance) * polygon_irradiance(prepare_polygon(flat_polygon(light)), position, normal);
  return sum;
}

KeptLights keep(Scene& scene, std::size_t most) {
  Budget budget;
  return keep_strongest(scene, most, budget, "a test");
}

TEST(KeepStrongest, KeepsAMeshesPowerAndNearlyItsLight) {
  const Scene all = emitting({ribbon(120, {0, 0, 0})}, 2);
  ASSERT_EQ(all.area_lights.size(), 120u);
  Scene scene = all;
  const KeptLights kept = keep(scene, 40);
  EXPECT_EQ(scene.area_lights.size(), 40u);
  EXPECT_EQ(kept.merged.count, 80u);
  EXPECT_EQ(kept.dropped, 0u);
  EXPECT_GT(kept.merged.share, 0.5);
  EXPECT_NEAR(power(scene), power(all), 1e-9 * power(all));
  // Power moves by one face, a sixtieth of a unit, equally to both sides, and turns by a fiftieth of a radian. At distances of 1 to 3 units
  // the error is the square of these.
  const Vec3d down{0, -1, 0};
  for (const Vec3d position : {Vec3d{1, 3, 0.1}, Vec3d{0.2, 1.3, 0.1}, Vec3d{1.7, 1.3, -0.2}})
    EXPECT_NEAR(irradiance(scene, position, down), irradiance(all, position, down), 0.002 * irradiance(all, position, down));
}

TEST(KeepStrongest, AMeshOfManyWeakLightsStandsBeforeAStrongerSingleOne) {
  // Each face of the ribbon is weaker than the square, but all together are stronger. The test keeps one face, with the ribbon's whole
  // power, and the square.
  Scene scene = emitting({ribbon(120, {0, 0, 0}), quad_mesh({0, 3, 0}, {0, 3, 0.3f}, {0.3f, 3, 0.3f}, {0.3f, 3, 0}, 0)}, 1);
  const double before = power(scene);
  const KeptLights kept = keep(scene, 2);
  EXPECT_EQ(kept.merged.count, 119u);
  EXPECT_NEAR(power(scene), before, 1e-9 * before);
  Scene one = emitting({ribbon(120, {0, 0, 0}), quad_mesh({0, 3, 0}, {0, 3, 0.3f}, {0.3f, 3, 0.3f}, {0.3f, 3, 0}, 0)}, 1);
  const KeptLights of_one = keep(one, 1);
  EXPECT_EQ(of_one.dropped, 1u);
  EXPECT_NEAR(of_one.dropped_share, 0.09 / before, 1e-6);
  EXPECT_NEAR(power(one), before - 0.09, 1e-6);
}

TEST(KeepStrongest, PowerGoesToFacesThatFaceAlike) {
  // A thin slab: the nearest light to a face is the one behind it.
  std::vector<Mesh> meshes = {ribbon(40, {0, 0, 0})};
  Mesh back = ribbon(40, {0, -0.001, 0});
  for (std::size_t i = 0; i < back.indices.size(); i += 3) std::swap(back.indices[i], back.indices[i + 1]);
  const auto first = static_cast<std::uint32_t>(meshes[0].positions.size());
  for (const Vec3f& p : back.positions) meshes[0].positions.push_back(p);
  for (const std::uint32_t i : back.indices) meshes[0].indices.push_back(first + i);
  Scene scene = emitting(meshes, 1);
  ASSERT_EQ(scene.area_lights.size(), 80u);
  const auto up_and_down = [](const Scene& s) {
    double up = 0, down = 0;
    for (const AreaLight& light : s.area_lights) {
      const PreparedPolygon p = prepare_polygon(flat_polygon(light));
      (p.normal.y > 0 ? up : down) += luminance(light.radiance) * p.area;
    }
    return up / down;
  };
  EXPECT_NEAR(up_and_down(scene), 1, 1e-6);
  keep(scene, 20);
  EXPECT_NEAR(up_and_down(scene), 1, 1e-6);
}

TEST(KeepStrongest, RefusesMorePairsThanTheBudgetHas) {
  Scene scene = emitting({ribbon(120, {0, 0, 0})}, 1);
  Budget budget({.work = 1000});
  EXPECT_THROW(keep_strongest(scene, 60, budget, "a test"), Error);
}

TEST(KeepStrongest, GivesEveryMeshAPlaceWhereNobodySaysHowMany) {
  std::vector<Mesh> meshes;
  for (int i = 0; i < 300; ++i) meshes.push_back(ribbon(2, {3.0 * i, 0, 0}));
  Scene scene = emitting(meshes, 1);
  ASSERT_EQ(scene.area_lights.size(), 600u);
  Budget budget;
  const KeptLights kept = keep_strongest(scene, {}, budget, "a test");
  EXPECT_EQ(kept.most, 300u);
  EXPECT_EQ(kept.dropped, 0u);
  EXPECT_EQ(kept.merged.count, 300u);
  EXPECT_EQ(scene.area_lights.size(), 300u);
}

TEST(KeepStrongest, IsSaidOfAFile) {
  GltfTestFile f;
  std::vector<float> positions;
  const Mesh mesh = ribbon(120, {0, 0, 0});
  for (const Vec3f& p : mesh.positions) positions.insert(positions.end(), {p.x, p.y, p.z});
  f.add_mesh({{"POSITION", f.add_floats(positions, "VEC3")}},
             f.add_indices(std::vector<std::uint16_t>(mesh.indices.begin(), mesh.indices.end())));
  f.material()["emissiveFactor"] = {1, 1, 1};
  const LoadedScene loaded = steradian::load_scene(f.write(), {.max_lights = 60});
  ASSERT_FALSE(loaded.warnings.empty());
  EXPECT_NE(loaded.warnings[0].find("60 weak area lights of emissive meshes merged into the nearest"), std::string::npos)
      << loaded.warnings[0];
}

// The faces of closed meshes lose nothing in a picture, and are not called weak lights.
TEST(KeepStrongest, ClosedMeshesAreSaidToBeOneLightEach) {
  GltfTestFile f;
  const Mesh mesh = ring_mesh({0, 0, 0}, 0.5, 0.1, 0.4, 0, 24, 8);
  std::vector<float> positions;
  for (const Vec3f& p : mesh.positions) positions.insert(positions.end(), {p.x, p.y, p.z});
  f.add_mesh({{"POSITION", f.add_floats(positions, "VEC3")}},
             f.add_indices(std::vector<std::uint16_t>(mesh.indices.begin(), mesh.indices.end())));
  f.material()["emissiveFactor"] = {1, 1, 1};
  const LoadedScene loaded = steradian::load_scene(f.write(), {.max_lights = 10});
  std::string all;
  for (const std::string& warning : loaded.warnings) all += warning + "\n";
  EXPECT_NE(all.find("1 closed mesh of one radiance: one exact light each."), std::string::npos) << all;
  EXPECT_EQ(all.find("weak area light"), std::string::npos) << all;
}

}  // namespace
}  // namespace steradian::scene::keep_strongest_test
