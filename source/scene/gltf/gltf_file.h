// GltfFile: a .gltf or .glb file that can be changed and written again. Parts that a change does not touch keep their place and value.
#pragma once

#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "core/files.h"
#include "scene/gltf/gltf_document.h"
#include "steradian/load_scene.h"

namespace steradian::scene {

using Json = nlohmann::ordered_json;

struct GltfFile {
  std::string path;  // path it was read from; other files are relative to it
  Json json;
  std::shared_ptr<const Bytes> binary;  // a .glb's second chunk; null: none. Copies of a file share it
};

// Throws Error as load_scene does, for files that are not glTF and for missing external files.
GltfFile read_gltf_file(const std::string& path, const Limits& limits = {});

// The same for the bytes of such a file. path: the path for messages, to which the paths of other files are relative.
GltfFile gltf_file_from_memory(std::string_view bytes, const std::string& path, const Limits& limits = {});

// The document that read_gltf would make of the file's bytes, without writing them out first. It points into file.binary.
GltfDocument document_of(const GltfFile& file, Budget& budget);

// Equals steradian::load_scene of the file's bytes.
LoadedScene load_scene(const GltfFile& file, const LoadOptions& options = {});

// The bytes that load_scene_from_memory takes, with file.path for external files.
std::string glb_bytes(const GltfFile& file);

// Base64 text as in data URIs.
std::string base64(const Bytes& bytes);

// Chooses the format by the name's ending: a .gltf holds the binary chunk as text. Names of other files are made relative to the new place.
void write_gltf_file(const GltfFile& file, const std::string& path);

}  // namespace steradian::scene
