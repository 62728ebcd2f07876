// GltfFile: a .gltf or .glb file as it stands, to be changed and written again: what a change does not touch keeps its place and its value.
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include <nlohmann/json.hpp>

#include "core/read_file.h"
#include "scene/gltf_document.h"
#include "steradian/load_scene.h"

namespace steradian::scene {

using Json = nlohmann::ordered_json;

struct GltfFile {
  std::string path;  // that it was read from: other files are relative to it
  Json json;
  std::shared_ptr<const Bytes> binary;  // a .glb's second chunk; null: none. Copies of a file share it
};

// Throws Error as load_scene does, for what is no glTF file and for other files that are not there.
GltfFile read_gltf_file(const std::string& path, const Limits& limits = {});

// The same for the bytes of such a file. path: for messages, and the place that other files are relative to.
GltfFile gltf_file_from_memory(std::string_view bytes, const std::string& path, const Limits& limits = {});

// As read_gltf makes it of the file's bytes, without writing them out first. It points into file.binary.
GltfDocument document_of(const GltfFile& file, Budget& budget);

// As steradian::load_scene of the file's bytes.
LoadedScene load_scene(const GltfFile& file, const LoadOptions& options = {});

// As load_scene_from_memory takes it, with file.path for the files beside it.
std::string glb_bytes(const GltfFile& file);

// As data URIs have it.
std::string base64(const Bytes& bytes);

// By the name's ending: a .gltf holds the binary chunk as text. Names of other files are changed to be relative to the new place.
void write_gltf_file(const GltfFile& file, const std::string& path);

}  // namespace steradian::scene
