#include "steradian/load_scene.h"

#include <cmath>
#include <filesystem>
#include <numbers>

#include "steradian/error.h"
#include "support/gltf_test_file.h"
#include "support/meshes.h"

namespace steradian::scene::load_scene_test {
namespace {

using nlohmann::json;

LoadedScene load(const GltfTestFile& file, const LoadOptions& options = {}) { return steradian::load_scene(file.write(), options); }

bool warns(const LoadedScene& loaded, const std::string& part) {
  for (const std::string& w : loaded.warnings)
    if (w.find(part) != std::string::npos) return true;
  return false;
}

void expect_near(Vec3d a, Vec3d b, double tolerance) {
  EXPECT_LE(length(a - b), tolerance) << a.x << " " << a.y << " " << a.z << ", expected " << b.x << " " << b.y << " " << b.z;
}
void expect_near(Vec3f a, Vec3d b, double tolerance = 1e-6) { expect_near(static_cast<Vec3d>(a), b, tolerance); }

TEST(LoadScene, ReadsASquareFromGltfAndGlbAlike) {
  for (const char* name : {"a.gltf", "a.glb"}) {
    const LoadedScene loaded = steradian::load_scene(GltfTestFile::square().write(name));
    ASSERT_EQ(loaded.scene.meshes.size(), 1u);
    EXPECT_EQ(loaded.scene.meshes[0].triangle_count(), 2u);
    EXPECT_NEAR(signed_area(loaded.scene.meshes[0]), 1, 1e-6);
    expect_near(loaded.scene.meshes[0].normals[0], {0, 0, 1});
  }
}

TEST(LoadScene, ReadsBuffersFromFilesWithPercentCodedNames) {
  GltfTestFile f = GltfTestFile::square();
  const std::string path = write_test_file("a b.bin", f.buffer);
  std::string name = std::filesystem::path(path).filename().string();
  name.replace(name.find(' '), 1, "%20");
  f.json["buffers"] = {{{"byteLength", f.buffer.size()}, {"uri", name}}};
  EXPECT_EQ(load(f).scene.triangle_count(), 2u);
}

TEST(LoadScene, MakesTrianglesOfStripsAndFansThatFaceAlike) {
  for (const int mode : {5, 6}) {
    GltfTestFile f;
    const std::vector<float> strip = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 0, 2, 0}, fan = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, -1, 1, 0};
    f.add_mesh({{"POSITION", f.add_floats(mode == 5 ? strip : fan, "VEC3")}})["mode"] = mode;
    const LoadedScene loaded = load(f);
    EXPECT_EQ(loaded.scene.triangle_count(), 3u);
    for (const Vec3f& n : loaded.scene.meshes[0].normals) expect_near(n, {0, 0, 1});
  }
}

TEST(LoadScene, LeavesPointsAndLinesOutAndSaysSo) {
  GltfTestFile f = GltfTestFile::square();
  f.primitive()["mode"] = 1;
  const LoadedScene loaded = load(f);
  EXPECT_EQ(loaded.scene.triangle_count(), 0u);
  EXPECT_TRUE(warns(loaded, "points and lines"));
}

TEST(LoadScene, MultipliesTransformsDownTheTree) {
  GltfTestFile f = GltfTestFile::square();
  f.node()["translation"] = {1, 0, 0};
  const double h = std::sqrt(0.5);
  f.append("nodes", {{"children", {0}}, {"rotation", {0, h, 0, h}}, {"scale", {2, 2, 2}}});  // a quarter turn about y: x to -z
  f.json["scenes"] = {{{"nodes", {1}}}};
  const LoadedScene loaded = load(f);
  expect_near(loaded.scene.meshes[0].positions[0], {0, 0, -2});
  expect_near(loaded.scene.meshes[0].normals[0], {1, 0, 0});
  EXPECT_NEAR(signed_area(loaded.scene.meshes[0]), 4, 1e-5);
}

TEST(LoadScene, TurnsTrianglesOfMirroredNodes) {
  GltfTestFile f = GltfTestFile::square();
  const int n = f.add_floats({0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3");
  f.primitive()["attributes"]["NORMAL"] = n;
  f.node()["matrix"] = {-3, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 5, 0, 0, 1};
  const LoadedScene loaded = load(f);
  expect_near(loaded.scene.meshes[0].normals[0], {0, 0, 1});
  EXPECT_NEAR(signed_area(loaded.scene.meshes[0]), 3, 1e-5);
}

TEST(LoadScene, KeepsNormalsPerpendicularUnderUnevenScale) {
  GltfTestFile f;
  const double h = std::sqrt(0.5);
  const auto s = static_cast<float>(h);
  const int p = f.add_floats({0, 0, 0, 0, 0, 1, 1, 1, 0}, "VEC3"), n = f.add_floats({-s, s, 0, -s, s, 0, -s, s, 0}, "VEC3");
  f.add_mesh({{"POSITION", p}, {"NORMAL", n}});
  f.node()["scale"] = {4, 1, 1};
  expect_near(load(f).scene.meshes[0].normals[0], normalized(Vec3d{-1, 4, 0}));
}

TEST(LoadScene, ReadsQuantizedAndStridedAttributes) {
  GltfTestFile f;
  const std::vector<std::int16_t> values = {0, 0, 0, 77, 32767, 0, 0, 77, 0, 32767, 0, 77};  // 77: padding of the stride
  f.add_view(values);
  f.json["bufferViews"][0]["byteStride"] = 8;
  f.append("accessors", {{"bufferView", 0}, {"componentType", 5122}, {"normalized", true}, {"count", 3}, {"type", "VEC3"}});
  f.add_mesh({{"POSITION", 0}});
  f.json["extensionsRequired"] = {"KHR_mesh_quantization"};
  const LoadedScene loaded = load(f);
  expect_near(loaded.scene.meshes[0].positions[1], {1, 0, 0});
  expect_near(loaded.scene.meshes[0].positions[2], {0, 1, 0});
}

TEST(LoadScene, AppliesSparseReplacements) {
  GltfTestFile f = GltfTestFile::square();
  const int indices = f.add_view(std::vector<std::uint8_t>{2}), values = f.add_view(std::vector<float>{1, 2, 0});
  f.json["accessors"][0]["sparse"] = {
      {"count", 1}, {"indices", {{"bufferView", indices}, {"componentType", 5121}}}, {"values", {{"bufferView", values}}}};
  const LoadedScene loaded = load(f);
  EXPECT_NEAR(loaded.scene.bounds_max.y, 2, 1e-6);
}

TEST(LoadScene, AppliesMorphTargetsAtTheirDefaultWeights) {
  GltfTestFile f = GltfTestFile::square();
  const int up = f.add_floats({0, 0, 2, 0, 0, 2, 0, 0, 2, 0, 0, 2}, "VEC3");
  f.primitive()["targets"] = {{{"POSITION", up}}};
  f.json["meshes"][0]["weights"] = {0.5};
  EXPECT_NEAR(load(f).scene.bounds_min.z, 1, 1e-6);
}

TEST(LoadScene, PutsSkinsInRestPose) {
  GltfTestFile f = GltfTestFile::square();
  const std::vector<std::uint8_t> joints = {0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0};
  const std::vector<float> weights = {1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0};
  f.primitive()["attributes"]["JOINTS_0"] = f.add_accessor(joints, "VEC4", 5121, 4);
  f.primitive()["attributes"]["WEIGHTS_0"] = f.add_floats(weights, "VEC4");
  f.node()["skin"] = 0;
  f.node()["translation"] = {100, 0, 0};  // has no effect on a skinned mesh
  f.append("nodes", {{"translation", {0, 0, 5}}});
  f.append("nodes", {{"translation", {0, 3, 5}}});
  f.json["skins"] = {{{"joints", {1, 2}}}};
  const LoadedScene loaded = load(f);
  EXPECT_NEAR(loaded.scene.bounds_max.y, 4, 1e-6);
  EXPECT_NEAR(loaded.scene.bounds_min.z, 5, 1e-6);
  EXPECT_NEAR(loaded.scene.bounds_max.x, 1, 1e-6);
}

TEST(LoadScene, MakesTangentsAlongGrowingU) {
  GltfTestFile f = GltfTestFile::square();
  f.json["images"] = {{{"uri", "data:image/png;base64," + base64(small_png())}}};
  f.json["textures"] = {{{"source", 0}}};
  f.material()["normalTexture"] = {{"index", 0}, {"scale", 0.5}};
  const LoadedScene loaded = load(f);
  const Mesh& mesh = loaded.scene.meshes[0];
  ASSERT_EQ(mesh.tangents.size(), mesh.positions.size());
  expect_near(Vec3f{mesh.tangents[0].x, mesh.tangents[0].y, mesh.tangents[0].z}, {1, 0, 0});
  EXPECT_EQ(mesh.tangents[0].w, 1);  // the bitangent is +y: up in the picture
  EXPECT_EQ(loaded.scene.materials[0].normal_texture.scale, 0.5f);
}

TEST(LoadScene, ReadsTexturesWithSamplerAndTransform) {
  GltfTestFile f = GltfTestFile::square();
  const std::string png = small_png();
  const int view = f.add_view(std::vector<char>(png.begin(), png.end()));
  f.json["images"] = {{{"bufferView", view}, {"mimeType", "image/png"}}};
  f.json["samplers"] = {{{"wrapS", 33071}, {"wrapT", 33648}, {"magFilter", 9728}}};
  f.json["textures"] = {{{"source", 0}, {"sampler", 0}}};
  f.material()["pbrMetallicRoughness"]["baseColorTexture"] = {
      {"index", 0}, {"extensions", {{"KHR_texture_transform", {{"offset", {0.5, 0}}, {"scale", {0.5, 1}}}}}}};
  const Scene scene = load(f).scene;
  const TextureUse& use = scene.materials[0].base_color_texture;
  EXPECT_EQ(use.wrap_u, Wrap::clamp_to_edge);
  EXPECT_EQ(use.wrap_v, Wrap::mirrored_repeat);
  EXPECT_EQ(use.filter, Filter::nearest);
  ASSERT_EQ(scene.images.size(), 1u);
  EXPECT_EQ(scene.images[0].width, 2);
  // sRGB 128 is ((128/255 + 0.055) / 1.055)^2.4 = 0.2158605. The transform moves u = 0.25 into the right texel.
  EXPECT_NEAR(static_cast<double>(sample_texture(scene.images, use, {0.25f, 0.5f}).x), 0.2158605, 1e-6);
  EXPECT_NEAR(static_cast<double>(sample_texture(scene.images, use, {-0.75f, 0.5f}).y), 0.0, 1e-6);
}

TEST(Texture, RotatesCounterClockwiseAsSeen) {
  GltfTestFile f = GltfTestFile::square();
  f.json["images"] = {{{"uri", "data:image/png;base64," + base64(small_png())}}};
  f.json["textures"] = {{{"source", 0}}};
  f.material()["emissiveTexture"] = {{"index", 0}, {"extensions", {{"KHR_texture_transform", {{"rotation", std::numbers::pi / 2}}}}}};
  const Vec2f t = load(f).scene.materials[0].emissive_texture.transformed({1, 0});
  EXPECT_NEAR(static_cast<double>(t.x), 0, 1e-6);  // v points down: +u turns towards -v
  EXPECT_NEAR(static_cast<double>(t.y), -1, 1e-6);
}

TEST(LoadScene, ReadsMaterialExtensions) {
  GltfTestFile f = GltfTestFile::square();
  f.material() = json::parse(
      R"({"name": "m", "emissiveFactor": [0.5, 0, 0], "doubleSided": true, "alphaMode": "MASK", "alphaCutoff": 0.25,
    "pbrMetallicRoughness": {"baseColorFactor": [0.1, 0.2, 0.3, 0.4], "metallicFactor": 0.6, "roughnessFactor": 0.7},
    "extensions": {"KHR_materials_emissive_strength": {"emissiveStrength": 8}, "KHR_materials_clearcoat": {"clearcoatFactor": 0.9, "clearcoatRoughnessFactor": 0.2},
      "KHR_materials_sheen": {"sheenColorFactor": [0.1, 0.2, 0.3], "sheenRoughnessFactor": 0.4},
      "KHR_materials_ior": {"ior": 1.4}, "KHR_materials_specular": {"specularFactor": 0.3, "specularColorFactor": [2, 1, 0]},
      "KHR_materials_anisotropy": {"anisotropyStrength": 0.8, "anisotropyRotation": 1.5}}})");
  const SurfaceMaterial m = load(f).scene.materials[0];
  EXPECT_EQ(m.name, "m");
  expect_near(m.emissive, {4, 0, 0});
  EXPECT_TRUE(m.double_sided);
  EXPECT_EQ(m.alpha_mode, AlphaMode::mask);
  EXPECT_EQ(m.alpha_cutoff, 0.25f);
  EXPECT_EQ(m.base_color.w, 0.4f);
  EXPECT_EQ(m.metallic, 0.6f);
  EXPECT_EQ(m.roughness, 0.7f);
  EXPECT_EQ(m.clearcoat, 0.9f);
  EXPECT_EQ(m.clearcoat_roughness, 0.2f);
  expect_near(m.sheen_color, {0.1, 0.2, 0.3});
  EXPECT_EQ(m.sheen_roughness, 0.4f);
  EXPECT_EQ(m.ior, 1.4f);
  EXPECT_EQ(m.specular, 0.3f);
  expect_near(m.specular_color, {2, 1, 0});
  EXPECT_EQ(m.anisotropy, 0.8f);
  EXPECT_EQ(m.anisotropy_rotation, 1.5f);
}

TEST(LoadScene, ReadsUnlitAndBlendedMaterials) {
  GltfTestFile f = GltfTestFile::square();
  f.material() = {{"alphaMode", "BLEND"}, {"extensions", {{"KHR_materials_unlit", json::object()}}}};
  const LoadedScene loaded = load(f);
  EXPECT_TRUE(loaded.scene.materials[0].unlit);
  EXPECT_EQ(loaded.scene.materials[0].alpha_mode, AlphaMode::blend);
  EXPECT_TRUE(loaded.scene.meshes[0].casts_shadow);
  f.material()["pbrMetallicRoughness"] = {{"baseColorFactor", {1, 1, 1, 0.4}}};
  EXPECT_FALSE(load(f).scene.meshes[0].casts_shadow) << "more than half of the light passes";
}

TEST(LoadScene, ReadsLobesFromExtras) {
  GltfTestFile f = GltfTestFile::square();
  f.material()["extras"]["steradian"] = {{"brdf", "phong"}, {"exponent", 50}, {"albedo", {0.5, 0.25, 0}}};
  f.append(
      "materials",
      {{"extras",
        {{"steradian", json::parse(R"([{"brdf": "ggx", "roughness": 0.5, "shadowing": "none"}, {"brdf": "beckmann", "alpha": 0.1}])")}}}});
  const auto materials = load(f).scene.materials;
  ASSERT_EQ(materials[0].specular_override.size(), 1u);
  EXPECT_EQ(materials[0].specular_override[0].brdf, Brdf::phong);
  EXPECT_EQ(materials[0].specular_override[0].exponent, 50);
  EXPECT_EQ(materials[0].specular_override[0].albedo.y, 0.25);
  ASSERT_EQ(materials[1].specular_override.size(), 2u);
  EXPECT_EQ(materials[1].specular_override[0].alpha_x, 0.25);
  EXPECT_FALSE(materials[1].specular_override[0].shadowing);
  EXPECT_EQ(materials[1].specular_override[1].alpha_y, 0.1);
}

TEST(LoadScene, ReadsVertexColors) {
  GltfTestFile f = GltfTestFile::square();
  const std::vector<std::uint8_t> rgba = {255, 0, 51, 255, 255, 0, 51, 255, 255, 0, 51, 255, 255, 0, 51, 255};
  f.primitive()["attributes"]["COLOR_0"] = f.add_accessor(rgba, "VEC4", 5121, 4);
  f.json["accessors"].back()["normalized"] = true;
  const Scene scene = load(f).scene;
  ASSERT_FALSE(scene.meshes[0].colors.empty());
  EXPECT_NEAR(static_cast<double>(scene.meshes[0].colors[0].z), 0.2, 1e-6);
}

TEST(LoadScene, ReadsPunctualLights) {
  GltfTestFile f = GltfTestFile::square();
  f.json["extensions"]["KHR_lights_punctual"]["lights"] =
      json::parse(R"([{"type": "spot", "color": [1, 0.5, 0], "intensity": 10, "spot": {"innerConeAngle": 0.1, "outerConeAngle": 0.5}}])");
  f.append("nodes", {{"translation", {1, 2, 3}}, {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
  const LoadedScene loaded = load(f);
  ASSERT_EQ(loaded.scene.punctual_lights.size(), 1u);
  const PunctualLight& light = loaded.scene.punctual_lights[0];
  EXPECT_EQ(light.kind, PunctualKind::spot);
  expect_near(light.position, {1, 2, 3}, 0);
  expect_near(light.direction, {0, 0, -1}, 1e-15);
  expect_near(light.intensity, {10, 5, 0}, 0);
  EXPECT_NEAR(light.cos_outer, std::cos(0.5), 1e-15);
  EXPECT_TRUE(loaded.scene.area_lights.empty()) << "no default light where there is one";
}

TEST(LoadScene, MergesAnEmissiveSquareIntoOneLight) {
  GltfTestFile f = GltfTestFile::square();
  f.material() = {{"emissiveFactor", {1, 1, 1}}, {"extensions", {{"KHR_materials_emissive_strength", {{"emissiveStrength", 7}}}}}};
  const Scene scene = load(f).scene;
  ASSERT_EQ(scene.area_lights.size(), 1u);
  EXPECT_EQ(std::get<Polygon>(scene.area_lights[0].shape).vertices.size(), 4u);
  EXPECT_NEAR(prepare_polygon(flat_polygon(scene.area_lights[0])).area, 1, 1e-12);
  expect_near(prepare_polygon(flat_polygon(scene.area_lights[0])).normal, {0, 0, 1}, 1e-12);
  EXPECT_NEAR(scene.area_lights[0].radiance.x, 7, 1e-6);
  EXPECT_EQ(scene.meshes[0].triangle_lights, (std::vector<std::int32_t>{0, 0}));
}

TEST(LoadScene, GivesATexturedEmitterItsMeanAndItsMap) {
  GltfTestFile f = GltfTestFile::square();
  f.json["images"] = {{{"uri", "data:image/png;base64," + base64(small_png())}}};
  f.json["samplers"] = {{{"magFilter", 9728}}};
  f.json["textures"] = {{{"source", 0}, {"sampler", 0}}};
  f.material() = {{"emissiveFactor", {1, 1, 1}}, {"emissiveTexture", {{"index", 0}}}};
  LoadOptions options;
  options.lights = {AddedLight::none};  // the texture alone is too weak for a picture
  const Scene scene = load(f, options).scene;
  ASSERT_EQ(scene.area_lights.size(), 1u);
  const AreaLight& light = scene.area_lights[0];
  ASSERT_TRUE(light.texture.has_value());
  const Vec3d p{0.75, 0.25, 0};  // uv (0.75, 0.75)
  EXPECT_NEAR(dot(p - light.texture->origin, light.texture->du) + light.texture->u0, 0.75, 1e-6);
  EXPECT_NEAR(dot(p - light.texture->origin, light.texture->dv) + light.texture->v0, 0.75, 1e-6);
  // Red is 1 on the left half, 0.21586 on the right. A triangle's mean is sampled at texel density only.
  EXPECT_NEAR(light.radiance.x, (1 + 0.2158605) / 2, 1e-6);
  EXPECT_NEAR(light.radiance.y, 0.2158605 / 2, 1e-6);
}

TEST(LoadScene, KeepsTheStrongestLightsAndSaysWhatItDrops) {
  GltfTestFile f = GltfTestFile::square();
  f.json["extensions"]["EXT_lights_area"]["lights"] = json::parse(
      R"([{"type": "rect", "intensity": 1}, {"type": "rect", "intensity": 3}, {"type": "rect", "intensity": 2}, {"type": "disk", "size": 0}])");
  for (int i = 0; i < 4; ++i) f.append("nodes", {{"extensions", {{"EXT_lights_area", {{"light", i}}}}}});
  const LoadedScene loaded = load(f, {.max_lights = 2});
  ASSERT_EQ(loaded.scene.area_lights.size(), 2u);
  EXPECT_EQ(loaded.scene.area_lights[0].radiance.x, 3);
  EXPECT_EQ(loaded.scene.area_lights[1].radiance.x, 2);
  EXPECT_TRUE(warns(loaded, "1 weakest area light dropped, 16.67 % of all power"));
  EXPECT_TRUE(warns(loaded, "1 area light without area"));
  EXPECT_EQ(loaded.scene.meshes[1].triangle_lights[0], -1);  // the weakest light; its mesh stays visible
  EXPECT_EQ(loaded.scene.meshes[2].triangle_lights[0], 0);
}

TEST(LoadScene, DropsEmittersWithoutAreaWithACount) {
  GltfTestFile f;
  f.add_mesh({{"POSITION", f.add_floats({0, 0, 0, 1, 0, 0, 2, 0, 0, 0, 0, 0, 1, 0, 0, 0, 1, 0}, "VEC3")}});
  f.material()["emissiveFactor"] = {1, 1, 1};
  const LoadedScene loaded = load(f);
  EXPECT_EQ(loaded.scene.area_lights.size(), 1u);
  EXPECT_TRUE(warns(loaded, "1 emissive triangle without area"));
}

TEST(LoadScene, ReadsCamerasAndFramesASceneWithoutOne) {
  GltfTestFile f = GltfTestFile::square();
  const LoadedScene framed = load(f);
  EXPECT_TRUE(warns(framed, "no camera"));
  EXPECT_TRUE(warns(framed, "no lights"));
  const Camera& c = framed.scene.cameras[0];
  const Vec3d to_center = Vec3d{0.5, 0.5, 0} - c.position;
  EXPECT_GT(dot(normalized(to_center), -c.z), 0.99) << "looks at about the centre";
  EXPECT_GT(c.position.y, 0.5) << "from above";
  EXPECT_GT(c.position.z, 0) << "from the front";

  f.json["cameras"] = {{{"type", "perspective"}, {"name", "main"}, {"perspective", {{"yfov", 0.7}, {"znear", 0.1}}}}};
  f.append("nodes", {{"camera", 0}, {"translation", {0, 1, 5}}});
  const LoadedScene own = load(f);
  ASSERT_EQ(own.scene.cameras.size(), 1u);
  EXPECT_EQ(own.scene.cameras[0].name, "main");
  EXPECT_EQ(own.scene.cameras[0].yfov, 0.7);
  expect_near(own.scene.cameras[0].position, {0, 1, 5}, 0);
  expect_near(own.scene.cameras[0].y, {0, 1, 0}, 1e-15);
}

TEST(LoadScene, NamesUnsupportedFeaturesInOneWarning) {
  GltfTestFile f = GltfTestFile::square();
  f.json["extensionsUsed"] = {"KHR_materials_dispersion", "KHR_materials_ior", "KHR_materials_iridescence", "KHR_materials_volume"};
  const LoadedScene loaded = load(f);
  EXPECT_TRUE(warns(loaded, "left out: KHR_materials_dispersion, KHR_materials_iridescence"));
}

TEST(LoadScene, LoadsEveryValidModelOfOthers) {
  const std::filesystem::path folder = "/usr/share/assimp/models/glTF2";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << "assimp-testmodels is not installed";
  // Files broken on purpose, or requiring unsupported features. All others must load.
  const std::vector<std::string> refused = {"techniqueWebGL",  "BoxWithInfinites", "IncorrectVertexArrays",
                                            "IndexOutOfRange", "MissingBin",       "RecursiveNodes",
                                            "SchemaFailures",  "NoScene.gltf",     "draco",
                                            "badArray",        "badExtension",     "badNumber",
                                            "badObject",       "badString",        "badUint"};
  // Expected triangle counts of the other files. The modes of primitives 4 to 6 and 11 to 15 are triangles, strips and fans; lines and
  // points are skipped.
  const std::vector<std::pair<std::string, std::size_t>> whole = {
      {"BoxTextured", 12},         {"boxTexcoords", 12},     {"BoxBadNormals", 12},        {"AnimatedMorphCube", 12},
      {"2CylinderEngine", 121496}, {"ClearCoatTest", 37116}, {"TextureTransformTest", 24}, {"simple_skin", 8},
      {"PrimitiveMode_03", 0},     {"PrimitiveMode_04", 2},  {"PrimitiveMode_05", 2},      {"PrimitiveMode_06", 2},
      {"PrimitiveMode_07", 0},     {"PrimitiveMode_11", 2},  {"PrimitiveMode_12", 2},      {"PrimitiveMode_13", 2},
      {"PrimitiveMode_14", 2},     {"PrimitiveMode_15", 2}};
  int loaded = 0;
  std::vector<int> found(refused.size());
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    const std::string path = entry.path().string();
    if (!path.ends_with(".gltf") && !path.ends_with(".glb")) continue;
    bool broken = false;
    for (std::size_t i = 0; i < refused.size(); ++i) {
      const bool named = path.find(refused[i]) != std::string::npos;
      broken |= named;
      found[i] += named;
    }
    try {
      const LoadedScene scene = steradian::load_scene(path);
      EXPECT_FALSE(broken) << path;
      for (const auto& [name, triangles] : whole) {
        if (path.find(name) == std::string::npos) continue;
        EXPECT_EQ(scene.scene.triangle_count(), triangles) << path;
        ++loaded;
      }
    } catch (const Error& e) {
      EXPECT_TRUE(broken) << e.what();
      EXPECT_EQ(e.place().substr(0, path.size()), path);
    }
  }
  for (std::size_t i = 0; i < refused.size(); ++i) EXPECT_GE(found[i], 1) << "no file is named " << refused[i];
  EXPECT_GE(loaded, static_cast<int>(whole.size())) << "the package lacks some of those named here";
}

}  // namespace
}  // namespace steradian::scene::load_scene_test
