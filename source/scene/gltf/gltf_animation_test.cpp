// Animations: their values between keys, and files at a moment.
#include "scene/gltf/gltf_animation.h"

#include <gtest/gtest.h>

#include <cmath>

#include "steradian/error.h"
#include "steradian/load_scene.h"
#include "support/gltf_test_file.h"

namespace steradian::scene::gltf_animation_test {
namespace {

AnimationChannel channel(AnimationChannel::Between between, std::vector<double> times, std::vector<double> values, std::size_t width) {
  AnimationChannel c;
  c.between = between;
  c.times = std::move(times);
  c.values = std::move(values);
  c.width = width;
  return c;
}

TEST(Animation, HoldsItsEndsAndIsLinearBetween) {
  const auto c = channel(AnimationChannel::Between::linear, {1, 3, 4}, {0, 10, 4, 20, 6, 0}, 2);
  EXPECT_EQ(value_at(c, 0), (std::vector<double>{0, 10}));
  EXPECT_EQ(value_at(c, 1), (std::vector<double>{0, 10}));
  EXPECT_EQ(value_at(c, 2), (std::vector<double>{2, 15}));
  EXPECT_EQ(value_at(c, 3.5), (std::vector<double>{5, 10}));
  EXPECT_EQ(value_at(c, 9), (std::vector<double>{6, 0}));
  const auto step = channel(AnimationChannel::Between::step, {0, 1}, {5, 7}, 1);
  EXPECT_EQ(value_at(step, 0.999), (std::vector<double>{5}));
  EXPECT_EQ(value_at(step, 1), (std::vector<double>{7}));
}

// A cubic polynomial is its own spline: values and tangents of t^3 - 2 t at the keys reproduce it between them.
TEST(Animation, CubicSplinesReproduceCubics) {
  const auto f = [](double t) { return t * t * t - 2 * t; };
  const auto d = [](double t) { return 3 * t * t - 2; };
  std::vector<double> times = {0.5, 1.25, 3}, values;
  for (const double t : times) values.insert(values.end(), {d(t), f(t), d(t)});
  const auto c = channel(AnimationChannel::Between::cubic, times, values, 1);
  for (const double t : {0.5, 0.7, 1.25, 2.0, 2.9, 3.0}) EXPECT_NEAR(value_at(c, t)[0], f(t), 1e-13) << t;
}

TEST(Animation, RotationsTakeTheShorterArcAtEvenSpeed) {
  const double s = std::sin(0.5), k = std::cos(0.5);  // by 1 radian about z
  for (const double sign : {1.0, -1.0}) {
    auto c = channel(AnimationChannel::Between::linear, {0, 1}, {0, 0, 0, 1, 0, 0, sign * s, sign * k}, 4);
    c.rotation = true;
    const auto q = value_at(c, 0.25);
    EXPECT_NEAR(2 * std::atan2(q[2], q[3]), 0.25, 1e-14);
  }
  auto same = channel(AnimationChannel::Between::linear, {0, 1}, {0, 0, 0, 1, 0, 0, 0, 1}, 4);
  same.rotation = true;
  EXPECT_EQ(value_at(same, 0.5), (std::vector<double>{0, 0, 0, 1}));
}

GltfTestFile animated() {
  GltfTestFile f = GltfTestFile::square();
  f.material()["emissiveFactor"] = {1, 1, 1};
  f.json["extensionsUsed"] = {"KHR_animation_pointer", "EXT_lights_area"};
  f.json["extensions"]["EXT_lights_area"]["lights"] = {{{"type", "rect"}, {"intensity", 3}}};
  f.append("nodes", {{"extensions", {{"EXT_lights_area", {{"light", 0}}}}}});
  const int times = f.add_floats({0, 2}, "SCALAR");
  const auto sampler = [&](const std::vector<float>& values, const char* type) {
    return nlohmann::json{{"input", times}, {"output", f.add_floats(values, type)}};
  };
  const auto pointer = [](const char* text) {
    return nlohmann::json{{"path", "pointer"}, {"extensions", {{"KHR_animation_pointer", {{"pointer", text}}}}}};
  };
  nlohmann::json a;
  a["samplers"] = {sampler({0, 0, 0, 4, 0, 0}, "VEC3"), sampler({1, 9}, "SCALAR"), sampler({1, 1, 1, 0, 0, 1}, "VEC3")};
  a["channels"] = {{{"sampler", 0}, {"target", {{"node", 1}, {"path", "translation"}}}},
                   {{"sampler", 1}, {"target", pointer("/extensions/EXT_lights_area/lights/0/intensity")}},
                   {{"sampler", 2}, {"target", pointer("/materials/0/emissiveFactor")}}};
  f.append("animations", a);
  return f;
}

TEST(Animation, MovesNodesLightsAndMaterialsOfAFile) {
  const GltfFile file = read_gltf_file(animated().write("animated.gltf"));
  const auto animations = read_animations(file);
  ASSERT_EQ(animations.size(), 1u);
  EXPECT_EQ(animations[0].duration, 2);
  GltfFile moment = file;
  moment.json = json_at(file.json, animations[0], 0.5);
  const Scene s = load_scene_from_memory(glb_bytes(moment), file.path).scene;
  ASSERT_EQ(s.area_lights.size(), 2u);
  const auto& vertices = std::get<Polygon>(s.area_lights[0].shape).vertices;
  double x = 0;
  for (const Vec3d v : vertices) x += v.x / 4;
  EXPECT_EQ(x, 1);
  EXPECT_EQ(s.area_lights[0].radiance, (Vec3d{3, 3, 3}));
  EXPECT_EQ(s.area_lights[1].radiance, (Vec3d{0.75, 0.75, 1}));
}

// Expected values computed by hand. A joint rotated by 60 degrees about z holds the vertex (1, 0, 0) with three quarters of its weight,
// beside a joint at rest. The vertex moves to 1/4 (1, 0, 0) + 3/4 (cos 60, sin 60, 0). A target of weight 1/4 adds a quarter of its shift.
// A camera lies between two places and two fields of view. Lights of KHR_lights_punctual move by pointers, one of them into an array.
TEST(Animation, MovesSkinsWeightsCamerasAndLights) {
  GltfTestFile f;
  const int positions = f.add_floats({1, 0, 0, 2, 0, 0, 1, 1, 0}, "VEC3"), target = f.add_floats({0, 0, 4, 0, 0, 0, 0, 0, 0}, "VEC3");
  const int joints = f.add_accessor(std::vector<std::uint8_t>{0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0}, "VEC4", 5121, 4);
  const int weights = f.add_floats({0.25f, 0.75f, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}, "VEC4");
  f.add_mesh({{"POSITION", positions}, {"JOINTS_0", joints}, {"WEIGHTS_0", weights}});
  f.primitive()["targets"] = {{{"POSITION", target}}};
  f.json["meshes"][0]["weights"] = {0.0};
  f.node()["skin"] = 0;
  f.append("skins", {{"joints", {1, 2}}});
  f.append("nodes", nlohmann::json::object());
  f.append("nodes", nlohmann::json::object());
  f.append("cameras", {{"type", "perspective"}, {"perspective", {{"yfov", 0.5}}}});
  f.append("nodes", {{"camera", 0}});
  f.json["extensionsUsed"] = {"KHR_animation_pointer", "KHR_lights_punctual"};
  f.json["extensions"]["KHR_lights_punctual"]["lights"] = {
      {{"type", "spot"}, {"intensity", 4}, {"color", {1, 1, 1}}, {"spot", {{"outerConeAngle", 0.4}}}}};
  f.append("nodes", {{"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});

  const int times = f.add_floats({0, 2}, "SCALAR");
  nlohmann::json a;
  const auto animate = [&](const std::vector<float>& values, const char* type, const nlohmann::json& where) {
    a["channels"].push_back({{"sampler", a["samplers"].size()}, {"target", where}});
    a["samplers"].push_back({{"input", times}, {"output", f.add_floats(values, type)}});
  };
  const auto pointer = [](const char* text) {
    return nlohmann::json{{"path", "pointer"}, {"extensions", {{"KHR_animation_pointer", {{"pointer", text}}}}}};
  };
  a["samplers"] = a["channels"] = nlohmann::json::array();
  const auto s60 = static_cast<float>(std::sin(std::acos(-1.0) / 3)), c60 = 0.5f;  // half of the 120 degrees at the end
  animate({0, 0, 0, 1, 0, 0, s60, c60}, "VEC4", {{"node", 2}, {"path", "rotation"}});
  animate({0, 0.5f}, "SCALAR", {{"node", 0}, {"path", "weights"}});
  animate({0, 0, 5, 0, 2, 7}, "VEC3", {{"node", 3}, {"path", "translation"}});
  animate({0.5f, 0.9f}, "SCALAR", pointer("/cameras/0/perspective/yfov"));
  animate({4, 10}, "SCALAR", pointer("/extensions/KHR_lights_punctual/lights/0/intensity"));
  animate({1, 1, 1, 1, 0.5f, 0}, "VEC3", pointer("/extensions/KHR_lights_punctual/lights/0/color"));
  animate({0.4f, 0.8f}, "SCALAR", pointer("/extensions/KHR_lights_punctual/lights/0/spot/outerConeAngle"));
  f.append("animations", a);

  GltfFile file = read_gltf_file(f.write("moves.gltf"));
  const auto animations = read_animations(file);
  file.json = json_at(file.json, animations.at(0), 1);
  const Scene s = load_scene(file).scene;
  const Vec3d vertex = static_cast<Vec3d>(s.meshes.at(0).positions.at(0));
  EXPECT_NEAR(vertex.x, 0.25 + 0.75 * 0.5, 1e-6);
  EXPECT_NEAR(vertex.y, 0.75 * 0.8660254037844386, 1e-6);
  EXPECT_NEAR(vertex.z, 1, 1e-6) << "a quarter of 4; both joints leave z as it is";
  EXPECT_EQ(s.meshes[0].positions[1], (Vec3f{2, 0, 0})) << "held by the joint that stands";
  EXPECT_EQ(s.cameras.at(0).position, (Vec3d{0, 1, 6}));
  EXPECT_NEAR(s.cameras[0].yfov, 0.7, 1e-7);
  ASSERT_EQ(s.punctual_lights.size(), 1u);
  EXPECT_EQ(s.punctual_lights[0].intensity, (Vec3d{7, 7 * 0.75, 3.5}));
  EXPECT_NEAR(s.punctual_lights[0].cos_outer, std::cos(0.6), 1e-7);
}

TEST(Animation, RefusesWhatIsBroken) {
  using F = GltfTestFile;
  struct Case {
    const char* says;
    void (*change)(F&);
  };
  const Case cases[] = {
      {"sampler", [](F& f) { f.json["animations"][0]["channels"][0]["sampler"] = 7; }},
      {"is not known", [](F& f) { f.json["animations"][0]["samplers"][0]["interpolation"] = "BEZIER"; }},
      {"numbers a key, needs 3", [](F& f) { f.json["animations"][0]["channels"][0]["sampler"] = 1; }},
      {"names what the file does not have",
       [](F& f) { f.json["animations"][0]["channels"][1]["target"]["extensions"]["KHR_animation_pointer"]["pointer"] = "/a/b/c"; }},
      {"is no JSON pointer",
       [](F& f) { f.json["animations"][0]["channels"][1]["target"]["extensions"]["KHR_animation_pointer"]["pointer"] = "intensity"; }},
      {"neither a number nor",
       [](F& f) { f.json["animations"][0]["channels"][1]["target"]["extensions"]["KHR_animation_pointer"]["pointer"] = "/asset/version"; }},
      {"earlier than the one before",
       [](F& f) {
         f.json["animations"][0]["samplers"][0]["input"] = f.add_floats({1, 0}, "SCALAR");
       }},
      {"numbers for",
       [](F& f) {
         f.json["animations"][0]["samplers"][0]["input"] = f.add_floats({0, 1, 2, 3, 4}, "SCALAR");
       }},
      {"samplers", [](F& f) { f.json["animations"][0].erase("samplers"); }},
      {"without KHR_animation_pointer", [](F& f) { f.json["animations"][0]["channels"][1]["target"].erase("extensions"); }},
  };
  for (const Case& c : cases) {
    F f = animated();
    c.change(f);
    const GltfFile file = read_gltf_file(f.write("broken.gltf"));
    try {
      read_animations(file);
      ADD_FAILURE() << c.says;
    } catch (const Error& e) {
      EXPECT_NE(std::string(e.what()).find(c.says), std::string::npos) << e.what();
    }
  }
}

}  // namespace
}  // namespace steradian::scene::gltf_animation_test
