// glTF files that are small but demand much: each is rendered or refused within a second of processor time and one gigabyte. Every file
// here once took more, in time that grew with a product or in memory.
#include <nlohmann/json.hpp>

#include <functional>
#include <iostream>
#include <regex>

#include "program.h"
#include "support/gltf_test_file.h"

namespace steradian::hostile_gltf_test {
namespace {

using namespace scene;

using nlohmann::json;

constexpr double kMostSeconds = 5;  // a second, and what a busy machine with two threads to a core takes more
constexpr long kMostKib = 1'000'000;

class HostileGltf : public Program {
 protected:
  // Hard limits a little above, so that a failure does not affect the whole machine.
  Outcome render(const std::string& gltf, std::vector<std::string> options = {"--size", "64x48"}) {
    std::ofstream(folder / "scene.gltf", std::ios::binary) << gltf;
    std::vector<std::string> arguments = {"render", folder / "scene.gltf", "-o", folder / "out.png"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    const Outcome o = run_limited(arguments, [] {
      const rlimit seconds{30, 30}, bytes{12'000'000'000, 12'000'000'000};
      setrlimit(RLIMIT_CPU, &seconds);
      setrlimit(RLIMIT_AS, &bytes);
    });
    std::cout << "[ measured ] " << o.cpu_seconds << " s, " << o.peak_kib / 1000 << " MB, status " << o.status << ": "
              << o.err.substr(0, 300) << (o.err.size() > 300 ? "...\n" : "");
    EXPECT_LT(o.cpu_seconds, kMostSeconds);
    EXPECT_LT(o.peak_kib, kMostKib);
    EXPECT_LT(o.err.size(), 2000u) << "warnings must be gathered";
    EXPECT_TRUE(o.status == 0 || o.status == 1) << o.status;
    EXPECT_TRUE(o.status != 1 || o.err.find("scene.gltf") != std::string::npos) << "no place: " << o.err;
    EXPECT_EQ(o.err.find("bad_alloc"), std::string::npos) << o.err;
    return o;
  }
};

GltfTestFile square_with(const std::function<void(GltfTestFile&)>& change) {
  GltfTestFile file = GltfTestFile::square();
  change(file);
  return file;
}

TEST_F(HostileGltf, PrimitivesWithoutPosition) {
  const Outcome o = render(square_with([](GltfTestFile& f) {
                             json primitives = json::array();
                             for (int i = 0; i < 40'000; ++i) primitives.push_back({{"attributes", {{"NORMAL", 0}}}});
                             f.append("nodes", {{"mesh", f.append("meshes", {{"primitives", primitives}})}});
                           }).text());
  EXPECT_EQ(o.status, 0);
  EXPECT_NE(o.err.find("primitives without POSITION were left out: 40000 times, the first is"), std::string::npos) << o.err;
}

TEST_F(HostileGltf, NodesTimesPoints) {
  const Outcome o = render(square_with([](GltfTestFile& f) {
                             json points = json::array();
                             for (int i = 0; i < 4'000; ++i) points.push_back({{"attributes", {{"POSITION", 0}}}, {"mode", 0}});
                             const int mesh = f.append("meshes", {{"primitives", points}});
                             for (int i = 0; i < 4'000; ++i) f.append("nodes", {{"mesh", mesh}});
                           }).text());
  EXPECT_EQ(o.status, 0);
}

TEST_F(HostileGltf, NodesTimesTriangles) {
  const Outcome o = render(square_with([](GltfTestFile& f) {
                             json many = json::array();
                             for (int i = 0; i < 4'000; ++i) many.push_back({{"attributes", {{"POSITION", 0}}}, {"indices", 2}});
                             const int mesh = f.append("meshes", {{"primitives", many}});
                             for (int i = 0; i < 4'000; ++i) f.append("nodes", {{"mesh", mesh}});
                           }).text());
  EXPECT_EQ(o.status, 1);
  EXPECT_NE(o.err.find("for the vertices and triangles of its mesh"), std::string::npos) << o.err;
  EXPECT_NE(o.err.find("--max-memory"), std::string::npos) << o.err;
}

TEST_F(HostileGltf, WarnedMeshes) {
  const Outcome o =
      render(square_with([](GltfTestFile& f) {
               f.append("images", {{"uri", "data:image/png;base64," + base64(small_png())}});
               f.append("textures", {{"source", 0}});
               f.material()["pbrMetallicRoughness"] = {{"baseColorTexture", {{"index", 0}}}};
               for (int i = 0; i < 20'000; ++i) {
                 const json primitive = {{"attributes", {{"POSITION", 0}}}, {"indices", 2}, {"material", 0}};
                 f.append("nodes", {{"mesh", f.append("meshes", {{"name", "m" + std::to_string(i)}, {"primitives", {primitive}}})}});
               }
             }).text(),
             {"--size", "8x6"});  // every ray meets all the squares, which lie on each other
  EXPECT_EQ(o.status, 0);
  EXPECT_NE(o.err.find("20000 times, the first is mesh \"m0\""), std::string::npos) << o.err;
}

TEST_F(HostileGltf, WarnedMaterialsAndUnknownExtensions) {
  const Outcome o = render(square_with([](GltfTestFile& f) {
                             for (int i = 0; i < 50'000; ++i) f.append("materials", {{"alphaMode", "BLEND"}});
                             for (int i = 0; i < 50'000; ++i) f.append("extensionsUsed", "X_" + std::to_string(i));
                           }).text());
  EXPECT_EQ(o.status, 0);
  EXPECT_NE(o.err.find("and 49984 more"), std::string::npos) << o.err;
}

TEST_F(HostileGltf, Skins) {
  constexpr int kSkins = 2'000;
  const Outcome o =
      render(square_with([](GltfTestFile& f) {
               const int joints = f.add_accessor(std::vector<std::uint16_t>(16), "VEC4", 5123, 4);
               const int weights = f.add_floats(std::vector<float>(16, 0.25f), "VEC4");
               std::vector<float> matrices(16 * 20'000);
               for (std::size_t i = 0; i < matrices.size(); i += 5) matrices[i] = 1;
               f.buffer.resize((f.buffer.size() + 3) / 4 * 4);
               const int view = f.add_view(matrices);
               const int bind = f.append("accessors", {{"bufferView", view}, {"componentType", 5126}, {"count", 20'000}, {"type", "MAT4"}});
               f.primitive()["attributes"]["JOINTS_0"] = joints;
               f.primitive()["attributes"]["WEIGHTS_0"] = weights;
               for (int i = 0; i < kSkins; ++i) {
                 const int skin = f.append("skins", {{"joints", {0, 0, 0}}, {"inverseBindMatrices", bind}});
                 f.append("nodes", {{"mesh", 0}, {"skin", skin}});
               }
             }).text());
  EXPECT_EQ(o.status, 0) << o.err;
}

TEST_F(HostileGltf, OneSkinOfManyJoints) {
  const Outcome o = render(square_with([](GltfTestFile& f) {
                             f.primitive()["attributes"]["JOINTS_0"] = f.add_accessor(std::vector<std::uint16_t>(16), "VEC4", 5123, 4);
                             f.primitive()["attributes"]["WEIGHTS_0"] = f.add_floats(std::vector<float>(16, 0.25f), "VEC4");
                             f.append("skins", {{"joints", std::vector<int>(2'000, 0)}});
                             for (int i = 0; i < 2'000; ++i) f.append("nodes", {{"mesh", 0}, {"skin", 0}});
                           }).text());
  EXPECT_EQ(o.status, 0) << o.err;
}

TEST_F(HostileGltf, BuffersAndPicturesOfOneFile) {
  std::ofstream(folder / "big.bin", std::ios::binary) << std::string(50'000'000, '\0');
  const Outcome o = render(square_with([](GltfTestFile& f) {
                             f.json["buffers"] = json::parse(f.text())["buffers"];
                             for (int i = 0; i < 100; ++i) f.append("buffers", {{"byteLength", 50'000'000}, {"uri", "./././big.bin"}});
                           }).text());
  EXPECT_EQ(o.status, 0) << o.err;
}

TEST_F(HostileGltf, EmptyArrays) {
  std::string text = R"({"asset":{"version":"2.0"},"extras":[[])";
  while (text.size() < 100'000'000) text += ",[]";
  const Outcome o = render(text + "]}");
  EXPECT_EQ(o.status, 1);
  EXPECT_TRUE(std::regex_search(o.err, std::regex("its JSON would take about .* GB of memory; it may take 500 MB"))) << o.err;
}

TEST_F(HostileGltf, SpheresOfLight) {
  const Outcome o = render(square_with([](GltfTestFile& f) {
                             f.json["extensionsUsed"] = {"EXT_lights_area"};
                             f.json["extensions"]["EXT_lights_area"]["lights"] = {{{"type", "sphere"}, {"size", 1}}};
                             for (int i = 0; i < 60'000; ++i) f.append("nodes", {{"extensions", {{"EXT_lights_area", {{"light", 0}}}}}});
                           }).text());
  EXPECT_EQ(o.status, 1);
  EXPECT_NE(o.err.find("its light's mesh"), std::string::npos) << o.err;
}

TEST_F(HostileGltf, MorphTargetsOfZeros) {
  const Outcome o = render(square_with([](GltfTestFile& f) {
                             const int zeros = f.append("accessors", {{"componentType", 5126}, {"count", 3'000'000}, {"type", "VEC3"}});
                             json& primitive = f.add_mesh({{"POSITION", zeros}, {"NORMAL", zeros}});
                             json targets = json::array();
                             for (int i = 0; i < 300; ++i) targets.push_back({{"POSITION", zeros}});
                             primitive["targets"] = targets;
                             f.json["meshes"][1]["weights"] = std::vector<double>(300, 0.5);
                           }).text());
  EXPECT_EQ(o.status, 1);
  EXPECT_NE(o.err.find("--max-work"), std::string::npos) << o.err;
}

TEST_F(HostileGltf, MeansOfATextureOverManyTriangles) {
  const Outcome o = render(square_with([](GltfTestFile& f) {
                             f.append("images", {{"uri", "data:image/png;base64," + base64(small_png())}});
                             f.append("textures", {{"source", 0}});
                             f.material()["emissiveTexture"] = {{"index", 0}};
                             f.material()["emissiveFactor"] = {1, 1, 1};
                             std::vector<std::uint16_t> corners;
                             for (int i = 0; i < 50'000; ++i)
                               for (const int c : {0, 1, 2}) corners.push_back(static_cast<std::uint16_t>(c));
                             f.primitive()["indices"] = f.add_indices(corners);
                             f.material()["emissiveTexture"]["extensions"]["KHR_texture_transform"] = {{"scale", {500, 500}}};
                           }).text());
  EXPECT_EQ(o.status, 1);
  EXPECT_NE(o.err.find("the means of its emissive texture"), std::string::npos) << o.err;
}

// Files that are refused by default are read if an option raises the limit.
TEST_F(HostileGltf, LimitsAreRaisedByTheirOptions) {
  std::string text = R"({"asset":{"version":"2.0"},"extras":[[])";
  while (text.size() < 1'000'000) text += ",[]";
  text += "]}";
  EXPECT_EQ(render(text, {"--size", "64x48", "--max-memory", "100MB"}).status, 1);
  EXPECT_EQ(render(text, {"--size", "64x48", "--max-memory", "1GB"}).status, 0);
  EXPECT_EQ(run({"render", folder / "scene.gltf", "-o", folder / "out.png", "--max-memory", "much"}).status, 2);
}

}  // namespace
}  // namespace steradian::hostile_gltf_test
