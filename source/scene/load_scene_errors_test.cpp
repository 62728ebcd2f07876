// Invalid input: every kind is an Error that names the file and the place in it.
#include <functional>
#include <random>

#include "steradian/error.h"
#include "steradian/load_scene.h"
#include "support/gltf_test_file.h"

namespace steradian::scene::load_scene_errors_test {
namespace {

using nlohmann::json;

// Loads and expects an Error whose place begins with the file and whose message contains `part`.
void expect_error(const std::string& path, const std::string& part) {
  try {
    steradian::load_scene(path);
    ADD_FAILURE() << "loads; expected an error about: " << part;
  } catch (const Error& e) {
    const std::string what = e.what();
    EXPECT_EQ(e.place().substr(0, path.size()), path) << what;
    EXPECT_NE(what.find(part), std::string::npos) << what << "\n  expected: " << part;
  }
}

struct BadFile {
  const char* name;
  const char* message;  // part of it
  std::function<void(GltfTestFile&)> damage;
};

json image_of(const std::string& bytes) { return {{{"uri", "data:image/png;base64," + base64(bytes)}}}; }

void use_texture(GltfTestFile& f, const json& images) {
  f.json["images"] = images;
  f.json["textures"] = {{{"source", 0}}};
  f.material()["pbrMetallicRoughness"]["baseColorTexture"]["index"] = 0;
}

void use_area_light(GltfTestFile& f, const json& light) {
  f.json["extensions"]["EXT_lights_area"]["lights"] = json::array({light});
  f.node()["extensions"]["EXT_lights_area"]["light"] = 0;
}

const std::vector<BadFile>& bad_files() {
  using F = GltfTestFile;
  static const std::vector<BadFile> files = {
      {"no_asset", "\"asset\" is missing", [](F& f) { f.json.erase("asset"); }},
      {"gltf_1", "asset.version: glTF 1.0", [](F& f) { f.json["asset"]["version"] = "1.0"; }},
      {"accessors_object", "accessors: must be an array", [](F& f) { f.json["accessors"] = json::object(); }},
      {"node_number", "nodes[0]: must be an object", [](F& f) { f.json["nodes"][0] = 5; }},
      {"name_number", "meshes[0].name: must be a string", [](F& f) { f.json["meshes"][0]["name"] = 5; }},
      {"index_count_beyond_view", "accessors[2]: count 1000 at offset 0 needs 2000 bytes, bufferView 2 has 12",
       [](F& f) { f.json["accessors"][2]["count"] = 1000; }},
      {"huge_count", "accessors[0]: count 900000000000000", [](F& f) { f.json["accessors"][0]["count"] = 900000000000000; }},
      {"huge_count_without_view", "accessors[0]: count 1000000000 without a bufferView",
       [](F& f) {
         f.json["accessors"][0].erase("bufferView");
         f.json["accessors"][0]["count"] = 1000000000;
       }},
      {"count_beyond_integers", "accessors[0].count: is 1e+300", [](F& f) { f.json["accessors"][0]["count"] = 1e300; }},
      {"count_negative", "accessors[0].count: is -4", [](F& f) { f.json["accessors"][0]["count"] = -4; }},
      {"count_fraction", "accessors[0].count: must be an integer", [](F& f) { f.json["accessors"][0]["count"] = 3.5; }},
      {"count_missing", "accessors[0]: \"count\" is missing", [](F& f) { f.json["accessors"][0].erase("count"); }},
      {"count_text", "accessors[0].count: must be a number, is of type string", [](F& f) { f.json["accessors"][0]["count"] = "4"; }},
      {"accessor_offset", "accessors[0]: count 4 at offset 4000", [](F& f) { f.json["accessors"][0]["byteOffset"] = 4000; }},
      {"accessor_type", "accessors[0].type: \"VEC5\"", [](F& f) { f.json["accessors"][0]["type"] = "VEC5"; }},
      {"position_vec2", "accessors[0].type: is VEC2, must be VEC3", [](F& f) { f.json["accessors"][0]["type"] = "VEC2"; }},
      {"component_type", "accessors[0].componentType: 5124", [](F& f) { f.json["accessors"][0]["componentType"] = 5124; }},
      {"indices_float", "accessors[2].componentType: must be an unsigned integer",
       [](F& f) {
         f.primitive()["indices"] = f.add_floats({0, 1, 2}, "SCALAR");
         f.json["accessors"][2] = f.json["accessors"][3];
         f.primitive()["indices"] = 2;
       }},
      {"missing_view", "accessors[0].bufferView: bufferView 77 does not exist: the file has 3",
       [](F& f) { f.json["accessors"][0]["bufferView"] = 77; }},
      {"view_beyond_buffer", "bufferViews[0]: bytes 100000 to 100048 of buffer 0",
       [](F& f) { f.json["bufferViews"][0]["byteOffset"] = 100000; }},
      {"view_length", "bufferViews[0]: bytes 0 to 4000000000000", [](F& f) { f.json["bufferViews"][0]["byteLength"] = 4000000000000; }},
      {"view_negative", "bufferViews[0].byteOffset: is -1", [](F& f) { f.json["bufferViews"][0]["byteOffset"] = -1; }},
      {"stride_small", "bufferViews[0].byteStride: is 4, less than", [](F& f) { f.json["bufferViews"][0]["byteStride"] = 4; }},
      {"missing_buffer", "bufferViews[0].buffer: buffer 3 does not exist", [](F& f) { f.json["bufferViews"][0]["buffer"] = 3; }},
      {"buffer_short", "buffers[0]: byteLength is 5000",
       [](F& f) {
         f.json["buffers"] = {{{"byteLength", 5000}, {"uri", "data:x;base64,AAAA"}}};
       }},
      {"buffer_huge", "buffers[0]: byteLength is 1000000000000",
       [](F& f) {
         f.json["buffers"] = {{{"byteLength", 1000000000000}, {"uri", "data:x;base64,AAAA"}}};
       }},
      {"buffer_no_uri", "buffers[0]: \"uri\" is missing",
       [](F& f) {
         f.json["buffers"] = {{{"byteLength", 4}}};
       }},
      {"buffer_file", "buffers[0].uri: cannot find the file",
       [](F& f) {
         f.json["buffers"] = {{{"byteLength", 4}, {"uri", "nowhere.bin"}}};
       }},
      {"buffer_network", "buffers[0].uri: files from the network",
       [](F& f) {
         f.json["buffers"] = {{{"byteLength", 4}, {"uri", "https://a/b"}}};
       }},
      {"buffer_directory", "is not a regular file",
       [](F& f) {
         f.json["buffers"] = {{{"byteLength", 4}, {"uri", "."}}};
       }},
      {"bad_base64", "buffers[0].uri: not base64: character 2",
       [](F& f) {
         f.json["buffers"] = {{{"byteLength", 3}, {"uri", "data:x;base64,AA*A"}}};
       }},
      {"cut_base64", "buffers[0].uri: the base64 data are cut off",
       [](F& f) {
         f.json["buffers"] = {{{"byteLength", 3}, {"uri", "data:x;base64,AAAAA"}}};
       }},
      {"no_base64", "buffers[0].uri: a data URI must be",
       [](F& f) {
         f.json["buffers"] = {{{"byteLength", 3}, {"uri", "data:AAAA"}}};
       }},
      {"cyclic_nodes", "nodes[1]: the node is its own ancestor",
       [](F& f) {
         f.append("nodes", {{"children", {2}}});
         f.append("nodes", {{"children", {1}}});
       }},
      {"own_child", "nodes[0]: the node is its own ancestor", [](F& f) { f.node()["children"] = {0}; }},
      {"two_parents", "nodes[2].children[0]: node 0 is already a child of node 1",
       [](F& f) {
         f.append("nodes", {{"children", {0}}});
         f.append("nodes", {{"children", {0}}});
       }},
      {"missing_child", "nodes[0].children[0]: node 9 does not exist", [](F& f) { f.node()["children"] = {9}; }},
      {"child_as_root", "scenes[0].nodes[1]: node 0 is a child of node 1",
       [](F& f) {
         f.append("nodes", {{"children", {0}}});
         f.json["scenes"] = {{{"nodes", {1, 0}}}};
       }},
      {"root_twice", "scenes[0].nodes[1]: node 0 is listed twice",
       [](F& f) {
         f.json["scenes"] = {{{"nodes", {0, 0}}}};
       }},
      {"missing_scene", "scene: scene 4 does not exist", [](F& f) { f.json["scene"] = 4; }},
      {"missing_mesh", "nodes[0].mesh: mesh 7 does not exist: the file has 1", [](F& f) { f.node()["mesh"] = 7; }},
      {"missing_accessor", "attributes.POSITION: accessor 12 does not exist", [](F& f) { f.primitive()["attributes"]["POSITION"] = 12; }},
      {"missing_indices", "meshes[0].primitives[0].indices: accessor 12", [](F& f) { f.primitive()["indices"] = 12; }},
      {"missing_material", "primitives[0].material: material 1 does not exist: the file has 0",
       [](F& f) { f.primitive()["material"] = 1; }},
      {"missing_skin", "nodes[0].skin: skin 0 does not exist", [](F& f) { f.node()["skin"] = 0; }},
      {"missing_camera", "nodes[0].camera: camera 0 does not exist", [](F& f) { f.node()["camera"] = 0; }},
      {"no_primitives", "meshes[0]: \"primitives\" is missing", [](F& f) { f.json["meshes"][0].erase("primitives"); }},
      {"no_attributes", "primitives[0]: \"attributes\" is missing", [](F& f) { f.primitive().erase("attributes"); }},
      {"mode", "primitives[0].mode: is 9", [](F& f) { f.primitive()["mode"] = 9; }},
      {"index_beyond_vertices", "element 2 is 9, the primitive has 4 vertices",
       [](F& f) {
         f.primitive()["indices"] = f.add_indices({0, 1, 9});
       }},
      {"corners", "4 corners do not make whole triangles",
       [](F& f) {
         f.primitive()["indices"] = f.add_indices({0, 1, 2, 3});
       }},
      {"attribute_count", "attributes.TEXCOORD_0: accessor 3 has 1 elements, POSITION has 4",
       [](F& f) {
         f.primitive()["attributes"]["TEXCOORD_0"] = f.add_floats({0, 0}, "VEC2");
       }},
      {"position_nan", "accessors[3]: element 1 is not finite",
       [](F& f) {
         f.primitive()["attributes"]["POSITION"] = f.add_floats({0, 0, 0, 1, NAN, 0, 1, 1, 0, 0, 1, 0}, "VEC3");
       }},
      {"position_infinite", "accessors[3]: element 2 is not finite",
       [](F& f) {
         f.primitive()["attributes"]["POSITION"] = f.add_floats({0, 0, 0, 1, 0, 0, INFINITY, 1, 0, 0, 1, 0}, "VEC3");
       }},
      {"position_leaves_range", "the farthest that can be rendered",
       [](F& f) {
         f.node()["scale"] = {1e39, 1, 1};
       }},
      {"transform_leaves_range", "nodes[0]: the transform leaves the range",
       [](F& f) {
         f.node()["scale"] = {1e200, 1e200, 1};
       }},
      {"zero_matrix", "nodes[0].matrix: the matrix cannot be inverted",
       [](F& f) { f.node()["matrix"] = {0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1}; }},
      {"projective_matrix", "nodes[0].matrix: the last row",
       [](F& f) { f.node()["matrix"] = {1, 0, 0, 1, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}; }},
      {"short_matrix", "nodes[0].matrix: needs 16 numbers, has 3",
       [](F& f) {
         f.node()["matrix"] = {1, 0, 0};
       }},
      {"matrix_and_scale", "nodes[0]: has both",
       [](F& f) {
         f.node()["matrix"] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
         f.node()["scale"] = {1, 1, 1};
       }},
      {"zero_rotation", "nodes[0].rotation: must be a unit quaternion",
       [](F& f) {
         f.node()["rotation"] = {0, 0, 0, 0};
       }},
      {"translation_text", "nodes[0].translation[1]: must be a number",
       [](F& f) {
         f.node()["translation"] = {0, "1", 0};
       }},
      {"missing_texture", "baseColorTexture.index: texture 3 does not exist",
       [](F& f) { f.material()["pbrMetallicRoughness"]["baseColorTexture"]["index"] = 3; }},
      {"missing_image", "textures[0].source: image 5 does not exist",
       [](F& f) {
         use_texture(f, image_of(small_png()));
         f.json["textures"][0]["source"] = 5;
       }},
      {"missing_sampler", "textures[0].sampler: sampler 5 does not exist",
       [](F& f) {
         use_texture(f, image_of(small_png()));
         f.json["textures"][0]["sampler"] = 5;
       }},
      {"image_file", "images[0].uri: cannot find the file",
       [](F& f) {
         use_texture(f, {{{"uri", "nowhere.png"}}});
       }},
      {"image_empty", "images[0]: has neither", [](F& f) { use_texture(f, json::array({json::object()})); }},
      {"image_text", "images[0]: the picture is neither PNG nor JPEG", [](F& f) { use_texture(f, image_of("hello")); }},
      {"image_truncated", "images[0]: cannot read the PNG picture", [](F& f) { use_texture(f, image_of(small_png().substr(0, 45))); }},
      {"image_huge", "images[0]: the picture claims 10000 x 9000 texels",
       [](F& f) {
         std::string png = small_png();
         png.replace(16, 8, std::string("\0\0\x27\x10\0\0\x23\x28", 8));
         png.replace(29, 4, "\x29\x4A\x54\xA3");  // the header's checksum
         use_texture(f, image_of(png));
       }},
      {"wrap", "samplers[0].wrapS: 7 is not a wrap mode",
       [](F& f) {
         use_texture(f, image_of(small_png()));
         f.json["samplers"] = {{{"wrapS", 7}}};
         f.json["textures"][0]["sampler"] = 0;
       }},
      {"roughness", "roughnessFactor: is 1.5, must be from 0", [](F& f) { f.material()["pbrMetallicRoughness"]["roughnessFactor"] = 1.5; }},
      {"base_color", "baseColorFactor: needs 4 numbers, has 3",
       [](F& f) {
         f.material()["pbrMetallicRoughness"]["baseColorFactor"] = {1, 1, 1};
       }},
      {"emissive", "emissiveFactor: components must be",
       [](F& f) {
         f.material()["emissiveFactor"] = {-1, 1, 1};
       }},
      {"alpha_mode", "alphaMode: \"GLASS\"", [](F& f) { f.material()["alphaMode"] = "GLASS"; }},
      {"double_sided", "doubleSided: must be true or false", [](F& f) { f.material()["doubleSided"] = 1; }},
      {"extension_text", "KHR_materials_ior: must be an object", [](F& f) { f.material()["extensions"]["KHR_materials_ior"] = "x"; }},
      {"lobe_name", "extras.steradian.brdf: \"plastic\" is not a lobe",
       [](F& f) {
         f.material()["extras"]["steradian"] = {{"brdf", "plastic"}};
       }},
      {"lobe_key", "\"exponents\" is not a key of phong",
       [](F& f) {
         f.material()["extras"]["steradian"] = {{"brdf", "phong"}, {"exponents", 5}};
       }},
      {"lobe_without_exponent", "extras.steradian: \"exponent\" is missing",
       [](F& f) {
         f.material()["extras"]["steradian"] = {{"brdf", "phong"}};
       }},
      {"lobe_exponent", "exponent: is -3",
       [](F& f) {
         f.material()["extras"]["steradian"] = {{"brdf", "phong"}, {"exponent", -3}};
       }},
      {"lobe_number", "extras.steradian: must be an object", [](F& f) { f.material()["extras"]["steradian"] = 5; }},
      {"area_light_type", "lights[0].type: \"tube\" is not an area light",
       [](F& f) {
         use_area_light(f, {{"type", "tube"}});
       }},
      {"area_light_size", "lights[0].size: is -1",
       [](F& f) {
         use_area_light(f, {{"type", "rect"}, {"size", -1}});
       }},
      {"area_light_color", "lights[0].color: components must not be",
       [](F& f) {
         use_area_light(f, {{"type", "rect"}, {"color", {-1, 0, 0}}});
       }},
      {"area_light_missing", "EXT_lights_area.light: light 0 does not exist: the file has 0",
       [](F& f) { f.node()["extensions"]["EXT_lights_area"]["light"] = 0; }},
      {"punctual_type", "lights[0].type: \"laser\"",
       [](F& f) {
         f.json["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "laser"}}};
         f.node()["extensions"]["KHR_lights_punctual"]["light"] = 0;
       }},
      {"spot_angles", "spot: innerConeAngle must be less",
       [](F& f) {
         f.json["extensions"]["KHR_lights_punctual"]["lights"] = {
             {{"type", "spot"}, {"spot", {{"innerConeAngle", 1}, {"outerConeAngle", 0.5}}}}};
         f.node()["extensions"]["KHR_lights_punctual"]["light"] = 0;
       }},
      {"camera_yfov", "cameras[0].perspective.yfov: is 9",
       [](F& f) {
         f.json["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", 9}}}}};
         f.node()["camera"] = 0;
       }},
      {"camera_type", "cameras[0].type: \"fisheye\"",
       [](F& f) {
         f.json["cameras"] = {{{"type", "fisheye"}}};
         f.node()["camera"] = 0;
       }},
      {"sparse_count", "accessors[0].sparse.count: is 9, more than",
       [](F& f) {
         f.json["accessors"][0]["sparse"] = {
             {"count", 9}, {"indices", {{"bufferView", 2}, {"componentType", 5123}}}, {"values", {{"bufferView", 0}}}};
       }},
      {"sparse_index", "sparse.indices: element 0 is 200",
       [](F& f) {
         const int v = f.add_view(std::vector<std::uint8_t>{200});
         f.json["accessors"][0]["sparse"] = {
             {"count", 1}, {"indices", {{"bufferView", v}, {"componentType", 5121}}}, {"values", {{"bufferView", 0}}}};
       }},
      {"sparse_values", "sparse.values: count 2",
       [](F& f) {
         const int v = f.add_view(std::vector<std::uint8_t>{0, 1});
         f.json["accessors"][0]["sparse"] = {
             {"count", 2}, {"indices", {{"bufferView", v}, {"componentType", 5121}}}, {"values", {{"bufferView", v}}}};
       }},
      {"joint", "JOINTS_0: vertex 0 names joint 7, the skin has 1",
       [](F& f) {
         f.primitive()["attributes"]["JOINTS_0"] = f.add_accessor(std::vector<std::uint8_t>(16, 7), "VEC4", 5121, 4);
         f.primitive()["attributes"]["WEIGHTS_0"] = f.add_floats(std::vector<float>(16, 0.25f), "VEC4");
         f.node()["skin"] = 0;
         f.json["skins"] = {{{"joints", {0}}}};
       }},
      {"required_extension", "extensionsRequired[0]: the file requires KHR_draco_mesh_compression",
       [](F& f) { f.json["extensionsRequired"] = {"KHR_draco_mesh_compression"}; }},
  };
  return files;
}

TEST(LoadSceneErrors, NamesFileAndPlaceForEveryKindOfBadFile) {
  EXPECT_GE(bad_files().size(), 40u);
  for (const BadFile& bad : bad_files()) {
    SCOPED_TRACE(bad.name);
    GltfTestFile f = GltfTestFile::square();
    bad.damage(f);
    expect_error(f.write(std::string(bad.name) + ".gltf"), bad.message);
  }
}

TEST(LoadSceneErrors, NamesFileAndPlaceForBrokenContainers) {
  const std::string glb = GltfTestFile::square().glb();
  expect_error(test_path("missing.gltf"), "cannot find the file");
  expect_error("/tmp", "is not a regular file");
  expect_error(write_test_file("empty.gltf", ""), "the file is empty");
  expect_error(write_test_file("text.gltf", "hello"), "not valid JSON");
  expect_error(write_test_file("cut.gltf", GltfTestFile::square().text().substr(0, 300)), "not valid JSON");
  expect_error(write_test_file("array.gltf", "[]"), "must be a JSON object");
  expect_error(write_test_file("deep.gltf", std::string(100000, '[')), "nested more than");
  expect_error(write_test_file("magic.glb", "glTX" + glb.substr(4)), "does not begin with \"glTF\"");
  expect_error(write_test_file("header.glb", glb.substr(0, 11)), "header: a .glb has at least");
  expect_error(write_test_file("truncated.glb", glb.substr(0, glb.size() / 2)), "header: length");
  std::string changed = glb;
  changed[4] = 1;
  expect_error(write_test_file("version.glb", changed), "header: version 1");
  changed = glb;
  changed[15] = 100;
  expect_error(write_test_file("chunk.glb", changed), "chunk 0: claims");
  changed = glb;
  changed[16] = 'X';
  expect_error(write_test_file("chunk_type.glb", changed), "chunk 0: the first chunk must be JSON");
}

TEST(LoadSceneErrors, AsksForAtLeastOneLight) {
  EXPECT_THROW(steradian::load_scene(GltfTestFile::square().write(), {.max_lights = 0}), Error);
}

// A file that uses every feature, so that mutations reach every part of the reader.
std::string rich_glb() {
  GltfTestFile f = GltfTestFile::square();
  use_texture(f, image_of(small_png()));
  f.material()["normalTexture"]["index"] = 0;
  f.material()["emissiveFactor"] = {1, 1, 1};
  f.material()["extras"]["steradian"] = {{"brdf", "phong"}, {"exponent", 5}};
  use_area_light(f, {{"type", "sphere"}, {"size", 1}});
  f.node()["rotation"] = {0, 0, 0, 1};
  const int v = f.add_view(std::vector<std::uint8_t>{1});
  f.json["accessors"][0]["sparse"] = {
      {"count", 1}, {"indices", {{"bufferView", v}, {"componentType", 5121}}}, {"values", {{"bufferView", 0}}}};
  return f.glb();
}

TEST(LoadSceneErrors, LoadsOrRefusesMutatedFiles) {
  const std::string original = rich_glb();
  const std::string path = test_path("fuzz.glb");
  ASSERT_NO_THROW(load_scene_from_memory(original, path));
  std::mt19937 random(20240607);
  int loaded = 0, refused = 0;
  constexpr int kMutations = 10000;
  for (int i = 0; i < kMutations; ++i) {
    std::string bytes = original;
    const int changes = 1 + static_cast<int>(random() % 3);
    for (int c = 0; c < changes; ++c) {
      const std::size_t at = random() % bytes.size();
      switch (random() % 4) {
        case 0: bytes[at] = static_cast<char>(random()); break;
        case 1: bytes[at] = static_cast<char>(bytes[at] ^ (1 << random() % 8)); break;
        case 2: bytes[at] = "0123456789-.e[]{},\""[random() % 19]; break;
        default: bytes[at] = bytes[random() % bytes.size()]; break;
      }
    }
    if (random() % 50 == 0) bytes.resize(random() % bytes.size());
    try {
      const LoadedScene scene = load_scene_from_memory(bytes, path);
      for (const Mesh& mesh : scene.scene.meshes)
        for (const std::uint32_t index : mesh.indices) ASSERT_LT(index, mesh.positions.size()) << "mutation " << i;
      ++loaded;
    } catch (const Error& e) {
      ASSERT_EQ(e.place().substr(0, path.size()), path) << "mutation " << i << ": " << e.what();
      ++refused;
    }
  }
  EXPECT_EQ(loaded + refused, kMutations);
  EXPECT_GT(loaded, kMutations / 20);  // otherwise the mutations do not reach beyond the container
  EXPECT_GT(refused, kMutations / 20);
}

}  // namespace
}  // namespace steradian::scene::load_scene_errors_test
