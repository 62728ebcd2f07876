#include "window/widget_painter.h"

#include <imgui.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstring>
#include <string_view>

#include "device/vulkan/buffer_handles.h"
#include "device/vulkan/shader_code.h"

namespace steradian::view {
namespace {

using Stage = vk::PipelineStageFlagBits;
using Access = vk::AccessFlagBits;
using Layout = vk::ImageLayout;

// Layout as in widgets.vert: from Dear ImGui's points to -1 to 1.
struct WidgetView {
  std::array<float, 2> scale, origin;
};

vulkan::ShaderCode shader(std::string_view name) {
#include "steradian_window_shaders.inc"
  throw Error("Vulkan", "this build has no shader " + std::string(name));
}

vk::raii::Pipeline make_pipeline(const vulkan::Device::Handles& d, vk::PipelineLayout layout, vk::RenderPass pass) {
  const vk::raii::ShaderModule vertex = vulkan::module_of(d.device, shader("widgets.vert").modules.front().words),
                               fragment = vulkan::module_of(d.device, shader("widgets.frag").modules.front().words);
  const vk::PipelineShaderStageCreateInfo stages[] = {{{}, vk::ShaderStageFlagBits::eVertex, *vertex, "main"},
                                                      {{}, vk::ShaderStageFlagBits::eFragment, *fragment, "main"}};
  const vk::VertexInputBindingDescription vertices(0, sizeof(ImDrawVert), vk::VertexInputRate::eVertex);
  const vk::VertexInputAttributeDescription attributes[] = {{0, 0, vk::Format::eR32G32Sfloat, offsetof(ImDrawVert, pos)},
                                                            {1, 0, vk::Format::eR32G32Sfloat, offsetof(ImDrawVert, uv)},
                                                            {2, 0, vk::Format::eR8G8B8A8Unorm, offsetof(ImDrawVert, col)}};
  const vk::PipelineVertexInputStateCreateInfo input({}, vertices, attributes);
  const vk::PipelineInputAssemblyStateCreateInfo assembly({}, vk::PrimitiveTopology::eTriangleList);
  const vk::PipelineViewportStateCreateInfo viewports({}, 1, nullptr, 1, nullptr);
  const vk::DynamicState of_a_window[] = {vk::DynamicState::eViewport, vk::DynamicState::eScissor};
  const vk::PipelineDynamicStateCreateInfo dynamic({}, of_a_window);
  vk::PipelineRasterizationStateCreateInfo raster;  // both sides
  raster.lineWidth = 1;
  const vk::PipelineMultisampleStateCreateInfo samples;
  using Factor = vk::BlendFactor;
  using Write = vk::ColorComponentFlagBits;
  const vk::PipelineColorBlendAttachmentState over(VK_TRUE, Factor::eSrcAlpha, Factor::eOneMinusSrcAlpha, vk::BlendOp::eAdd, Factor::eOne,
                                                   Factor::eOneMinusSrcAlpha, vk::BlendOp::eAdd,
                                                   Write::eR | Write::eG | Write::eB | Write::eA);
  const vk::PipelineColorBlendStateCreateInfo blends({}, VK_FALSE, vk::LogicOp::eCopy, over);
  return d.device.createGraphicsPipeline(
      d.pipeline_cache,
      {{}, stages, &input, &assembly, nullptr, &viewports, &raster, &samples, nullptr, &blends, &dynamic, layout, pass, 0});
}

template <class Visit>  // (list, command)
void for_each_command(const ImDrawData& data, Visit visit) {
  for (int i = 0; i < data.CmdListsCount; ++i)
    for (const ImDrawCmd& command : data.CmdLists[i]->CmdBuffer)
      if (command.UserCallback == nullptr) visit(*data.CmdLists[i], command);
}

// The pixels that a command may draw to.
vk::Rect2D clip_of(const ImDrawData& data, const ImDrawCmd& command, vk::Extent2D size) {
  const auto pixel = [](float at, float from, float scale, std::uint32_t most) {
    return static_cast<int>(std::clamp((at - from) * scale, 0.0f, static_cast<float>(most)));
  };
  const ImVec2 from = data.DisplayPos, scale = data.FramebufferScale;
  const int left = pixel(command.ClipRect.x, from.x, scale.x, size.width), top = pixel(command.ClipRect.y, from.y, scale.y, size.height);
  const int right = pixel(command.ClipRect.z, from.x, scale.x, size.width);
  const int bottom = pixel(command.ClipRect.w, from.y, scale.y, size.height);
  return {{left, top}, vulkan::extent_of(std::max(right - left, 0), std::max(bottom - top, 0))};
}

}  // namespace

WidgetPainter::WidgetPainter(const vulkan::Device& device, vk::RenderPass pass) : device_(device), d_(device.handles()), vertices_(device) {
  vk::SamplerCreateInfo linear({}, vk::Filter::eLinear, vk::Filter::eLinear);
  linear.addressModeU = linear.addressModeV = vk::SamplerAddressMode::eClampToEdge;
  sampler_ = d_.device.createSampler(linear);
  const vk::DescriptorSetLayoutBinding texture(0, vk::DescriptorType::eCombinedImageSampler, vk::ShaderStageFlagBits::eFragment, *sampler_);
  set_layout_ = d_.device.createDescriptorSetLayout({{}, texture});
  const vk::PushConstantRange push(vk::ShaderStageFlagBits::eVertex, 0, sizeof(WidgetView));
  layout_ = d_.device.createPipelineLayout({{}, *set_layout_, push});
  pipeline_ = make_pipeline(d_, *layout_, pass);
  const vk::DescriptorPoolSize sets(vk::DescriptorType::eCombinedImageSampler, 2);
  pool_ = d_.device.createDescriptorPool({vk::DescriptorPoolCreateFlagBits::eFreeDescriptorSet, 2, sets});
  for (Texture& t : textures_) t.set = std::move(d_.device.allocateDescriptorSets({*pool_, *set_layout_}).front());

  unsigned char* rgba = nullptr;
  int width = 0, height = 0;
  ImFontAtlas& fonts = *ImGui::GetIO().Fonts;
  fonts.GetTexDataAsRGBA32(&rgba, &width, &height);
  write(textures_[0], width, height, rgba);
  fonts.SetTexID(&textures_[0]);
}

void WidgetPainter::write(Texture& texture, int width, int height, const std::uint8_t* rgba) {
  const std::size_t bytes = std::size_t{4} * static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  if (width != texture.width || height != texture.height) {
    texture.width = texture.height = 0;
    texture.picture = {};
    texture.picture =
        make_picture(d_, vulkan::extent_of(width, height), vk::Format::eR8G8B8A8Unorm,
                     vk::ImageUsageFlagBits::eSampled | vk::ImageUsageFlagBits::eTransferDst, vk::ImageAspectFlagBits::eColor);
    texture.texels.emplace(device_, bytes, vulkan::BufferUse::host_writes);
    const vk::DescriptorImageInfo view(nullptr, *texture.picture.view, Layout::eShaderReadOnlyOptimal);
    d_.device.updateDescriptorSets(vk::WriteDescriptorSet(*texture.set, 0, 0, vk::DescriptorType::eCombinedImageSampler, view), nullptr);
    texture.width = width;
    texture.height = height;
  }
  texture.texels->write(rgba, bytes);
  texture.written = true;
}

void WidgetPainter::prepare(const vk::raii::CommandBuffer& commands, const ImDrawData& data) {
  for (Texture& t : textures_) {
    if (!std::exchange(t.written, false)) continue;
    const auto change = [&](Stage from_stage, Stage to_stage, Access from_access, Access to_access, Layout from, Layout to) {
      commands.pipelineBarrier(from_stage, to_stage, {}, nullptr, nullptr,
                               vk::ImageMemoryBarrier(from_access, to_access, from, to, VK_QUEUE_FAMILY_IGNORED, VK_QUEUE_FAMILY_IGNORED,
                                                      *t.picture.image, {vk::ImageAspectFlagBits::eColor, 0, 1, 0, 1}));
    };
    change(Stage::eFragmentShader, Stage::eTransfer, {}, Access::eTransferWrite, Layout::eUndefined, Layout::eTransferDstOptimal);
    const vk::BufferImageCopy all(0, 0, 0, {vk::ImageAspectFlagBits::eColor, 0, 0, 1}, {0, 0, 0},
                                  vk::Extent3D(vulkan::extent_of(t.width, t.height), 1));
    commands.copyBufferToImage(*t.texels->handles().buffer, *t.picture.image, Layout::eTransferDstOptimal, all);
    change(Stage::eTransfer, Stage::eFragmentShader, Access::eTransferWrite, Access::eShaderRead, Layout::eTransferDstOptimal,
           Layout::eShaderReadOnlyOptimal);
  }
  const std::size_t bytes = static_cast<std::size_t>(std::max(data.TotalIdxCount, 0)) * sizeof(ImDrawVert);
  auto* to = static_cast<ImDrawVert*>(vertices_.fit_with_room(bytes, "the triangles of the window").mapped());
  for_each_command(data, [&](const ImDrawList& list, const ImDrawCmd& command) {
    const ImDrawIdx* indices = list.IdxBuffer.Data + command.IdxOffset;
    const ImDrawVert* vertices = list.VtxBuffer.Data + command.VtxOffset;
    for (unsigned i = 0; i < command.ElemCount; ++i) *to++ = vertices[indices[i]];
  });
}

void WidgetPainter::draw(const vk::raii::CommandBuffer& commands, const ImDrawData& data, vk::Extent2D size) const {
  commands.bindPipeline(vk::PipelineBindPoint::eGraphics, *pipeline_);
  commands.bindVertexBuffers(0, *vertices_.get().handles().buffer, vk::DeviceSize{0});
  commands.setViewport(0, vk::Viewport(0, 0, static_cast<float>(size.width), static_cast<float>(size.height), 0, 1));
  commands.pushConstants<WidgetView>(*layout_, vk::ShaderStageFlagBits::eVertex, 0,
                                     WidgetView{{2 / data.DisplaySize.x, 2 / data.DisplaySize.y}, {data.DisplayPos.x, data.DisplayPos.y}});
  std::uint32_t first = 0;
  for_each_command(data, [&](const ImDrawList&, const ImDrawCmd& command) {
    const auto& texture = *static_cast<const Texture*>(command.GetTexID());
    commands.setScissor(0, clip_of(data, command, size));
    commands.bindDescriptorSets(vk::PipelineBindPoint::eGraphics, *layout_, 0, *texture.set, nullptr);
    commands.draw(command.ElemCount, 1, first, 0);
    first += command.ElemCount;
  });
}

}  // namespace steradian::view
