// Scenes of any size and any place: their pictures depend on neither.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <span>
#include <vector>

#include "night.h"
#include "paths.h"
#include "scene/gltf/gltf_file.h"
#include "steradian/load_scene.h"
#include "steradian/render.h"
#include "support/gltf_test_file.h"

namespace steradian::scale_render_test {
namespace {

using nlohmann::json;
using namespace nlohmann::literals;
using scene::GltfTestFile;

// Triangles with flat normals.
struct Triangles {
  std::vector<float> positions, normals;
  std::vector<std::uint16_t> indices;

  void add_quad(Vec3f a, Vec3f along, Vec3f up) {
    const auto first = static_cast<std::uint16_t>(positions.size() / 3);
    const Vec3f n = normalized(cross(along, up));
    for (const Vec3f& p : {a, a + along, a + along + up, a + up}) {
      positions.insert(positions.end(), {p.x, p.y, p.z});
      normals.insert(normals.end(), {n.x, n.y, n.z});
    }
    for (const int i : {0, 1, 2, 0, 2, 3}) indices.push_back(static_cast<std::uint16_t>(first + i));
  }
  void add_box(Vec3f low, Vec3f high) {
    const Vec3f x{high.x - low.x, 0, 0}, y{0, high.y - low.y, 0}, z{0, 0, high.z - low.z};
    add_quad(low + z, x, y);
    add_quad(low, y, x);
    add_quad(low, z, y);
    add_quad(low + x, y, z);
    add_quad(low + y, z, x);
    add_quad(low, x, z);
  }
};

struct Placing {
  double scale = 1, offset = 0;
};

// A floor and a wall with boxes on it and a board above, below a node that scales and moves them with lamps and a camera.
std::string room(Placing at, bool punctual) {
  Triangles t;
  t.add_quad({-4, 0, 4}, {8, 0, 0}, {0, 0, -8});
  t.add_quad({-4, 0, -4}, {8, 0, 0}, {0, 3, 0});
  t.add_box({-1, 0, -1}, {0, 0.5f, 0});
  t.add_box({0.4f, 0, -0.5f}, {0.7f, 1.5f, 0.3f});
  t.add_box({-0.3f, 0.7f, 0.5f}, {0.7f, 1, 0.6f});
  GltfTestFile f;
  const int positions = f.add_floats(t.positions, "VEC3"), normals = f.add_floats(t.normals, "VEC3");
  f.add_mesh({{"POSITION", positions}, {"NORMAL", normals}}, f.add_indices(t.indices));
  f.append("materials",
           {{"pbrMetallicRoughness", {{"baseColorFactor", {0.8, 0.7, 0.6, 1}}, {"metallicFactor", 0.2}, {"roughnessFactor", 0.35}}}});
  f.primitive()["material"] = 0;
  f.json["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", 0.7}, {"znear", 0.1}}}}};
  f.append("nodes", {{"camera", 0}, {"translation", {0.5, 2.2, 6}}, {"rotation", {-0.12, 0, 0, std::sqrt(1 - 0.0144)}}});
  f.json["extensionsUsed"] = {"EXT_lights_area", "KHR_lights_punctual"};
  f.json["extensions"]["EXT_lights_area"]["lights"] = {{{"type", "rect"}, {"intensity", 3}, {"size", 1}},
                                                       {{"type", "sphere"}, {"intensity", 20}, {"size", 0.2}}};
  const double square = at.scale * at.scale;
  f.json["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "point"}, {"intensity", 3 * square}},
                                                           {{"type", "spot"},
                                                            {"intensity", 20 * square},
                                                            {"range", 20 * at.scale},
                                                            {"spot", {{"innerConeAngle", 0.3}, {"outerConeAngle", 0.6}}}},
                                                           {{"type", "directional"}, {"intensity", 0.3}}};
  const auto add_lamp = [&](const char* extension, int light, double x, double y, double z) {
    f.append("nodes", {{"translation", {x, y, z}},
                       {"rotation", {-std::sqrt(0.5), 0, 0, std::sqrt(0.5)}},
                       {"extensions", {{extension, {{"light", light}}}}}});
  };
  add_lamp("EXT_lights_area", 0, 0.3, 3, 0.4);
  add_lamp("EXT_lights_area", 1, -1, 2, 1.6);
  for (int light = 0; light < 3 && punctual; ++light) add_lamp("KHR_lights_punctual", light, 1.5 - light, 2 + light, 1);
  json children;
  for (std::size_t i = 0; i < f.json["nodes"].size(); ++i) children.push_back(i);
  const double s = at.scale, o = at.offset;
  f.append("nodes", {{"children", children}, {"scale", {s, s, s}}, {"translation", {o, 0.5 * o, -o}}});
  f.json["scenes"] = {{{"nodes", {children.size()}}}};
  return f.text();
}

Picture rendered(const std::string& file, const RenderOptions& chosen, const char* environment = "") {
  LoadOptions load;
  load.near_origin = true;
  load.environment = environment;
  RenderOptions options = chosen;
  options.width = 48;
  options.height = 32;
  options.shadows = Shadows::on;
  options.spp = 2;
  return render(load_scene_from_memory(file, "scene.gltf", load).scene, options);
}

float largest_of(const Picture& p) {
  float largest = 0;
  for (const Vec3f& c : p.pixels) largest = std::max({largest, c.x, c.y, c.z});
  return largest;
}

double relative_l2(const Picture& picture, const Picture& base) {
  double squares = 0, difference = 0;
  for (std::size_t i = 0; i < base.pixels.size(); ++i) {
    const auto b = static_cast<Vec3d>(base.pixels[i]), d = static_cast<Vec3d>(picture.pixels[i]) - b;
    squares += dot(b, b);
    difference += dot(d, d);
  }
  return std::sqrt(difference / squares);
}

}  // namespace

// The room is 8 wide. The pictures of 1e4 sizes away are as near as the rest, since nodes are in double.
TEST(ScaleRender, ChangesNoPicture) {
  const struct {
    const char *method, *environment;
    LightSum lights;
    bool punctual;
  } ways[] = {{"auto", "", LightSum::all, true},
              {"sampled", "", LightSum::all, true},
              {"ltc", "", LightSum::tree, true},
              {"auto", "sky", LightSum::all, false}};
  const std::vector<Placing> day = {{1e-6, 0}, {1e3, 0}, {1, 8e4}};
  const std::vector<Placing> night = {{1e-6, 0}, {1e-3, 0}, {1e3, 0}, {1e6, 0}, {1, 8e4}, {1e-3, 80}, {1e3, 8e7}};
  for (const auto& way : std::span(ways).first(test::by_day_or_night(2u, 4u))) {
    RenderOptions options;
    options.method = way.method;
    options.lights = way.lights;
    const Picture base = rendered(room({}, way.punctual), options, way.environment);
    const float largest = largest_of(base);
    ASSERT_GT(largest, 0.05f);
    for (const Placing at : test::by_day_or_night(day, night)) {
      const Picture there = rendered(room(at, way.punctual), options, way.environment);
      const double off = relative_l2(there, base);
      double worst = 0;
      for (std::size_t i = 0; i < base.pixels.size(); ++i) {
        const auto d = static_cast<Vec3d>(there.pixels[i]) - static_cast<Vec3d>(base.pixels[i]);
        worst = std::max({worst, std::fabs(d.x), std::fabs(d.y), std::fabs(d.z)});
      }
      std::cout << "[ measured ] " << way.method << ' ' << way.environment << ' ' << at.scale << " at " << at.offset << ": relative L2 "
                << off << ", largest " << worst / static_cast<double>(largest) << "\n";
      EXPECT_LT(off, 1e-4) << way.method << way.environment << at.scale << ' ' << at.offset;
      EXPECT_LT(worst, 1e-4 * static_cast<double>(largest)) << way.method << way.environment << at.scale << ' ' << at.offset;
    }
  }
}

// Scenes with textures, tubes, disks, measured lamps and skins: each below one more node.
TEST(ScaleRender, ChangesNoSceneOfTheRepository) {
  const std::vector<const char*> day = {"textured_floor", "tubes"};
  const std::vector<const char*> night = {"textured_floor", "tubes",      "gallery", "glossy_floor", "grille",
                                          "hall",           "lamp_shade", "morph",   "ring",         "room"};
  for (const char* name : test::by_day_or_night(day, night)) {
    const scene::GltfFile file = scene::read_gltf_file(test::kSourceDir + "/scenes/" + name + ".glb");
    const auto picture_of = [&](double scale, double offset) {
      scene::GltfFile placed = file;
      scene::Json& json = placed.json;
      scene::Json& roots = json["scenes"][json.value("scene", 0u)]["nodes"];
      json["nodes"].push_back({{"children", roots}, {"scale", {scale, scale, scale}}, {"translation", {offset, -offset, 0.5 * offset}}});
      roots = scene::Json::array({json["nodes"].size() - 1});
      if (json.contains("/extensions/KHR_lights_punctual/lights"_json_pointer))
        for (scene::Json& light : json["extensions"]["KHR_lights_punctual"]["lights"])
          if (light["type"] != "directional") light["intensity"] = light.value("intensity", 1.0) * scale * scale;
      LoadOptions load;
      load.near_origin = true;
      RenderOptions options;
      options.width = 40;
      options.height = 30;
      options.shadows = Shadows::on;
      return render(scene::load_scene(placed, load).scene, options);
    };
    const Picture base = picture_of(1, 0);
    for (const Placing at : {Placing{1e-3, 0}, {1e6, 0}, {1, 1e5}, {1e-6, 0.1}}) {
      const double off = relative_l2(picture_of(at.scale, at.offset), base);
      std::cout << "[ measured ] " << name << ' ' << at.scale << " at " << at.offset << ": relative L2 " << off << "\n";
      EXPECT_LT(off, 1e-4) << name << ' ' << at.scale << ' ' << at.offset;
    }
  }
}

// A power of two changes exponents alone, in the bounce too.
TEST(ScaleRender, OfAPowerOfTwoChangesNoBit) {
  RenderOptions options;
  options.indirect.mode = IndirectMode::ltc;
  options.indirect.virtual_lights = 1024;
  options.indirect.shadow_rays = 2;
  const Picture base = rendered(room({}, true), options);
  for (const double scale : {0x1p-20, 0x1p-10, 0x1p20}) {
    const Picture there = rendered(room({scale, 0}, true), options);
    for (std::size_t i = 0; i < base.pixels.size(); ++i) ASSERT_EQ(there.pixels[i], base.pixels[i]) << scale << ' ' << i;
  }
}

// A camera between a floor and a large plate 2 cm above it, under a lamp: no light arrives, even 10 km from the origin. That holds for a
// scene that a program fills, too, which has no nodes.
TEST(ScaleRender, ContactsAreBlackFarFromTheOrigin) {
  for (const char* type : {"rect", "sphere", "disk"})
    for (const bool near_origin : {true, false}) {
      Triangles t;
      t.add_quad({-1, 0, 1}, {2, 0, 0}, {0, 0, -2});
      t.add_box({-4, 0.02f, -4}, {4, 0.1f, 4});
      GltfTestFile f;
      const int positions = f.add_floats(t.positions, "VEC3"), normals = f.add_floats(t.normals, "VEC3");
      f.add_mesh({{"POSITION", positions}, {"NORMAL", normals}}, f.add_indices(t.indices));
      f.json["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", 0.7}, {"znear", 0.001}}}}};
      f.append("nodes", {{"camera", 0}, {"translation", {0, 0.01, 0.9}}, {"rotation", {-0.02, 0, 0, std::sqrt(1 - 0.0004)}}});
      f.json["extensionsUsed"] = {"EXT_lights_area"};
      f.json["extensions"]["EXT_lights_area"]["lights"] = {{{"type", type}, {"intensity", 100}, {"size", 0.5}}};
      f.append("nodes", {{"translation", {0, 2, 0}},
                         {"rotation", {-std::sqrt(0.5), 0, 0, std::sqrt(0.5)}},
                         {"extensions", {{"EXT_lights_area", {{"light", 0}}}}}});
      f.append("nodes", {{"children", {0, 1, 2}}, {"translation", {1e4, 0, -5e3}}});
      f.json["scenes"] = {{{"nodes", {3}}}};
      LoadOptions load;
      load.near_origin = near_origin;
      const LoadedScene loaded = load_scene_from_memory(f.text(), "scene.gltf", load);
      EXPECT_EQ(loaded.origin == Vec3d{}, !near_origin);
      for (const char* method : {"auto", "sampled"}) {
        RenderOptions options;
        options.width = 48;
        options.height = 32;
        options.spp = 2;
        options.method = method;
        options.shadows = Shadows::on;
        EXPECT_EQ(largest_of(render(loaded.scene, options)), 0) << type << method << near_origin;
        options.shadows = Shadows::off;
        EXPECT_GT(largest_of(render(loaded.scene, options)), 0.1f) << type << method << near_origin;
      }
    }
}

}  // namespace steradian::scale_render_test
