// A scene in the layout of the shaders that find surfaces (shaders/surface/surface_layout.glsl): geometry, materials, pyramids of textures.
#pragma once

#include <string>
#include <vector>

#include "core/mip_maps.h"
#include "device/vulkan/buffer.h"
#include "steradian/scene.h"

namespace steradian::vulkan {

// Reason why the shaders do not find this scene's surfaces; empty: they do, except for those of some materials.
std::string what_keeps_on_host(const Scene& scene, const DeviceInfo& device);
// One sentence for each of these materials: the host finds the tiles that show one.
std::vector<std::string> materials_for_host(const Scene& scene);

class SceneBuffers {
 public:
  // The device must outlive this object. The buffers are not filled yet.
  explicit SceneBuffers(const Device& device);

  // Updates the buffers to a scene that nothing keeps on the host; writes only changes. Computes missing pyramids.
  void follow(const Scene& scene, const MipMaps& maps);

  std::size_t triangle_count() const { return triangle_count_; }
  const Buffer& vertices() const { return vertices_.get(); }
  const Buffer& triangles() const { return triangles_.get(); }
  const Buffer& materials() const { return materials_.get(); }
  const Buffer& texels() const { return texels_.get(); }
  const Buffer& tables() const { return tables_.get(); }
  // Returns true if some surface that the shaders find has the features of shaders/surface/layers.glsl, or is unlit.
  bool has_layers() const { return has_layers_; }

 private:
  std::size_t triangle_count_ = 0;
  bool has_layers_ = false;
  KeptBuffer vertices_, triangles_, materials_, texels_, tables_;
  std::vector<std::shared_ptr<MipMaps::Pyramid>> pyramids_;  // pyramids of the texels
};

}  // namespace steradian::vulkan
