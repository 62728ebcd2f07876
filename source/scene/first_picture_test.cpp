// A new user's first picture: the camera, the units of lights, the environment that a file brings, and the order of error messages.
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

#include "image/codecs.h"
#include "steradian/error.h"
#include "steradian/load_scene.h"
#include "support/gltf_test_file.h"

namespace steradian::scene::first_picture_test {
namespace {

using nlohmann::json;

bool warns(const LoadedScene& loaded, const std::string& part) {
  return std::any_of(loaded.warnings.begin(), loaded.warnings.end(),
                     [&](const std::string& w) { return w.find(part) != std::string::npos; });
}

GltfTestFile with_punctual(const std::string& generator) {
  GltfTestFile f = GltfTestFile::square();
  f.json["asset"]["generator"] = generator;
  f.json["extensionsUsed"] = {"KHR_lights_punctual"};
  f.json["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "point"}, {"intensity", 683.0}}};
  f.append("nodes", {{"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
  return f;
}

double intensity(const LoadedScene& loaded) { return loaded.scene.punctual_lights.at(0).intensity.x; }

// A PNG of one colour with four channels: glTF environments read it as RGBD.
std::string png_of(int side, std::uint8_t value) {
  Picture picture(side, side);
  for (Vec3f& p : picture.pixels) p.x = p.y = p.z = srgb_decode(static_cast<float>(value) / 255.0f);
  return image::encode_png(picture, 0);
}

GltfTestFile with_environment() {
  GltfTestFile f = GltfTestFile::square();
  f.json["extensionsUsed"] = {"EXT_lights_image_based"};
  json faces = json::array();
  for (int i = 0; i < 6; ++i) {
    // The face +x is bright, the others dark.
    f.append("images", {{"uri", "data:image/png;base64," + base64(png_of(8, i == 0 ? 180 : 40))}});
    faces.push_back(i);
  }
  json rows = json::array();
  for (int i = 0; i < 9; ++i) rows.push_back({i == 0 ? 2.0 : 0.0, 0.0, 0.0});
  f.json["extensions"]["EXT_lights_image_based"]["lights"] = {{{"name", "studio"},
                                                               {"intensity", 3},
                                                               {"irradianceCoefficients", rows},
                                                               {"specularImageSize", 8},
                                                               {"specularImages", json::array({faces})}}};
  f.json["scenes"] = {{{"nodes", {0}}, {"extensions", {{"EXT_lights_image_based", {{"light", 0}}}}}}};
  return f;
}

}  // namespace

TEST(FirstPicture, TheDefaultCameraIsFilled) {
  for (const double aspect : {0.5, 1.0, 16.0 / 9, 3.0})
    for (const double height : {0.02, 1.0, 40.0}) {
      GltfTestFile f = GltfTestFile::square();
      f.node()["scale"] = {1, height, 1};
      const LoadedScene loaded = steradian::load_scene(f.write(), {.aspect = aspect});
      const Camera& c = loaded.scene.cameras.at(0);
      double across = 0, up = 0;
      for (const Vec3f& p : loaded.scene.meshes[0].positions) {
        const Vec3d d = static_cast<Vec3d>(p) - c.position;
        const double depth = -dot(d, c.z), half = std::tan(c.yfov / 2);
        ASSERT_GT(depth, 0);
        across = std::max(across, std::fabs(dot(d, c.x)) / (depth * half * aspect));
        up = std::max(up, std::fabs(dot(d, c.y)) / (depth * half));
      }
      EXPECT_LE(std::max(across, up), 1.0) << aspect << " " << height;
      EXPECT_GE(std::max(across, up), 0.94) << aspect << " " << height;
    }
}

TEST(FirstPicture, BlendersPunctualLightsAreBroughtToTheUnitOfEmission) {
  const std::string blender = "Khronos glTF Blender I/O v3.4.50";
  const LoadedScene own = steradian::load_scene(with_punctual(blender).write());
  EXPECT_EQ(intensity(own), 1);
  EXPECT_TRUE(warns(own, "683"));
  EXPECT_EQ(own.file.generator, blender);
  EXPECT_EQ(intensity(steradian::load_scene(with_punctual(blender).write(), {.light_units = LightUnits::candela})), 683);
  EXPECT_EQ(intensity(steradian::load_scene(with_punctual("Khronos glTF Blender I/O v1.2.75").write())), 683) << "before that factor came";
  const LoadedScene other = steradian::load_scene(with_punctual("by hand").write());
  EXPECT_EQ(intensity(other), 683);
  EXPECT_FALSE(warns(other, "683"));
  EXPECT_EQ(intensity(steradian::load_scene(with_punctual("by hand").write(), {.light_units = LightUnits::watt})), 1);
}

TEST(FirstPicture, AFileOfBlenderWithoutLampsSaysHowToExportThem) {
  const char* part = "\"Punctual Lights\"";
  GltfTestFile f = GltfTestFile::square();
  EXPECT_FALSE(warns(steradian::load_scene(f.write()), part));
  f.json["asset"]["generator"] = "Khronos glTF Blender I/O v4.2.60";
  EXPECT_TRUE(warns(steradian::load_scene(f.write()), part));
  f.material()["emissiveFactor"] = {1, 1, 1};
  EXPECT_FALSE(warns(steradian::load_scene(f.write()), part)) << "it shines";
  EXPECT_FALSE(warns(steradian::load_scene(with_punctual("Khronos glTF Blender I/O v4.2.60").write()), part));
}

TEST(FirstPicture, WhatAFileRequiresIsCheckedBeforeItsBuffers) {
  GltfTestFile f = GltfTestFile::square();
  f.json["buffers"] = {{{"byteLength", 40}, {"uri", "not_there.bin"}}};
  f.json["extensionsRequired"] = {"KHR_draco_mesh_compression"};
  try {
    steradian::load_scene(f.write());
    FAIL();
  } catch (const Error& e) {
    EXPECT_NE(std::string(e.what()).find("KHR_draco_mesh_compression"), std::string::npos) << e.what();
  }
}

TEST(FirstPicture, ReadsTheEnvironmentOfAFile) {
  const LoadedScene loaded = steradian::load_scene(with_environment().write());
  ASSERT_NE(loaded.scene.environment, nullptr);
  const Environment& e = *loaded.scene.environment;
  EXPECT_EQ(e.name, "studio");
  EXPECT_TRUE(loaded.scene.area_lights.empty()) << "no default light beside it";
  // encode_png applies a tone curve, so the test only checks that the faces keep their order.
  const float bright = radiance_from(e.map, {1, 0, 0}).x, dark = radiance_from(e.map, {-1, 0, 0}).x;
  EXPECT_GT(bright, 5 * dark);
  EXPECT_GT(dark, 0);
  ASSERT_TRUE(e.irradiance.has_value());
  EXPECT_NEAR(e.irradiance->at({0, 1, 0}).x, 3 * 2 * std::sqrt(1 / (4 * std::numbers::pi)), 1e-12);

  GltfTestFile turned = with_environment();  // by 90 degrees about y: +x goes to -z
  turned.json["extensions"]["EXT_lights_image_based"]["lights"][0]["rotation"] = {0, std::sqrt(0.5), 0, std::sqrt(0.5)};
  const LoadedScene other = steradian::load_scene(turned.write());
  EXPECT_NEAR(radiance_from(other.scene.environment->map, {0, 0, -1}).x, bright, 0.05f * bright);
}

TEST(FirstPicture, RefusesBrokenEnvironments) {
  const auto refused = [](auto change) {
    GltfTestFile f = with_environment();
    change(f.json["extensions"]["EXT_lights_image_based"]["lights"][0]);
    EXPECT_THROW(steradian::load_scene(f.write()), Error);
  };
  refused([](json& light) { light.erase("specularImages"); });
  refused([](json& light) { light["specularImages"] = json::array(); });
  refused([](json& light) { light["specularImages"][0].erase(5); });
  refused([](json& light) { light["specularImages"][0][2] = 17; });
  refused([](json& light) { light["irradianceCoefficients"].erase(0); });
  refused([](json& light) { light["irradianceCoefficients"][3][0] = "x"; });
  refused([](json& light) { light["intensity"] = -1; });
  refused([](json& light) { light["rotation"] = {0, 0, 0, 0}; });
}

}  // namespace steradian::scene::first_picture_test
