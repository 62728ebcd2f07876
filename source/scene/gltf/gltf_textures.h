// Textures of a glTF file: references checked, images decoded when first used.
#pragma once

#include <vector>

#include "scene/gltf/gltf_document.h"
#include "scene/warnings.h"
#include "steradian/load_scene.h"
#include "steradian/texture.h"

namespace steradian::scene {

class GltfTextures {
 public:
  // kept: cache of pictures between readings, used and filled by this one; may be null.
  GltfTextures(const GltfDocument& document, std::vector<Image>& images, Warnings& warnings, std::shared_ptr<DecodedPictures> kept = {});

  // The texture that member `key` of `owner` refers to. It is not present() if there is none or its format is not supported.
  TextureUse use(const JsonCursor& owner, const char* key, ColorSpace space);

  // The index into images() of the picture that a cursor's number refers to; -1: its format is not supported.
  int image(const JsonCursor& index) { return scene_image(index.as_index(document_.count("images"), "image")); }
  const std::vector<Image>& images() const { return images_; }

  double decoding_ms() const { return decoding_ms_; }

 private:
  int scene_image(int gltf_image);
  int load_image(int gltf_image);
  void apply_sampler(TextureUse& use, const JsonCursor& sampler) const;
  void apply_transform(TextureUse& use, const JsonCursor& transform) const;

  const GltfDocument& document_;
  std::vector<Image>& images_;
  Warnings& warnings_;
  std::shared_ptr<DecodedPictures> kept_;
  std::vector<int> loaded_;  // by glTF image: index into images_, or one of the two states below
  std::size_t texels_left_;
  double decoding_ms_ = 0;
};

}  // namespace steradian::scene
