// Light maps of broken and extreme scenes: an error or a warning that names the mesh, within the limits.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "bake/bake.h"
#include "core/random.h"
#include "steradian/error.h"
#include "support/boxes.h"

namespace steradian::broken_scenes_test {
namespace {

using namespace bake;
using scene::grey;
using scene::quad_mesh;

// A floor below a sun, and a sheet above it.
Scene scene_with_sheet() {
  Scene scene;
  scene.materials = {grey(0.5f)};
  scene.meshes = {quad_mesh({-1, -1, 1}, {1, -1, 1}, {1, -1, -1}, {-1, -1, -1}, 0),
                  quad_mesh({0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, 0)};
  scene.meshes[1].name = "sheet";
  PunctualLight sun;
  sun.kind = PunctualKind::directional;
  sun.direction = {0, -1, 0};
  scene.punctual_lights = {sun};
  scene.cameras = {Camera{}};
  return scene;
}

BakeOptions options_for(double texels) {
  BakeOptions options;
  options.texels = texels;
  options.light.shadows = Shadows::on;
  options.light.quality = Quality::draft;
  options.light.bounces = 0;
  return options;
}

std::string message_of(const Scene& scene, const BakeOptions& options, const Limits& limits = {}) {
  Budget budget(limits);
  try {
    bake_map(scene, options, "scene", budget);
  } catch (const Error& error) {
    std::printf("%s\n", error.what());
    return error.what();
  }
  return {};
}

void expect_refusal(const std::string& message, const std::string& words) {
  EXPECT_NE(message.find("\"sheet\""), std::string::npos) << message;
  EXPECT_NE(message.find(words), std::string::npos) << message;
}

}  // namespace

TEST(BakeBroken, IncompleteVerticesAreRefusedByName) {
  EXPECT_EQ(message_of(scene_with_sheet(), options_for(4)), "");
  Scene scene = scene_with_sheet();
  scene.meshes[1].normals.clear();
  expect_refusal(message_of(scene, options_for(4)), "0 normals for 4 positions");
  scene = scene_with_sheet();
  scene.meshes[1].texcoords[1] = {{0, 0}, {1, 0}};
  expect_refusal(message_of(scene, options_for(4)), "2 coordinates in TEXCOORD_1");
  scene = scene_with_sheet();
  scene.meshes[1].indices[4] = 4;
  expect_refusal(message_of(scene, options_for(4)), "vertex 4 of 4");
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  scene = scene_with_sheet();
  scene.meshes[1].texcoords[1] = {{0, 0}, {1, 0}, {kNan, 1}, {0, 1}};
  expect_refusal(message_of(scene, options_for(4)), "not finite, number 2");
  scene = scene_with_sheet();
  scene.meshes[1].positions[3].y = std::numeric_limits<float>::infinity();
  expect_refusal(message_of(scene, options_for(4)), "not finite, number 3");
}

// Coordinates of the second set may lie anywhere. A chart that is too long for a map is named.
TEST(BakeBroken, ChartsMayLieAnywhereAndAreNamedWhereTooLong) {
  Scene scene = scene_with_sheet();
  scene.meshes[1].texcoords[1] = {{-5, 3}, {7, 3}, {7, 9}, {-5, 9}};
  EXPECT_EQ(message_of(scene, options_for(4)), "");
  scene.meshes[1].texcoords[1] = {{0, 0}, {1e-30f, 0}, {1e-30f, 1e-30f}, {0, 1e-30f}};
  EXPECT_EQ(message_of(scene, options_for(4)), "");
  scene.meshes[1].texcoords[1] = {{0, 0}, {1e-6f, 0}, {1e-6f, 1}, {0, 1}};
  expect_refusal(message_of(scene, options_for(100)), "16384 a side");
}

TEST(BakeBroken, MeshesWithoutAreaAreNamed) {
  Scene scene = scene_with_sheet();
  scene.meshes[1].positions = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 0, 0}};
  Budget budget;
  const LightMap map = bake_map(scene, options_for(4), "scene", budget);
  ASSERT_EQ(map.warnings.size(), 1u);
  EXPECT_NE(map.warnings[0].find("\"sheet\" has no triangle with an area"), std::string::npos) << map.warnings[0];
}

// Few texels, many, and places at vertices: memory is refused before it is taken.
TEST(BakeBroken, DensitiesStayWithinTheLimits) {
  Scene scene = scene_with_sheet();
  EXPECT_EQ(message_of(scene, options_for(1e-3)), "");
  for (const double texels : {0.0, -1.0, 1e5, std::numeric_limits<double>::quiet_NaN()})
    EXPECT_NE(message_of(scene, options_for(texels)).find("out of range"), std::string::npos) << texels;
  EXPECT_NE(message_of(scene, options_for(1e4)).find("16384 a side"), std::string::npos);
  BakeOptions vertices = options_for(4000);
  vertices.target = BakeTarget::vertex;
  EXPECT_NE(message_of(scene, vertices).find("the samples of its charts"), std::string::npos);
  Limits limits;
  limits.memory = 1'000;
  EXPECT_NE(message_of(scene, options_for(4), limits).find("the charts of its triangles"), std::string::npos);
}

// Triangles that all cut through each other have more contacts than can be followed: a warning says so.
TEST(BakeBroken, ContactsStayWithinTheWork) {
  Scene scene = scene_with_sheet();
  Mesh soup = scene.meshes[1];
  soup.name = "soup";
  soup.positions.clear();
  soup.normals.clear();
  soup.indices.clear();
  reference::Random random(4);
  for (std::uint32_t t = 0; t < 100; ++t) {
    std::array<Vec3f, 3> p;
    for (Vec3f& v : p) v = static_cast<Vec3f>(Vec3d{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)});
    const Vec3f normal = normalized(cross(p[1] - p[0], p[2] - p[0]));
    for (std::uint32_t k = 0; k < 3; ++k) {
      soup.indices.push_back(3 * t + k);
      soup.positions.push_back(p[k]);
      soup.normals.push_back(normal);
    }
  }
  scene.meshes.push_back(soup);
  Limits limits;
  limits.work = 100'000;
  Budget few(limits), many;
  const LightMap some = bake_map(scene, options_for(2), "scene", few), all = bake_map(scene, options_for(2), "scene", many);
  ASSERT_EQ(some.warnings.size(), 1u);
  EXPECT_NE(some.warnings[0].find("\"soup\""), std::string::npos) << some.warnings[0];
  EXPECT_NE(some.warnings[0].find("--max-work"), std::string::npos) << some.warnings[0];
  EXPECT_TRUE(all.warnings.empty());
  EXPECT_GT(all.charts.size(), some.charts.size());
}

}  // namespace steradian::broken_scenes_test
