// Animations: their values between keys, and files at a moment.
#include "scene/gltf_animation.h"

#include <gtest/gtest.h>

#include <cmath>

#include "scene/gltf_test_file.h"
#include "steradian/error.h"
#include "steradian/load_scene.h"

namespace steradian::scene {
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

// A cubic of its own is its own spline: values and tangents of t^3 - 2 t at its keys give it back between them.
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
}  // namespace steradian::scene
