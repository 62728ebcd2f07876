// `steradian bake` as a process.
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "bake/encoding.h"
#include "image/codecs.h"
#include "program.h"
#include "scene/gltf/gltf_accessor.h"
#include "scene/gltf/gltf_file.h"
#include "steradian/picture.h"

namespace steradian::bake_program_test {
namespace {

const std::string kRoom = test::kSourceDir + "/scenes/room.glb";

// Every primitive with a map names its texture, and the texture shows what the .exr holds.
TEST_F(Program, BakesARoomThatShowsItsMap) {
  const std::string baked = folder / "baked.glb";
  const Outcome r =
      run({"bake", kRoom, "-o", baked, "--texels", "4", "--bounces", "1", "--quality", "draft", "--stats", folder / "s.json"});
  ASSERT_EQ(r.status, 0) << r.err;
  EXPECT_EQ(r.err.find("warning"), std::string::npos) << r.err;
  const Picture exr = read_picture(folder / "baked.exr");
  ASSERT_EQ(exr.layers.count("error"), 1u);

  const scene::GltfFile file = scene::read_gltf_file(baked);
  Budget budget;
  const scene::GltfDocument document = scene::document_of(file, budget);
  const auto& maps = file.json["extras"]["steradian"]["lightMap"];
  EXPECT_EQ(maps["exr"], "baked.exr");
  EXPECT_EQ(maps["encoding"], "RGBM");
  ASSERT_EQ(maps["maps"].size(), 1u);
  EXPECT_EQ(maps["maps"][0]["group"], "all");
  const auto& picture =
      file.json["images"][file.json["textures"][maps["maps"][0]["texture"].get<std::size_t>()]["source"].get<std::size_t>()];
  const Image png = image::decode_png(scene::view_bytes(document, picture["bufferView"]), "png", 1 << 24, budget);
  ASSERT_EQ(png.width, exr.width);
  ASSERT_EQ(png.height, exr.height);
  const float range = maps["maps"][0]["range"];
  double worst = 0;
  for (std::size_t i = 0; i < exr.pixels.size(); ++i) {
    const Vec3f d = bake::color_of_rgbm(png.rgba.data() + 4 * i, range) - exr.pixels[i];
    const float most = std::max({exr.pixels[i].x, exr.pixels[i].y, exr.pixels[i].z});
    // Half a step of 255 of each byte: the multiplier's last step is at most 1 / 255 of the range too large.
    worst = std::max(worst, static_cast<double>(std::max({std::fabs(d.x), std::fabs(d.y), std::fabs(d.z)}) / (most + range / 255)));
  }
  std::size_t shown = 0;
  for (const auto& mesh : file.json["meshes"])
    for (const auto& primitive : mesh["primitives"]) {
      if (!primitive.contains("extras")) continue;
      const std::string set = "TEXCOORD_" + std::to_string(primitive["extras"]["steradian"]["lightMap"]["texCoord"].get<int>());
      const auto uv = scene::read_floats(document, primitive["attributes"][set], "VEC2");
      const auto positions = scene::read_floats(document, primitive["attributes"]["POSITION"], "VEC3");
      EXPECT_EQ(uv.count, positions.count);
      for (const float x : uv.values) EXPECT_TRUE(x >= 0 && x <= 1);
      ++shown;
    }
  std::printf("%zu primitives with a map of %d x %d; RGBM is off by at most %.4f of a texel\n", shown, exr.width, exr.height, worst);
  EXPECT_GT(shown, 20u);
  EXPECT_LT(worst, 0.5 / 255 * 1.01);
  const auto stats = nlohmann::json::parse(contents(folder / "s.json"));
  EXPECT_EQ(stats["width"], exr.width);
  EXPECT_GT(stats["samples"], 1000);
}

TEST_F(Program, BakesAMapOfSixteenBits) {
  const std::string baked = folder / "baked.glb";
  const Outcome r = run({"bake", kRoom, "-o", baked, "--texels", "2", "--bounces", "0", "--encoding", "rgb16"});
  ASSERT_EQ(r.status, 0) << r.err;
  const scene::GltfFile file = scene::read_gltf_file(baked);
  Budget budget;
  const scene::GltfDocument document = scene::document_of(file, budget);
  const auto& map = file.json["extras"]["steradian"]["lightMap"];
  EXPECT_EQ(map["encoding"], "RGB16");
  const auto& texture = file.json["textures"][map["maps"][0]["texture"].get<std::size_t>()];
  const auto png = scene::view_bytes(document, file.json["images"][texture["source"].get<std::size_t>()]["bufferView"]);
  EXPECT_EQ(png[24], 16);  // bits a channel
}

// A picture of the preview shows the map: a plane floor of one colour has the light of its texels, up to white and the steps of 8 bits.
TEST_F(Program, APreviewShowsItsMap) {
  const std::string baked = folder / "baked.glb", preview = folder / "preview.glb", picture = folder / "preview.exr";
  const std::vector<std::string> bake = {"bake", test::kSourceDir + "/scenes/cornell.glb", "-o", baked, "--texels", "4", "--bounces", "1"};
  std::vector<std::string> with = bake;
  with.insert(with.end(), {"--preview", preview});
  ASSERT_EQ(run(with).status, 0);
  const auto json = scene::read_gltf_file(preview).json;
  std::size_t unlit = 0;
  for (const auto& material : json["materials"])
    unlit += material.contains("extensions") && material["extensions"].contains("KHR_materials_unlit");
  EXPECT_EQ(unlit, 3u);
  const Outcome r = run({"render", preview, "-o", picture, "--size", "64x64"});
  ASSERT_EQ(r.status, 0) << r.err;
  const Outcome lit =
      run({"render", test::kSourceDir + "/scenes/cornell.glb", "-o", folder / "lit.exr", "--size", "64x64", "--bounces", "1"});
  ASSERT_EQ(lit.status, 0) << lit.err;
  // Both pictures are alike up to one factor: white.
  const Picture shown = read_picture(picture), truth = read_picture(folder / "lit.exr");
  double both = 0, own = 0, squares = 0, light = 0;
  const auto is_lamp = [&](std::size_t i) { return truth.pixels[i].x > 3; };
  for (std::size_t i = 0; i < shown.pixels.size(); ++i)
    if (!is_lamp(i))
      both += static_cast<double>(dot(shown.pixels[i], truth.pixels[i])), own += static_cast<double>(dot(shown.pixels[i], shown.pixels[i]));
  for (std::size_t i = 0; i < shown.pixels.size(); ++i) {
    if (is_lamp(i)) continue;
    const Vec3f d = shown.pixels[i] * static_cast<float>(both / own) - truth.pixels[i];
    squares += static_cast<double>(dot(d, d));
    light += static_cast<double>(dot(truth.pixels[i], truth.pixels[i]));
  }
  std::printf("the preview is %.3f off, relative L2\n", std::sqrt(squares / light));
  // Texels of a quarter of a metre blur the borders of shadows; without the map nothing would agree.
  EXPECT_LT(std::sqrt(squares / light), 0.1);
  with.back() = folder / "preview.png";
  EXPECT_EQ(run(with).status, 2);
  with.back() = preview;
  with.insert(with.end(), {"--target", "vertex"});
  EXPECT_EQ(run(with).status, 2);
}

// The baked scene is the scene: its surfaces stay where they were, with their materials.
TEST_F(Program, ABakedSceneRendersAsBefore) {
  const std::string baked = folder / "baked.gltf", before = folder / "before.exr", after = folder / "after.exr";
  ASSERT_EQ(run({"bake", kRoom, "-o", baked, "--texels", "2", "--bounces", "0"}).status, 0);
  ASSERT_EQ(run({"render", kRoom, "-o", before, "--size", "160x90"}).status, 0);
  ASSERT_EQ(run({"render", baked, "-o", after, "--size", "160x90"}).status, 0);
  const Picture a = read_picture(before), b = read_picture(after);
  std::size_t other = 0;
  for (std::size_t i = 0; i < a.pixels.size(); ++i) {
    const Vec3f d = a.pixels[i] - b.pixels[i];
    other += std::max({std::fabs(d.x), std::fabs(d.y), std::fabs(d.z)}) > 1e-3f * (1 + a.pixels[i].x);
  }
  std::printf("%zu of %zu pixels differ by more than 0.1 %%\n", other, a.pixels.size());
  // Rays at the edges of cut triangles may meet the triangle beside.
  EXPECT_LE(other, a.pixels.size() / 1000);
}

// Parts of a map are the map, to the last bit.
TEST_F(Program, PartsOfABakedMapAddUp) {
  const std::string whole = folder / "whole.glb", merged = folder / "merged.glb";
  const std::vector<std::string> settings = {"--texels", "16", "--bounces", "1", "--quality", "draft"};
  const auto bake = [&](const std::string& out, std::vector<std::string> more) {
    std::vector<std::string> arguments = {"bake", kRoom, "-o", out};
    arguments.insert(arguments.end(), settings.begin(), settings.end());
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Outcome r = run(arguments);
    EXPECT_EQ(r.status, 0) << r.err;
  };
  bake(whole, {});
  bake(folder / "1.exr", {"--part", "1/2"});
  bake(folder / "2.exr", {"--part", "2/2"});
  const Outcome r = run({"merge", folder / "2.exr", folder / "1.exr", "-o", merged});
  ASSERT_EQ(r.status, 0) << r.err;
  const Picture a = read_picture(folder / "whole.exr"), b = read_picture(folder / "merged.exr");
  EXPECT_TRUE(a.pixels == b.pixels);
  EXPECT_TRUE(a.layers.at("error") == b.layers.at("error"));
  EXPECT_FALSE(read_picture(folder / "1.exr").pixels == a.pixels) << "the map is too small for two parts";
  const auto mesh_of = [](const std::string& path) { return scene::read_gltf_file(path).json["meshes"]; };
  EXPECT_EQ(mesh_of(whole), mesh_of(merged));

  const Outcome lacks = run({"merge", folder / "1.exr", "-o", merged});
  EXPECT_EQ(lacks.status, 1);
  EXPECT_NE(lacks.err.find("one of 2 parts"), std::string::npos) << lacks.err;
  const Outcome twice = run({"merge", folder / "1.exr", folder / "1.exr", "-o", merged});
  EXPECT_NE(twice.err.find("once more"), std::string::npos) << twice.err;
  const Outcome as_picture = run({"merge", folder / "1.exr", folder / "2.exr", "-o", folder / "picture.exr"});
  EXPECT_NE(as_picture.err.find("no part of a picture"), std::string::npos) << as_picture.err;
  const Outcome none = run({"merge", folder / "whole.exr", "-o", merged});
  EXPECT_NE(none.err.find("no part"), std::string::npos) << none.err;
}

TEST_F(Program, BakesAMapForEachGroupOfLights) {
  const std::string baked = folder / "gallery.glb";
  const Outcome r =
      run({"bake", test::kSourceDir + "/scenes/gallery.glb", "-o", baked, "--texels", "2", "--bounces", "0", "--group", "star"});
  ASSERT_EQ(r.status, 0) << r.err;
  const Picture exr = read_picture(folder / "gallery.exr");
  const auto &star = exr.layers.at("group.star"), &others = exr.layers.at("group.others");
  for (std::size_t i = 0; i < exr.pixels.size(); ++i) EXPECT_EQ(exr.pixels[i], star[i] + others[i]);
  const auto maps = scene::read_gltf_file(baked).json["extras"]["steradian"]["lightMap"]["maps"];
  ASSERT_EQ(maps.size(), 2u);
  EXPECT_EQ(maps[0]["group"], "star");
  EXPECT_EQ(maps[0]["intensity"], 1);
  EXPECT_EQ(maps[1]["group"], "others");
}

TEST_F(Program, BakeSaysWhatIsWrong) {
  const auto fails = [&](std::vector<std::string> arguments, int status, const std::string& words) {
    arguments.insert(arguments.begin(), "bake");
    const Outcome r = run(arguments);
    EXPECT_EQ(r.status, status) << r.err;
    EXPECT_NE(r.err.find(words), std::string::npos) << r.err;
  };
  const std::string out = folder / "out.glb";
  fails({kRoom, "-o", folder / "out.exr"}, 2, "-o");
  fails({kRoom, "-o", out, "--direct", "off", "--bounces", "0"}, 2, "--direct");
  fails({kRoom, "-o", out, "--group", "moon"}, 1, "'moon'");
  fails({kRoom, "-o", out, "--part", "3/2"}, 2, "--part");
  fails({kRoom, "-o", out, "--part", "1/2"}, 2, "-o");
  fails({kRoom, "-o", out, "--target", "vertex", "--group", "sky"}, 2, "--group");
  fails({kRoom, "-o", out, "--target", "vertex", "--encoding", "rgb16"}, 2, "--encoding");
  fails({kRoom, "-o", out, "--texels", "5000"}, 1, "--texels");
  fails({kRoom, "-o", out, "--texels", "100", "--max-memory", "20MB"}, 1, "--max-memory");
  fails({folder / "none.glb", "-o", out}, 1, "none.glb");
  EXPECT_FALSE(fs::exists(out));
}

}  // namespace
}  // namespace steradian::bake_program_test
