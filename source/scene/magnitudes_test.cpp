// Coordinates of every magnitude: an accepted scene renders to finite numbers, and to the same picture at every scale.
#include <gtest/gtest.h>

#include <cmath>
#include <iostream>
#include <optional>

#include "steradian/error.h"
#include "steradian/load_scene.h"
#include "steradian/render.h"
#include "support/gltf_test_file.h"

namespace steradian::scene::magnitudes_test {
namespace {

// A floor of 2 x 2 under a light of 1 x 1 at a height of 2, below a node that holds both. Tests move and scale any of the three.
struct Parts {
  double floor_scale = 1, light_scale = 1, scale = 1, vertex = -1;
  double light_size = 1, light_height = 2, floor_at = 0, at = 0;
  std::string light_type = "rect";
};

std::string file_of(const Parts& p) {
  GltfTestFile f;
  const int positions = f.add_floats({static_cast<float>(p.vertex), 0, -1, -1, 0, 1, 1, 0, 1, 1, 0, -1}, "VEC3");
  f.add_mesh({{"POSITION", positions}}, f.add_indices({0, 1, 2, 0, 2, 3}));
  f.node()["name"] = "Floor";
  f.node()["scale"] = {p.floor_scale, p.floor_scale, p.floor_scale};
  f.node()["translation"] = {p.floor_at, 0, 0};
  f.json["extensionsUsed"] = {"EXT_lights_area"};
  f.json["extensions"]["EXT_lights_area"]["lights"] = {
      {{"type", p.light_type}, {"intensity", 1}, {"size", p.light_size}, {"capsule", {{"length", p.light_size}}}}};
  f.append("nodes", {{"name", "Lamp"},
                     {"translation", {0, p.light_height, 0}},
                     {"rotation", {-std::sqrt(0.5), 0, 0, std::sqrt(0.5)}},
                     {"scale", {p.light_scale, p.light_scale, p.light_scale}},
                     {"extensions", {{"EXT_lights_area", {{"light", 0}}}}}});
  f.append("nodes", {{"name", "All"}, {"children", {0, 1}}, {"scale", {p.scale, p.scale, p.scale}}, {"translation", {p.at, 0, 0}}});
  f.json["scenes"] = {{{"nodes", {2}}}};
  return f.text();
}

// The picture; if the scene is refused, nothing and the reason.
std::optional<Picture> rendered(const Parts& parts, const std::string& method, std::string& refusal) {
  try {
    const LoadedScene loaded = load_scene_from_memory(file_of(parts), "scene.gltf");
    RenderOptions options;
    options.width = 16;
    options.height = 12;
    options.method = method;
    options.threads = 1;
    options.spp = 1;
    options.indirect.mode = method == "auto" ? IndirectMode::ltc : IndirectMode::off;
    options.indirect.virtual_lights = 64;
    return render(loaded.scene, options);
  } catch (const Error& e) {
    refusal = e.what();
    return {};
  }
}

double mean(const Picture& picture) {
  double sum = 0;
  for (const Vec3f& p : picture.pixels) sum += static_cast<double>(p.x) / static_cast<double>(picture.pixels.size());
  return sum;
}

constexpr double kMagnitudes[] = {1e-30, 1e-25, 1e-19, 1e-15, 1e-12, 1e-9, 1e-6, 1e-3, 1,    1e3,
                                  1e6,   1e9,   1e12,  9e14,  2e15,  1e18, 1e19, 1e25, 1e30, 3e38};

}  // namespace

TEST(Magnitudes, EveryAcceptedSceneRendersToFiniteNumbers) {
  const std::pair<const char*, void (*)(Parts&, double)> changes[] = {
      {"vertex", [](Parts& p, double m) { p.vertex = m; }},
      {"floor scale", [](Parts& p, double m) { p.floor_scale = m; }},
      {"light scale", [](Parts& p, double m) { p.light_scale = m; }},
      {"scale", [](Parts& p, double m) { p.scale = m; }},
      {"rectangle", [](Parts& p, double m) { p.light_size = m; }},
      {"disk", [](Parts& p, double m) { p.light_size = m, p.light_type = "disk"; }},
      {"sphere", [](Parts& p, double m) { p.light_size = m, p.light_type = "sphere"; }},
      {"tube", [](Parts& p, double m) { p.light_size = m, p.light_type = "capsule"; }},
      {"light at", [](Parts& p, double m) { p.light_height = m; }},
      {"floor at", [](Parts& p, double m) { p.floor_at = m; }},
      {"all at", [](Parts& p, double m) { p.at = m; }}};
  int accepted = 0, refused = 0;
  for (const auto& [name, change] : changes)
    for (const double m : kMagnitudes) {
      for (const char* method : {"auto", "ltc", "sampled"}) {
        Parts parts;
        change(parts, m);
        std::string refusal;
        const auto picture = rendered(parts, method, refusal);
        if (!picture) {
          ++refused;
          EXPECT_TRUE(m > 1e14 || m < 1e-11) << name << ' ' << m << ": " << refusal;
          continue;
        }
        ++accepted;
        EXPECT_LT(m, 1e16) << name;
        for (const Vec3f& p : picture->pixels)
          ASSERT_TRUE(is_finite(p) && p.x >= 0 && p.y >= 0 && p.z >= 0) << name << ' ' << m << ' ' << method << ": " << p.x;
      }
    }
  std::cout << "[ measured ] " << accepted << " rendered, " << refused << " refused\n";
}

// Light does not depend on the unit of length. Over 26 orders of magnitude the picture is the same, up to the rounding of coordinates.
TEST(Magnitudes, AreLeftOutOfThePicture) {
  std::string refusal;
  Parts parts;
  const auto base = rendered(parts, "ltc", refusal);
  ASSERT_TRUE(base) << refusal;
  ASSERT_GT(mean(*base), 1e-4);
  for (const double scale : {1e-12, 1e-9, 1e-5, 1e-2, 1e2, 1e5, 1e9, 1e12, 1e14}) {
    parts.scale = scale;
    const auto picture = rendered(parts, "ltc", refusal);
    ASSERT_TRUE(picture) << scale << ": " << refusal;
    EXPECT_NEAR(mean(*picture) / mean(*base), 1, 1e-4) << scale;
  }
}

TEST(Magnitudes, AreRefusedByTheNodesName) {
  const auto refusal_of = [](const Parts& parts) {
    std::string refusal;
    EXPECT_FALSE(rendered(parts, "ltc", refusal));
    return refusal;
  };
  EXPECT_EQ(refusal_of({.vertex = 3e38}),
            "scene.gltf: nodes[0] \"Floor\": vertex 0 lies 3e+38 from the origin; 1e+15 is the farthest that can be rendered "
            "(scale the scene down)");
  EXPECT_NE(refusal_of({.light_height = 1e30}).find("nodes[1] \"Lamp\": the light lies 1e+30 from the origin"), std::string::npos);
  EXPECT_NE(refusal_of({.scale = 1e-20}).find("the whole scene is"), std::string::npos);
}

}  // namespace steradian::scene::magnitudes_test
