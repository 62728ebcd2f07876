#include "scene/gltf/gltf_extensions.h"

#include <algorithm>

namespace steradian::scene {
namespace {

constexpr const char* kSupported[] = {"KHR_animation_pointer",   "EXT_lights_area",        "EXT_lights_ies",
                                      "EXT_lights_image_based",  "KHR_lights_punctual",    "KHR_materials_anisotropy",
                                      "KHR_materials_clearcoat", "KHR_materials_sheen",    "KHR_materials_emissive_strength",
                                      "KHR_materials_ior",       "KHR_materials_specular", "KHR_materials_transmission",
                                      "KHR_materials_unlit",     "KHR_mesh_quantization",  "KHR_texture_transform"};

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

}  // namespace steradian::scene
