// A scene as the shaders that find surfaces read it (shaders/surface_layout.glsl): geometry, materials, pyramids of textures.
#pragma once

#include <string>
#include <vector>

#include "core/mip_maps.h"
#include "render/vulkan/kept_buffer.h"
#include "steradian/scene.h"

namespace steradian::vulkan {

// Why the shaders do not find this scene's surfaces; empty: they do, but those of some materials.
std::string what_keeps_on_host(const Scene& scene, const DeviceInfo& device);
// Those materials, a sentence each: tiles that show one are the host's.
std::vector<std::string> materials_for_host(const Scene& scene);

class SceneBuffers {
 public:
  // The device must stay. Nothing is there yet.
  explicit SceneBuffers(const Device& device);

  // Become those of a scene that nothing keeps on the host; what has changed of it is written. Computes pyramids that are not there.
  void follow(const Scene& scene, const MipMaps& maps);

  std::size_t triangle_count() const { return triangle_count_; }
  const Buffer& vertices() const { return vertices_.get(); }
  const Buffer& triangles() const { return triangles_.get(); }
  const Buffer& materials() const { return materials_.get(); }
  const Buffer& texels() const { return texels_.get(); }
  const Buffer& tables() const { return tables_.get(); }
  // Whether some surface that the shaders find has what shaders/layers.glsl is about, or is unlit.
  bool has_layers() const { return has_layers_; }

 private:
  std::size_t triangle_count_ = 0;
  bool has_layers_ = false;
  KeptBuffer vertices_, triangles_, materials_, texels_, tables_;
  std::vector<std::shared_ptr<MipMaps::Pyramid>> pyramids_;  // that the texels are of
};

}  // namespace steradian::vulkan
