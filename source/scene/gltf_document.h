// GltfDocument: a .gltf or .glb file taken apart: its JSON and the bytes of its buffers. Every size is
// checked against the bytes that are there before anything is allocated for it.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "scene/json_cursor.h"

namespace steradian {

using Bytes = std::vector<std::uint8_t>;

struct GltfDocument {
  std::string path;
  nlohmann::json json;
  std::vector<Bytes> buffers;  // each as long as its byteLength

  JsonCursor root() const { return {json, path}; }
  std::size_t count(const char* array) const;  // of a top-level array
  JsonCursor object(const char* array, int index) const;
};

// path: for messages, and the place that other files are relative to.
GltfDocument read_gltf(std::span<const std::uint8_t> file, const std::string& path);

// The bytes of a whole file; place: for the message where they cannot be had.
Bytes read_file(const std::string& path, const std::string& place);

// The bytes of a bufferView.
std::span<const std::uint8_t> view_bytes(const GltfDocument& document, int buffer_view);

// The bytes behind a "uri": a data URI or a file beside the document.
Bytes read_uri(const GltfDocument& document, const JsonCursor& uri);

}  // namespace steradian
