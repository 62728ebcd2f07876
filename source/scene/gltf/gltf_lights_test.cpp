// EXT_lights_area as its draft defines it, and the extras of this project (docs/lights.md).
#include <cmath>
#include <numbers>

#include "steradian/error.h"
#include "steradian/load_scene.h"
#include "support/gltf_test_file.h"
#include "support/meshes.h"

namespace steradian::scene::gltf_lights_test {
namespace {

using nlohmann::json;

LoadedScene load(const GltfTestFile& file) { return steradian::load_scene(file.write()); }

void expect_near(Vec3d a, Vec3d b, double tolerance) {
  EXPECT_LE(length(a - b), tolerance) << a.x << " " << a.y << " " << a.z << ", expected " << b.x << " " << b.y << " " << b.z;
}
void expect_near(Vec3f a, Vec3d b, double tolerance = 1e-6) { expect_near(static_cast<Vec3d>(a), b, tolerance); }

GltfTestFile with_area_light(const json& light, const json& node) {
  GltfTestFile f = GltfTestFile::square();
  f.json["extensions"]["EXT_lights_area"]["lights"] = json::array({light});
  json n = node;
  n["extensions"]["EXT_lights_area"]["light"] = 0;
  f.append("nodes", n);
  return f;
}

TEST(AreaLightsOfFiles, ReadsRectLightsThatShineAlongMinusZ) {
  for (const double mirror : {1.0, -1.0}) {
    const LoadedScene loaded =
        load(with_area_light({{"type", "rect"}, {"size", 2}, {"rect", {{"aspect", 1.5}}}, {"color", {1, 0.5, 0}}, {"intensity", 10}},
                             {{"translation", {0, 0, 9}}, {"scale", {mirror, 1, 1}}}));
    ASSERT_EQ(loaded.scene.area_lights.size(), 1u);
    const AreaLight& light = loaded.scene.area_lights[0];
    const PreparedPolygon p = prepare_polygon(flat_polygon(light));
    EXPECT_NEAR(p.area, 6, 1e-12);
    expect_near(p.normal, {0, 0, -1}, 1e-12);
    expect_near(p.centroid, {0, 0, 9}, 1e-12);
    expect_near(light.radiance, {10, 5, 0}, 1e-12);
    EXPECT_NEAR(light.power, 6 * (0.2126 * 10 + 0.7152 * 5), 1e-12);
    // The camera sees the light as a separate mesh that faces the same way.
    ASSERT_EQ(loaded.scene.meshes.size(), 2u);
    const Mesh& mesh = loaded.scene.meshes[1];
    EXPECT_TRUE(mesh.is_light_shape && mesh.is_emitter());
    EXPECT_EQ(mesh.triangle_lights, (std::vector<std::int32_t>{0, 0}));
    EXPECT_NEAR(signed_area(mesh), 6, 1e-5);
    expect_near(mesh.normals[0], {0, 0, -1});
  }
}

// A light flush with a ceiling is visible without noise: for every ray of a camera below, its face lies in front of the ceiling.
TEST(AreaLightsOfFiles, LightsThatLieOnASurfaceAreSeen) {
  for (const char* type : {"rect", "disk"})
    for (const double height : {0.3, 2.7, 131.7}) {
      const LoadedScene loaded =
          load(with_area_light({{"type", type}, {"size", 1}, {"intensity", 3}},
                               {{"translation", {0.3, height, -0.7}}, {"rotation", {-std::sqrt(0.5), 0, 0, std::sqrt(0.5)}}}));
      const Mesh& mesh = loaded.scene.meshes[1];
      for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        EXPECT_LT(mesh.positions[i].y, static_cast<float>(height)) << type << height;
        EXPECT_GT(static_cast<double>(mesh.positions[i].y), height - 3e-5 * std::max(1.0, height)) << "by no more than roundings";
      }
    }
}

TEST(AreaLightsOfFiles, ReadsSpheresUnderUnevenScale) {
  for (const json& ball :
       {json{{"type", "sphere"}, {"size", 2}}, json{{"type", "disk"}, {"size", 2}, {"extras", {{"steradian", {{"type", "sphere"}}}}}}}) {
    const LoadedScene sphere = load(with_area_light(ball, {{"scale", {3, 1, 1}}, {"translation", {0, 5, 0}}}));
    const auto& ellipsoid = std::get<Ellipsoid>(sphere.scene.area_lights[0].shape);
    expect_near(ellipsoid.center, {0, 5, 0}, 0);
    expect_near(ellipsoid.x, {3, 0, 0}, 1e-15);
    expect_near(ellipsoid.z, {0, 0, 1}, 1e-15);
    EXPECT_GT(signed_area(sphere.scene.meshes[1]), 0) << "faces outwards";
  }
}

TEST(AreaLightsOfFiles, ReadsCapsulesAlongX) {
  const LoadedScene loaded =
      load(with_area_light({{"type", "capsule"}, {"size", 0.2}, {"capsule", {{"length", 3}}}, {"intensity", 2}},
                           {{"scale", {2, 4, 1}}, {"rotation", {0, 0, std::sqrt(0.5), std::sqrt(0.5)}}, {"translation", {0, 5, 0}}}));
  ASSERT_EQ(loaded.scene.area_lights.size(), 1u);
  const AreaLight& light = loaded.scene.area_lights[0];
  const auto& capsule = std::get<Capsule>(light.shape);
  expect_near(capsule.end_a, {0, 2, 0}, 1e-12);
  expect_near(capsule.end_b, {0, 8, 0}, 1e-12);
  EXPECT_NEAR(capsule.radius, 0.2, 1e-12) << "0.1 times the geometric mean of 4 and 1";
  const double area = 2 * std::numbers::pi * 0.2 * 6 + 4 * std::numbers::pi * 0.04;
  EXPECT_NEAR(light.power, 2 * area, 1e-12);
  // Every triangle faces outwards. An inscribed mesh of 64 x 33 quadrilaterals loses at most (pi / 64)^2 * 2/3 of the area.
  EXPECT_NEAR(signed_area(loaded.scene.meshes[1]) / area, 1, 0.002);
  EXPECT_LT(signed_area(loaded.scene.meshes[1]), area);

  const LoadedScene line = load(with_area_light({{"type", "capsule"}, {"size", 0}}, json::object()));
  for (const AreaLight& l : line.scene.area_lights) EXPECT_FALSE(std::holds_alternative<Capsule>(l.shape)) << "a line has no area";
  const LoadedScene ball = load(with_area_light({{"type", "capsule"}, {"size", 2}, {"capsule", {{"length", 0}}}}, json::object()));
  ASSERT_EQ(ball.scene.area_lights.size(), 1u);
  EXPECT_NEAR(ball.scene.area_lights[0].power, 1000 * 4 * std::numbers::pi, 1e-9) << "of 1000 nits, where nothing is said";
}

AreaLight light_of(const json& light, const json& node) {
  const LoadedScene loaded = load(with_area_light(light, node));
  EXPECT_EQ(loaded.scene.area_lights.size(), 1u);
  return loaded.scene.area_lights.at(0);
}

TEST(AreaLightsOfFiles, ShineByTheDraftsDefaults) {
  const AreaLight rect = light_of({{"type", "rect"}}, json::object());
  expect_near(rect.radiance, {1000, 1000, 1000}, 0);
  EXPECT_NEAR(prepare_polygon(flat_polygon(rect)).area, 1, 1e-12);
  EXPECT_FALSE(rect.two_sided);
  const AreaLight disk = light_of({{"type", "disk"}, {"intensity", 0.5}}, json::object());
  expect_near(disk.radiance, {0.5, 0.5, 0.5}, 0);
  EXPECT_NEAR(length(std::get<Ellipse>(disk.shape).x), 0.5, 1e-15) << "size is the diameter";
  // KHR_lights_punctual defines the default 1 for points and spots.
  GltfTestFile f = GltfTestFile::square();
  f.json["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "point"}}};
  f.append("nodes", {{"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
  expect_near(load(f).scene.punctual_lights.at(0).intensity, {1, 1, 1}, 0);
}

// The size is multiplied by the largest of the node's scales, whatever their signs. The aspect stays.
TEST(AreaLightsOfFiles, AreScaledByTheLargestOfTheNodesScales) {
  for (const json& scale : {json{3, 1, 1}, json{1, -3, 2}, json{0.5, 0.25, 3}, json{-3, -3, -3}}) {
    const json node = {{"scale", scale}, {"translation", {0, 0, 9}}};
    const PreparedPolygon rect =
        prepare_polygon(flat_polygon(light_of({{"type", "rect"}, {"size", 2}, {"rect", {{"aspect", 1.5}}}}, node)));
    EXPECT_NEAR(rect.area, 9 * 6, 1e-9) << scale;
    expect_near(rect.centroid, {0, 0, 9}, 1e-12);
    for (const Vec3d& v : rect.vertices) {
      EXPECT_NEAR(std::fabs(v.x), 4.5, 1e-12) << scale;
      EXPECT_NEAR(std::fabs(v.y), 3, 1e-12) << scale;
    }
    const auto disk = std::get<Ellipse>(light_of({{"type", "disk"}, {"size", 2}}, node).shape);
    EXPECT_NEAR(length(disk.x), 3, 1e-12) << scale;
    EXPECT_NEAR(length(disk.y), 3, 1e-12) << scale;
    EXPECT_NEAR(dot(disk.x, disk.y), 0, 1e-12);
  }
  // Under a parent, the scales in the world count.
  GltfTestFile f = with_area_light({{"type", "disk"}, {"size", 1}}, {{"scale", {1, 2, 1}}});
  f.append("nodes", {{"children", {1}}, {"scale", {5, 5, 5}}});
  f.json["scenes"] = {{{"nodes", {0, 2}}}};
  EXPECT_NEAR(length(std::get<Ellipse>(load(f).scene.area_lights.at(0).shape).x), 5, 1e-12);
}

TEST(AreaLightsOfFiles, TakeAllOfTheTransformByAnExtra) {
  const json axes = {{"steradian", {{"scale", "axes"}}}};
  const AreaLight disk = light_of({{"type", "disk"}, {"size", 2}, {"extras", axes}}, {{"scale", {3, 1, 1}}});
  EXPECT_NEAR(prepare_polygon(flat_polygon(disk)).area, 3 * std::numbers::pi, 1e-12) << "the polygon in its place";
  expect_near(prepare_polygon(flat_polygon(disk)).normal, {0, 0, -1}, 1e-12);
  const AreaLight rect = light_of({{"type", "rect"}, {"extras", axes}}, {{"scale", {3, 0.5, 7}}});
  EXPECT_NEAR(prepare_polygon(flat_polygon(rect)).area, 1.5, 1e-12);
  const auto wide =
      std::get<Ellipse>(light_of({{"type", "disk"}, {"size", 2}, {"extras", {{"steradian", {{"aspect", 4}}}}}}, json::object()).shape);
  EXPECT_NEAR(length(wide.x), 4, 1e-12);
  EXPECT_NEAR(length(wide.y), 1, 1e-12);
}

// The intensity is linear in the angle: 100 cd ahead, 60 at 90 degrees in the plane of the node's x, 20 in the plane of y.
constexpr const char* kLamp = "IES:LM-63-2019\nTILT=NONE\n1 -1 1 2 2 1 2 0 0 0\n1 1 10\n0 90\n0 90\n100 60\n100 20\n";

GltfTestFile with_profile(const json& light, const json& node) {
  GltfTestFile f = with_area_light(light, node);
  f.json["extensions"]["EXT_lights_ies"]["lights"] = {{{"uri", "data:application/x-ies-lm-63;base64," + base64(kLamp)}}};
  return f;
}

TEST(AreaLightsOfFiles, ShineByAProfileOfTheFile) {
  const json extra = {{"steradian", {{"profile", {{"light", 0}, {"multiplier", 3}}}}}};
  const double s = std::sqrt(0.5);
  const LoadedScene loaded = load(with_profile({{"type", "rect"}, {"size", 2}, {"color", {1, 0.5, 0}}, {"extras", extra}},
                                               {{"rotation", {0, 0, s, s}}, {"translation", {0, 0, 9}}}));  // x to y
  const AreaLight& light = loaded.scene.area_lights.at(0);
  ASSERT_TRUE(light.emission.has_value());
  EXPECT_FALSE(light.two_sided);
  EXPECT_NEAR(light.emission->area, 4, 1e-12);
  const auto candela = [&](Vec3d to) { return emitted_radiance(*light.emission, to) * (4 * std::fabs(to.z)); };
  expect_near(candela({0, 0, -1}), {300, 150, 0}, 1e-9);
  expect_near(candela({0, s, -s}), Vec3d{240, 120, 0}, 1e-9);
  expect_near(candela({0, -s, -s}), Vec3d{240, 120, 0}, 1e-9);
  expect_near(candela({s, 0, -s}), Vec3d{180, 90, 0}, 1e-9);
  expect_near(candela({0, 0, 1}), {0, 0, 0}, 0);
  EXPECT_NEAR(light.power, luminance(light.radiance) * 4, 1e-9);
}

TEST(AreaLightsOfFiles, MayLightWithoutBeingSeen) {
  const LoadedScene hidden = load(with_area_light({{"type", "disk"}, {"extras", {{"steradian", {{"seen", false}}}}}}, json::object()));
  EXPECT_EQ(hidden.scene.area_lights.size(), 1u);
  EXPECT_EQ(hidden.scene.meshes.size(), 1u) << "the square alone";
}

TEST(AreaLightsOfFiles, WrongExtrasAreRefused) {
  const auto refused = [](const json& light, const std::string& problem) {
    try {
      load(with_profile(light, json::object()));
      ADD_FAILURE() << "not refused: " << problem;
    } catch (const Error& e) {
      EXPECT_NE(std::string(e.what()).find(problem), std::string::npos) << e.what();
    }
  };
  const auto ours = [](const json& extra) { return json{{"steradian", extra}}; };
  refused({{"type", "disk"}, {"extras", ours({{"scale", "uneven"}})}}, "extras.steradian.scale: \"uneven\" is not known");
  refused({{"type", "disk"}, {"extras", ours({{"aspect", -1}})}}, "extras.steradian.aspect: is -1");
  refused({{"type", "disk"}, {"extras", ours({{"type", "cone"}})}}, "\"cone\" is not an area light");
  refused({{"type", "disk"}, {"extras", ours({{"profile", {{"light", 1}}}})}}, "profile.light: light 1 does not exist");
  refused({{"type", "disk"}, {"extras", ours({{"profile", 0}})}}, "extras.steradian.profile: must be an object");
  refused({{"type", "sphere"}, {"extras", ours({{"profile", {{"light", 0}}}})}}, "only rects and disks shine by a profile");
}

}  // namespace
}  // namespace steradian::scene::gltf_lights_test
