#include "scene/gltf/gltf_file.h"

#include <cstring>
#include <filesystem>

#include "core/files.h"
#include "scene/gltf/gltf_document.h"
#include "steradian/error.h"

namespace steradian::scene {
namespace {

void append_32(std::string& bytes, std::size_t n) {
  const auto x = static_cast<std::uint32_t>(n);
  for (int shift = 0; shift < 32; shift += 8) bytes += static_cast<char>(x >> shift & 0xFF);
}

// Appends a chunk padded to four bytes: JSON with spaces, binary data with zeros.
void append_chunk(std::string& bytes, std::string_view type, std::string_view data, char padding) {
  const std::size_t padded = (data.size() + 3) / 4 * 4;
  append_32(bytes, padded);
  bytes += type;
  bytes += data;
  bytes.append(padded - data.size(), padding);
}

// Calls `use` for the objects of a document that may name a file.
template <class Use>
void for_each_uri(Json& json, Use use) {
  const auto each = [&](Json& array) {
    if (!array.is_array()) return;
    for (Json& element : array)
      if (element.is_object() && element.contains("uri") && element["uri"].is_string()) use(element["uri"]);
  };
  for (const char* array : {"buffers", "images"})
    if (json.contains(array)) each(json[array]);
  const Json::json_pointer profiles("/extensions/EXT_lights_ies/lights");
  if (json.contains(profiles)) each(json[profiles]);
}

// Encodes a text for a URI: characters other than letters, digits and path marks become hexadecimal digits.
std::string percent_encoded(const std::string& text) {
  constexpr const char* kHex = "0123456789ABCDEF";
  std::string result;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (std::isalnum(byte) != 0 || std::strchr("/-_.~", c) != nullptr) {
      result += c;
    } else {
      result += '%';
      result += kHex[byte >> 4];
      result += kHex[byte & 15];
    }
  }
  return result;
}

void make_relative_to(Json& json, const std::filesystem::path& from, const std::filesystem::path& to) {
  const auto folder_of = [](const std::filesystem::path& file) {
    return std::filesystem::weakly_canonical(std::filesystem::absolute(file)).parent_path();
  };
  const std::filesystem::path between = folder_of(from).lexically_relative(folder_of(to));
  if (between == ".") return;
  for_each_uri(json, [&](Json& uri) {
    const auto name = uri.get<std::string>();
    if (name.starts_with("data:") || name.starts_with("/")) return;
    uri = percent_encoded(between.generic_string()) + "/" + name;
  });
}

}  // namespace

namespace {

GltfFile taken_apart(std::span<const std::uint8_t> bytes, const std::string& path, Budget& budget) {
  const GltfDocument checked = read_gltf(bytes, path, budget);
  const GltfContainer container = gltf_container(bytes, path);
  GltfFile file{path, Json::parse(container.json), {}};
  if (container.binary) file.binary = std::make_shared<const Bytes>(container.binary->begin(), container.binary->end());
  return file;
}

}  // namespace

GltfFile read_gltf_file(const std::string& path, const Limits& limits) {
  Budget budget(limits);
  return taken_apart(read_file(path, path, budget), path, budget);
}

GltfFile gltf_file_from_memory(std::string_view bytes, const std::string& path, const Limits& limits) {
  Budget budget(limits);
  return taken_apart({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()}, path, budget);
}

std::string base64(const Bytes& bytes) {
  constexpr const char* kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t bits = 0;
    for (std::size_t k = 0; k < 3; ++k) bits = bits << 8 | (i + k < bytes.size() ? bytes[i + k] : 0u);
    for (std::size_t k = 0; k < 4; ++k) text += i + k <= bytes.size() ? kDigits[bits >> (18 - 6 * k) & 63] : '=';
  }
  return text;
}

std::string glb_bytes(const GltfFile& file) {
  std::string text = file.json.dump(), chunks;
  append_chunk(chunks, "JSON", text, ' ');
  if (file.binary)
    append_chunk(chunks, std::string_view("BIN\0", 4), {reinterpret_cast<const char*>(file.binary->data()), file.binary->size()}, '\0');
  std::string bytes = "glTF";
  append_32(bytes, 2);
  append_32(bytes, 12 + chunks.size());
  return bytes + chunks;
}

void write_gltf_file(const GltfFile& file, const std::string& path) {
  GltfFile moved{path, file.json, {}};
  make_relative_to(moved.json, file.path, path);
  if (path.ends_with(".glb")) {
    moved.binary = file.binary;
    return write_file(path, glb_bytes(moved));
  }
  if (!path.ends_with(".gltf")) throw Error(path, "is neither .gltf nor .glb", "name the scene scene.glb");
  if (file.binary && moved.json.contains("buffers") && !moved.json["buffers"].empty())
    moved.json["buffers"][0]["uri"] = "data:application/octet-stream;base64," + base64(*file.binary);
  write_file(path, moved.json.dump(1) + "\n");
}

}  // namespace steradian::scene
