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
  EXPECT_EQ(file.json["extras"]["steradian"]["lightMap"]["exr"], "baked.exr");
  std::size_t shown = 0;
  double worst = 0;
  for (const auto& mesh : file.json["meshes"])
    for (const auto& primitive : mesh["primitives"]) {
      if (!primitive.contains("extras")) continue;
      const auto& map = primitive["extras"]["steradian"]["lightMap"];
      EXPECT_EQ(map["encoding"], "RGBM");
      const auto& picture = file.json["images"][file.json["textures"][map["texture"].get<std::size_t>()]["source"].get<std::size_t>()];
      const Image png = image::decode_png(scene::view_bytes(document, picture["bufferView"]), "png", 1 << 24, budget);
      ASSERT_EQ(png.width, exr.width);
      ASSERT_EQ(png.height, exr.height);
      const float range = map["range"];
      for (std::size_t i = 0; i < exr.pixels.size(); ++i) {
        const Vec3f d = bake::color_of_rgbm(png.rgba.data() + 4 * i, range) - exr.pixels[i];
        const float most = std::max({exr.pixels[i].x, exr.pixels[i].y, exr.pixels[i].z});
        // Half a step of 255 of each byte: the multiplier's last step is at most 1 / 255 of the range too large.
        worst = std::max(worst, static_cast<double>(std::max({std::fabs(d.x), std::fabs(d.y), std::fabs(d.z)}) / (most + range / 255)));
      }
      const std::string set = "TEXCOORD_" + std::to_string(map["texCoord"].get<int>());
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
  fails({kRoom, "-o", out, "--texels", "5000"}, 1, "--texels");
  fails({kRoom, "-o", out, "--texels", "100", "--max-memory", "20MB"}, 1, "--max-memory");
  fails({folder / "none.glb", "-o", out}, 1, "none.glb");
  EXPECT_FALSE(fs::exists(out));
}

}  // namespace
}  // namespace steradian::bake_program_test
