// GltfDocument, and the extensions that a document uses.
#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/files.h"
#include "scene/json_cursor.h"
#include "scene/warnings.h"
#include "steradian/load_scene.h"

namespace steradian::scene {

// Facts that a glTF file states about its extensions. They are read before everything else.

// Throws Error for an extension that the file requires and that is not supported.
void check_required_extensions(const JsonCursor& root);

// Facts as the file states them. Extensions that it uses and that are not supported go to the warnings.
FileFacts read_file_facts(const JsonCursor& root, Warnings& warnings);

// GltfDocument: a parsed .gltf or .glb file: its JSON and the bytes of its buffers. Every size is checked against the bytes that are there
// before anything is allocated for it.

// The bytes of a document outside the file itself: external files, each read once however often it is named, and decoded texts. Also the
// remaining budget for everything that the document allocates.
struct GltfSources {
  Budget& budget;
  std::map<std::string, Bytes> files{};
  std::deque<Bytes> decoded{};
};

struct GltfDocument {
  std::string path;
  nlohmann::json json;
  std::vector<std::span<const std::uint8_t>> buffers;  // each as long as its byteLength
  std::unique_ptr<GltfSources> sources;

  Budget& budget() const { return sources->budget; }

  JsonCursor root() const { return {json, path}; }
  std::size_t count(const char* array) const;  // size of a top-level array
  JsonCursor object(const char* array, int index) const;
};

// The two parts of a file: its JSON, and a .glb's binary chunk if it has one.
struct GltfContainer {
  std::string_view json;
  std::optional<std::span<const std::uint8_t>> binary;
};
GltfContainer gltf_container(std::span<const std::uint8_t> file, const std::string& path);

// path: the path for messages, to which the paths of other files are relative. The document points into `file`, which must outlive it.
GltfDocument read_gltf(std::span<const std::uint8_t> file, const std::string& path, Budget& budget);

// The bytes of a bufferView.
std::span<const std::uint8_t> view_bytes(const GltfDocument& document, int buffer_view);

// The bytes of a "uri": a data URI or a file beside the document. They live as long as the document.
std::span<const std::uint8_t> read_uri(const GltfDocument& document, const JsonCursor& uri);

}  // namespace steradian::scene
