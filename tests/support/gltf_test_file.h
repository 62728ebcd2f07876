// GltfTestFile: a small glTF file that a test builds, breaks and writes.
#pragma once

#include <unistd.h>

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace steradian::scene {

// A folder for the running test alone (tests run in parallel as processes). It is removed when the process ends.
class TestFolder {
 public:
  TestFolder() : path_(testing::TempDir() + "steradian_" + std::to_string(getpid())) { std::filesystem::create_directories(path_); }
  ~TestFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

inline std::string test_path(const std::string& name) {
  static const TestFolder folder;
  return folder.path() + "/" + name;
}

inline std::string write_test_file(const std::string& name, const std::string& bytes) {
  const std::string path = test_path(name);
  std::ofstream(path, std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  return path;
}

inline std::string base64(const std::string& bytes) {
  const char* digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t bits = 0;
    for (std::size_t k = 0; k < 3; ++k) bits = bits << 8 | (i + k < bytes.size() ? static_cast<std::uint8_t>(bytes[i + k]) : 0u);
    for (std::size_t k = 0; k < 4; ++k) text += i + k <= bytes.size() ? digits[bits >> (18 - 6 * k) & 63] : '=';
  }
  return text;
}

struct GltfTestFile {
  nlohmann::json json = {{"asset", {{"version", "2.0"}}}};
  std::string buffer;

  template <class T>
  int add_view(const std::vector<T>& values) {
    buffer.resize((buffer.size() + 3) / 4 * 4);
    const std::size_t offset = buffer.size(), bytes = values.size() * sizeof(T);
    buffer.append(reinterpret_cast<const char*>(values.data()), bytes);
    return append("bufferViews", {{"buffer", 0}, {"byteOffset", offset}, {"byteLength", bytes}});
  }
  template <class T>
  int add_accessor(const std::vector<T>& values, const std::string& type, int component, std::size_t components) {
    return append("accessors",
                  {{"bufferView", add_view(values)}, {"componentType", component}, {"count", values.size() / components}, {"type", type}});
  }
  int add_floats(const std::vector<float>& values, const std::string& type) {
    return add_accessor(values, type, 5126, type == "SCALAR" ? 1 : static_cast<std::size_t>(type.back() - '0'));
  }
  int add_indices(const std::vector<std::uint16_t>& values) { return add_accessor(values, "SCALAR", 5123, 1); }
  int append(const char* array, const nlohmann::json& object) {
    json[array].push_back(object);
    return static_cast<int>(json[array].size()) - 1;
  }

  // Adds one mesh of one primitive with these attributes, and a node in the scene that shows it.
  nlohmann::json& add_mesh(const nlohmann::json& attributes, int indices = -1) {
    nlohmann::json primitive = {{"attributes", attributes}};
    if (indices >= 0) primitive["indices"] = indices;
    const int mesh = append("meshes", {{"primitives", {primitive}}});
    append("nodes", {{"mesh", mesh}});
    return json["meshes"][static_cast<std::size_t>(mesh)]["primitives"][0];
  }

  // The unit square in z = 0 that faces +z, with texture coordinates whose v points down.
  static GltfTestFile square() {
    GltfTestFile f;
    const int p = f.add_floats({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0}, "VEC3");
    const int uv = f.add_floats({0, 1, 1, 1, 1, 0, 0, 0}, "VEC2");
    f.add_mesh({{"POSITION", p}, {"TEXCOORD_0", uv}}, f.add_indices({0, 1, 2, 0, 2, 3}));
    return f;
  }
  nlohmann::json& primitive() { return json["meshes"][0]["primitives"][0]; }
  nlohmann::json& node() { return json["nodes"][0]; }
  nlohmann::json& material() {
    if (!json.contains("materials")) {
      append("materials", nlohmann::json::object());
      primitive()["material"] = 0;
    }
    return json["materials"][0];
  }

  std::string text() const {
    nlohmann::json whole = json;
    if (!buffer.empty() && !whole.contains("buffers"))
      whole["buffers"] = {{{"byteLength", buffer.size()}, {"uri", "data:application/octet-stream;base64," + base64(buffer)}}};
    return whole.dump();
  }
  std::string glb() const {
    nlohmann::json whole = json;
    whole["buffers"] = {{{"byteLength", buffer.size()}}};
    std::string text = whole.dump(), binary = buffer;
    text.resize((text.size() + 3) / 4 * 4, ' ');
    binary.resize((binary.size() + 3) / 4 * 4);
    const auto u32 = [](std::size_t n) {
      const auto x = static_cast<std::uint32_t>(n);
      return std::string(reinterpret_cast<const char*>(&x), 4);
    };
    return "glTF" + u32(2) + u32(28 + text.size() + binary.size()) + u32(text.size()) + "JSON" + text + u32(binary.size()) +
           std::string("BIN\0", 4) + binary;
  }
  std::string write(const std::string& name = "scene.gltf") const { return write_test_file(name, name.ends_with(".glb") ? glb() : text()); }
};

// A 2 x 1 PNG: left pixel red (255, 0, 0), right pixel grey (128, 128, 128).
inline std::string small_png() {
  const unsigned char bytes[] = {
      0x89, 0x50, 0x4E, 0x47, 0x0D, 0x0A, 0x1A, 0x0A, 0x00, 0x00, 0x00, 0x0D, 0x49, 0x48, 0x44, 0x52, 0x00, 0x00,
      0x00, 0x02, 0x00, 0x00, 0x00, 0x01, 0x08, 0x02, 0x00, 0x00, 0x00, 0x7B, 0x40, 0xE8, 0xDD, 0x00, 0x00, 0x00,
      0x0F, 0x49, 0x44, 0x41, 0x54, 0x78, 0x9C, 0x63, 0xF8, 0xCF, 0xC0, 0xD0, 0xD0, 0xD0, 0x00, 0x00, 0x09, 0x01,
      0x02, 0x80, 0x99, 0xC4, 0x69, 0x32, 0x00, 0x00, 0x00, 0x00, 0x49, 0x45, 0x4E, 0x44, 0xAE, 0x42, 0x60, 0x82,
  };
  return {reinterpret_cast<const char*>(bytes), sizeof bytes};
}

}  // namespace steradian::scene
