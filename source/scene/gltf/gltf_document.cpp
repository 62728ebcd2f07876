#include "scene/gltf/gltf_document.h"

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <optional>

#include "scene/gltf/gltf_file.h"

namespace steradian::scene {
namespace {

constexpr const char* kSupported[] = {"KHR_animation_pointer",   "EXT_lights_area",        "EXT_lights_ies",
                                      "EXT_lights_image_based",  "KHR_lights_punctual",    "KHR_materials_anisotropy",
                                      "KHR_materials_clearcoat", "KHR_materials_sheen",    "KHR_materials_emissive_strength",
                                      "KHR_materials_ior",       "KHR_materials_specular", "KHR_materials_transmission",
                                      "KHR_materials_unlit",     "KHR_materials_volume",   "KHR_mesh_quantization",
                                      "KHR_texture_transform"};

bool is_supported(const std::string& extension) {
  return std::any_of(std::begin(kSupported), std::end(kSupported), [&](const char* known) { return extension == known; });
}

}  // namespace

void check_required_extensions(const JsonCursor& root) {
  for (const JsonCursor& name : root.elements("extensionsRequired"))
    if (!is_supported(name.as_text()))
      name.fail("the file requires " + name.as_text() + ", which is not supported", "export it without this extension");
}

FileFacts read_file_facts(const JsonCursor& root, Warnings& warnings) {
  FileFacts facts;
  facts.generator = root.at("asset").text("generator", "");
  for (const JsonCursor& name : root.elements("extensionsRequired")) facts.extensions_required.push_back(name.as_text());
  for (const JsonCursor& name : root.elements("extensionsUsed")) {
    facts.extensions_used.push_back(name.as_text());
    if (!is_supported(name.as_text())) warnings.not_supported(name.as_text());
  }
  return facts;
}

namespace {

// The nesting limit, deeper than any real file. Parsers and destructors of nested values may recurse.
constexpr int kMaxDepth = 200;

std::uint32_t little_endian_32(const std::uint8_t* p) {
  return std::uint32_t{p[0]} | std::uint32_t{p[1]} << 8 | std::uint32_t{p[2]} << 16 | std::uint32_t{p[3]} << 24;
}

// Memory that the parsed text will take, estimated by its punctuation. A value takes 16 bytes in an array that grows by doubling. An array
// or object takes a block on the heap. A member of an object takes a tree node with its key.
struct JsonCost {
  std::uint64_t values = 0, containers = 0, members = 0, characters = 0;
  std::uint64_t bytes() const { return 32 * values + 64 * containers + 128 * members + characters; }
};

// Throws Error for a text that is nested too deeply.
JsonCost judge_json(std::string_view text, const std::string& path) {
  JsonCost cost;
  int depth = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    switch (text[i]) {
      case '"': {
        const std::size_t begin = i;
        for (++i; i < text.size() && text[i] != '"'; ++i) i += text[i] == '\\';
        cost.characters += i - begin;
        break;
      }
      case '[':
      case '{':
        if (++depth > kMaxDepth) throw Error(path, "the JSON is nested more than " + std::to_string(kMaxDepth) + " deep");
        ++cost.containers;
        ++cost.values;
        break;
      case ']':
      case '}': --depth; break;
      case ',': ++cost.values; break;
      case ':': ++cost.members; break;
      default: break;
    }
  }
  return cost;
}

// The JSON may take this fraction (one in kJsonShare) of the memory that a file may take. In any meaningful file the described data is
// larger.
constexpr std::uint64_t kJsonShare = 8;

nlohmann::json parse_json(std::string_view text, const std::string& path, Budget& budget) {
  const std::uint64_t bytes = judge_json(text, path).bytes(), most = budget.limits().memory / kJsonShare;
  if (bytes > most)
    throw Error(path,
                "its JSON would take about " + readable_bytes(bytes) + " of memory; it may take " + readable_bytes(most) +
                    ", an eighth of what the file may",
                "raise the limit with --max-memory");
  budget.take_memory(path, "its JSON", bytes);
  try {
    return nlohmann::json::parse(text);
  } catch (const nlohmann::json::exception& e) {
    // The library's message gives line and column after its prefix "[json.exception...] ".
    std::string what = e.what();
    if (const auto end = what.find("] "); end != std::string::npos) what = what.substr(end + 2);
    // The message may quote bytes of a binary file, so only printable characters stay.
    for (char& c : what)
      if (static_cast<unsigned char>(c) < 32 || static_cast<unsigned char>(c) > 126) c = '?';
    throw Error(path, "not valid JSON: " + what, "is this a glTF file?");
  }
}

bool is_glb(std::span<const std::uint8_t> file) { return file.size() >= 4 && std::memcmp(file.data(), "glTF", 4) == 0; }

GltfContainer split_glb(std::span<const std::uint8_t> file, const std::string& path) {
  const char* hint = "the file may be truncated; export it again";
  if (file.size() < 20) throw Error(path, "header: a .glb has at least 20 bytes, here are " + std::to_string(file.size()), hint);
  const std::uint32_t version = little_endian_32(file.data() + 4);
  if (version != 2)
    throw Error(path, "header: version " + std::to_string(version) + " of the format, only 2 is read", "convert it to glTF 2.0");
  const std::uint32_t length = little_endian_32(file.data() + 8);
  if (length > file.size() || length < 20)
    throw Error(path, "header: length " + std::to_string(length) + ", the file has " + std::to_string(file.size()) + " bytes", hint);

  GltfContainer container;
  std::size_t at = 12;
  for (int chunk = 0; at < length; ++chunk) {
    const std::string place = path + ": chunk " + std::to_string(chunk);
    if (length - at < 8) throw Error(place, "the header is cut off", hint);
    const std::uint32_t size = little_endian_32(file.data() + at);
    const std::uint32_t type = little_endian_32(file.data() + at + 4);
    at += 8;
    if (size > length - at)
      throw Error(place, "claims " + std::to_string(size) + " bytes, " + std::to_string(length - at) + " are left", hint);
    constexpr std::uint32_t kJson = 0x4E4F534A, kBinary = 0x004E4942;
    if (chunk == 0) {
      if (type != kJson) throw Error(place, "the first chunk must be JSON", hint);
      container.json = {reinterpret_cast<const char*>(file.data()) + at, size};
    } else if (type == kBinary && !container.binary) {
      container.binary = std::span(file.data() + at, size);
    }
    at += size;
  }
  return container;
}

int hex_digit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return -1;
}

std::string percent_decoded(std::string_view text) {
  std::string result;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '%' && i + 2 < text.size() && hex_digit(text[i + 1]) >= 0 && hex_digit(text[i + 2]) >= 0) {
      result += static_cast<char>(hex_digit(text[i + 1]) * 16 + hex_digit(text[i + 2]));
      i += 2;
    } else {
      result += text[i];
    }
  }
  return result;
}

int base64_digit(char c) {
  if (c >= 'A' && c <= 'Z') return c - 'A';
  if (c >= 'a' && c <= 'z') return c - 'a' + 26;
  if (c >= '0' && c <= '9') return c - '0' + 52;
  if (c == '+' || c == '-') return 62;
  if (c == '/' || c == '_') return 63;
  return -1;
}

Bytes base64_decoded(std::string_view text, const std::string& place) {
  while (!text.empty() && text.back() == '=') text.remove_suffix(1);
  if (text.size() % 4 == 1) throw Error(place, "the base64 data are cut off");
  Bytes bytes;
  bytes.reserve(text.size() * 3 / 4);
  std::uint32_t bits = 0;
  int held = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const int digit = base64_digit(text[i]);
    if (digit < 0) throw Error(place, "not base64: character " + std::to_string(i) + " of the data");
    bits = (bits << 6 | static_cast<std::uint32_t>(digit)) & 0xFFFFFF;
    held += 6;
    if (held >= 8) {
      held -= 8;
      bytes.push_back(static_cast<std::uint8_t>(bits >> held));
    }
  }
  return bytes;
}

void read_buffers(GltfDocument& document, std::optional<std::span<const std::uint8_t>> binary) {
  for (const JsonCursor& buffer : document.root().elements("buffers")) {
    const auto claimed = static_cast<std::size_t>(buffer.at("byteLength").as_integer(1, std::int64_t{1} << 53));
    std::span<const std::uint8_t> bytes;
    if (const auto uri = buffer.find("uri")) {
      bytes = read_uri(document, *uri);
    } else {
      if (!document.buffers.empty() || !binary)
        buffer.fail("\"uri\" is missing", "only the first buffer of a .glb may take the binary chunk");
      bytes = *binary;
    }
    if (bytes.size() < claimed)
      buffer.fail("byteLength is " + std::to_string(claimed) + ", its data have " + std::to_string(bytes.size()),
                  "the data may be truncated; export the file again");
    document.buffers.push_back(bytes.first(claimed));
  }
}

void check_version(const JsonCursor& root) {
  const JsonCursor asset = root.at("asset");
  const std::string version = asset.at("version").as_text();
  if (version.substr(0, 2) != "2.") asset.at("version").fail("glTF " + version + ", only 2.x is read", "convert it to glTF 2.0");
}

}  // namespace

std::size_t GltfDocument::count(const char* array) const {
  const auto it = json.find(array);
  return it != json.end() && it->is_array() ? it->size() : 0;
}

JsonCursor GltfDocument::object(const char* array, int index) const {
  return {json[array][static_cast<std::size_t>(index)], path + ": " + array + "[" + std::to_string(index) + "]"};
}

std::span<const std::uint8_t> read_uri(const GltfDocument& document, const JsonCursor& uri) {
  const std::string text = uri.as_text();
  GltfSources& sources = *document.sources;
  if (text.starts_with("data:")) {
    const auto comma = text.find(',');
    if (comma == std::string::npos || !std::string_view(text).substr(0, comma).ends_with(";base64"))
      uri.fail("a data URI must be \"data:...;base64,...\"");
    sources.budget.take_memory(uri.place(), "its decoded bytes", text.size() * 3 / 4);
    return sources.decoded.emplace_back(base64_decoded(std::string_view(text).substr(comma + 1), uri.place()));
  }
  if (text.find("://") != std::string::npos) uri.fail("files from the network are not read", "put the file beside the scene");
  const std::string name = percent_decoded(text);
  if (name.empty() || name.find('\0') != std::string::npos) uri.fail("is not a file name");
  const std::string path = (std::filesystem::path(document.path).parent_path() / name).lexically_normal().string();
  const auto known = sources.files.find(path);
  if (known != sources.files.end()) return known->second;
  return sources.files.emplace(path, read_file(path, uri.place(), sources.budget)).first->second;
}

std::span<const std::uint8_t> view_bytes(const GltfDocument& document, int buffer_view) {
  const JsonCursor view = document.object("bufferViews", buffer_view);
  constexpr std::int64_t kMax = std::int64_t{1} << 53;
  const int buffer = view.at("buffer").as_index(document.buffers.size(), "buffer");
  const auto offset = static_cast<std::size_t>(view.integer("byteOffset", 0, 0, kMax));
  const auto length = static_cast<std::size_t>(view.at("byteLength").as_integer(1, kMax));
  const std::span<const std::uint8_t> bytes = document.buffers[static_cast<std::size_t>(buffer)];
  if (offset > bytes.size() || length > bytes.size() - offset)
    view.fail("bytes " + std::to_string(offset) + " to " + std::to_string(offset + length) + " of buffer " + std::to_string(buffer) +
                  ", which has " + std::to_string(bytes.size()),
              "the file is broken; export it again");
  return bytes.subspan(offset, length);
}

GltfContainer gltf_container(std::span<const std::uint8_t> file, const std::string& path) {
  if (file.empty()) throw Error(path, "the file is empty");
  if (is_glb(file)) return split_glb(file, path);
  if (path.ends_with(".glb")) throw Error(path, "does not begin with \"glTF\"", "this is not a .glb file");
  return {{reinterpret_cast<const char*>(file.data()), file.size()}, {}};
}

namespace {

GltfDocument checked(nlohmann::json json, std::optional<std::span<const std::uint8_t>> binary, const std::string& path, Budget& budget) {
  GltfDocument document;
  document.path = path;
  document.sources = std::make_unique<GltfSources>(GltfSources{budget});
  document.json = std::move(json);
  const JsonCursor root = document.root();
  if (!document.json.is_object()) root.fail("the document must be a JSON object");
  check_version(root);
  for (const char* array : {"accessors", "animations", "buffers", "bufferViews", "cameras", "images", "materials", "meshes", "nodes",
                            "samplers", "scenes", "skins", "textures"})
    for (const JsonCursor& element : root.elements(array)) element.text("name", "");  // must be objects with string names
  check_required_extensions(root);
  read_buffers(document, binary);
  return document;
}

}  // namespace

GltfDocument read_gltf(std::span<const std::uint8_t> file, const std::string& path, Budget& budget) {
  const GltfContainer container = gltf_container(file, path);
  return checked(parse_json(container.json, path, budget), container.binary, path, budget);
}

GltfDocument document_of(const GltfFile& file, Budget& budget) {
  std::optional<std::span<const std::uint8_t>> binary;
  if (file.binary) binary = std::span<const std::uint8_t>(*file.binary);
  return checked(nlohmann::json(file.json), binary, file.path, budget);
}

}  // namespace steradian::scene
