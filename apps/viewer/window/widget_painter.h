// WidgetPainter: draws the lists of triangles that Dear ImGui renders, by a Vulkan device. Debian's own back end of Dear ImGui 1.86 knows
// no texture but that of its fonts, and makes a program refuse to start without the Vulkan loader.
#pragma once

#include <optional>

#include "device/vulkan/buffer.h"
#include "device/vulkan/picture2d.h"

struct ImDrawData;

namespace steradian::view {

// Its address is Dear ImGui's ImTextureID.
struct Texture {
  int width = 0, height = 0;
  vulkan::Picture2d picture;
  std::optional<vulkan::Buffer> texels;  // on the host
  vk::raii::DescriptorSet set = nullptr;
  bool written = false;  // the texels are not yet in the picture
};

class WidgetPainter {
 public:
  // The device must outlive this object.
  WidgetPainter(const vulkan::Device& device, vk::RenderPass pass);

  Texture& picture() { return textures_[1]; }
  // Gives a texture these texels, four bytes each. Nothing may be using it.
  void write(Texture& texture, int width, int height, const std::uint8_t* rgba);
  // Records copies of the texels that were written, before the pass. Nothing may be using the vertices, which become those of the data.
  void prepare(const vk::raii::CommandBuffer& commands, const ImDrawData& data);
  // Records the triangles, in the pass.
  void draw(const vk::raii::CommandBuffer& commands, const ImDrawData& data, vk::Extent2D size) const;

 private:
  const vulkan::Device& device_;
  const vulkan::Device::Handles& d_;
  vk::raii::Sampler sampler_ = nullptr;
  vk::raii::DescriptorSetLayout set_layout_ = nullptr;
  vk::raii::PipelineLayout layout_ = nullptr;
  vk::raii::Pipeline pipeline_ = nullptr;
  vk::raii::DescriptorPool pool_ = nullptr;
  vulkan::KeptBuffer vertices_;  // three a triangle
  Texture textures_[2];          // the fonts, the picture
};

}  // namespace steradian::view
