// The project's own scenes: the files in scenes/ are exactly the output of their script, and they load without warnings.
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <algorithm>

#include "paths.h"
#include "steradian/load_scene.h"
#include "support/gltf_test_file.h"

namespace steradian::scene::scenes_test {
namespace {

std::string bytes_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

std::string scenes() { return test::kSourceDir + "/scenes"; }

class OwnScenes : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = test_path("scenes");
    const std::string command = "python3 '" + scenes() + "/make_scenes.py' '" + folder_ + "'";
    ASSERT_EQ(std::system(command.c_str()), 0) << command;
  }
  Scene made(const std::string& name) {
    const LoadedScene loaded = steradian::load_scene(folder_ + "/" + name + ".glb");
    for (const std::string& w : loaded.warnings) ADD_FAILURE() << name << ": " << w;
    return loaded.scene;
  }
  std::string folder_;
};

TEST_F(OwnScenes, AreWhatTheirScriptMakes) {
  for (const std::string name :
       {"gallery", "morph", "plane", "ring", "hall", "diffuse_floor", "glossy_floor", "textured_floor", "tubes", "lobes", "cornell"}) {
    const std::string checked_in = bytes_of(scenes() + "/" + name + ".glb");
    EXPECT_FALSE(checked_in.empty()) << name;
    EXPECT_LT(checked_in.size(), 1'000'000u) << name;
    EXPECT_TRUE(checked_in == bytes_of(folder_ + "/" + name + ".glb")) << name << ": run scenes/make_scenes.py scenes " << name;
  }
}

TEST_F(OwnScenes, HaveTheLightsAndSizesTheyAreMadeFor) {
  const Scene gallery = made("gallery");
  ASSERT_EQ(gallery.area_lights.size(), 4u);
  const auto is = [](auto shape) { return [](const AreaLight& light) { return std::holds_alternative<decltype(shape)>(light.shape); }; };
  EXPECT_EQ(std::ranges::count_if(gallery.area_lights, is(Polygon{})), 2);  // the panel and the star
  EXPECT_EQ(std::ranges::count_if(gallery.area_lights, is(Ellipse{})), 1);
  EXPECT_EQ(std::ranges::count_if(gallery.area_lights, is(Ellipsoid{})), 1);
  const AreaLight& star = gallery.area_lights[3];
  EXPECT_EQ(star.name, "star");
  EXPECT_EQ(std::get<Polygon>(star.shape).vertices.size(), 10u) << "ten triangles are merged into one polygon";

  const Scene lobes = made("lobes");
  ASSERT_EQ(lobes.area_lights.size(), 3u);
  EXPECT_EQ(std::ranges::count_if(lobes.area_lights, is(Ellipsoid{})), 2);
  const auto has = [&](Brdf brdf) {
    return std::ranges::count_if(
        lobes.materials, [&](const SurfaceMaterial& m) { return !m.specular_override.empty() && m.specular_override[0].brdf == brdf; });
  };
  EXPECT_EQ(has(Brdf::phong), 2);
  EXPECT_EQ(has(Brdf::beckmann), 1);
  EXPECT_EQ(has(Brdf::ggx), 1);

  const Scene plane = made("plane");
  ASSERT_EQ(plane.area_lights.size(), 1u);
  const PreparedPolygon quad = prepare_polygon(flat_polygon(plane.area_lights[0]));
  EXPECT_NEAR(quad.area, 3, 1e-6);
  EXPECT_NEAR(quad.normal.z, 1, 1e-9);
  EXPECT_NEAR(plane.cameras[0].position.z, 6, 1e-12);

  const Scene tubes = made("tubes");
  ASSERT_EQ(tubes.area_lights.size(), 3u);
  for (const AreaLight& light : tubes.area_lights) EXPECT_TRUE(std::holds_alternative<Capsule>(light.shape));
  const auto& second = std::get<Capsule>(tubes.area_lights[1].shape);
  EXPECT_NEAR((second.end_b - second.end_a).y, 0.9, 2e-6) << "the second stands";

  EXPECT_EQ(made("ring").punctual_lights.size(), 1u);
  EXPECT_GE(made("arcade").triangle_count(), 200'000u);
  EXPECT_EQ(made("atrium").triangle_count(), 253'524u);
}

TEST_F(OwnScenes, HaveTrianglesThatFaceWhereTheirNormalsPoint) {
  for (const char* name : {"gallery", "plane", "tubes", "ring", "hall", "arcade", "atrium"})
    for (const Mesh& mesh : made(name).meshes) {
      std::size_t against = 0;
      for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
        const Vec3d a = static_cast<Vec3d>(mesh.positions[mesh.indices[i]]);
        const Vec3d face =
            cross(static_cast<Vec3d>(mesh.positions[mesh.indices[i + 1]]) - a, static_cast<Vec3d>(mesh.positions[mesh.indices[i + 2]]) - a);
        const Vec3f n = mesh.normals[mesh.indices[i]] + mesh.normals[mesh.indices[i + 1]] + mesh.normals[mesh.indices[i + 2]];
        against += dot(face, static_cast<Vec3d>(n)) < 0;
      }
      EXPECT_EQ(against, 0u) << name << ", " << mesh.name << ": of " << mesh.triangle_count();
    }
}

}  // namespace
}  // namespace steradian::scene::scenes_test
