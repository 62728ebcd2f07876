// NewData: data, pictures and textures that are added to a glTF file.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "core/files.h"
#include "scene/gltf/gltf_file.h"

namespace steradian::bake {

inline constexpr int kFloat = 5126, kUnsignedShort = 5123, kUnsignedInt = 5125;  // types of components

inline scene::Json& array_of(scene::Json& json, const char* name) {
  if (!json.contains(name)) json[name] = scene::Json::array();
  return json[name];
}

// Data for a file, in a buffer of its own or behind the binary chunk of a .glb.
class NewData {
 public:
  explicit NewData(scene::GltfFile& file) : file_(file), joined_(file.binary != nullptr) {
    if (joined_) bytes_ = *file.binary;
    buffer_ = joined_ ? 0 : array_of(file.json, "buffers").size();
  }

  std::size_t add_view(const void* data, std::size_t size) {
    bytes_.resize((bytes_.size() + 3) / 4 * 4);
    const std::size_t first = bytes_.size();
    const auto* from = static_cast<const std::uint8_t*>(data);
    bytes_.insert(bytes_.end(), from, from + size);
    scene::Json& views = array_of(file_.json, "bufferViews");
    views.push_back({{"buffer", buffer_}, {"byteOffset", first}, {"byteLength", size}});
    return views.size() - 1;
  }
  std::size_t add_accessor(std::size_t view, int type_of_component, std::size_t count, const std::string& type, bool normalized = false) {
    scene::Json& accessors = array_of(file_.json, "accessors");
    scene::Json accessor = {{"bufferView", view}, {"componentType", type_of_component}, {"count", count}, {"type", type}};
    if (normalized) accessor["normalized"] = true;
    accessors.push_back(std::move(accessor));
    return accessors.size() - 1;
  }
  void set_bounds(std::size_t accessor, const std::vector<float>& low, const std::vector<float>& high) {
    file_.json["accessors"][accessor]["min"] = low;
    file_.json["accessors"][accessor]["max"] = high;
  }
  std::size_t add_floats(const std::vector<float>& values, int components) {
    const char* types[] = {"SCALAR", "VEC2", "VEC3", "VEC4"};
    const std::size_t view = add_view(values.data(), values.size() * sizeof(float));
    return add_accessor(view, kFloat, values.size() / static_cast<std::size_t>(components), types[components - 1]);
  }

  // A picture, and a texture that shows it without smaller copies, which would mix charts. Returns the texture's number.
  std::size_t add_picture(const std::string& name, const std::string& png) {
    const std::size_t view = add_view(png.data(), png.size());
    scene::Json& images = array_of(file_.json, "images");
    images.push_back({{"name", name}, {"bufferView", view}, {"mimeType", "image/png"}});
    scene::Json& samplers = array_of(file_.json, "samplers");
    constexpr int kLinear = 9729, kClamp = 33071;
    samplers.push_back({{"magFilter", kLinear}, {"minFilter", kLinear}, {"wrapS", kClamp}, {"wrapT", kClamp}});
    scene::Json& textures = array_of(file_.json, "textures");
    textures.push_back({{"name", name}, {"source", images.size() - 1}, {"sampler", samplers.size() - 1}});
    return textures.size() - 1;
  }

  void finish() {
    if (joined_) {
      file_.json["buffers"][0]["byteLength"] = bytes_.size();
      file_.binary = std::make_shared<const Bytes>(std::move(bytes_));
    } else {
      array_of(file_.json, "buffers")
          .push_back({{"byteLength", bytes_.size()}, {"uri", "data:application/octet-stream;base64," + scene::base64(bytes_)}});
    }
  }

 private:
  scene::GltfFile& file_;
  const bool joined_;
  Bytes bytes_;
  std::size_t buffer_ = 0;
};

}  // namespace steradian::bake
