#include "device/surface/visibility.h"

#include <algorithm>

#include "device/vulkan/buffer_handles.h"
#include "device/vulkan/picture2d.h"
#include "device/vulkan/shaders.h"

namespace steradian::vulkan {
namespace {

constexpr vk::Format kNumbers = vk::Format::eR32Uint, kDepths = vk::Format::eD32Sfloat;  // every device draws to both
constexpr float kNearest = 1e-6f;                                                        // in metres; nearer geometry is not drawn

// Layout as in visibility.vert.
struct Push {
  std::array<float, 4> origin, across, down, forward;
};

Push push_of(const CameraView& v, PixelPlace place) {
  // Rasters look through the middle of a pixel: the picture is moved so that the sample's position is there.
  const auto row = [&](Vec3f step, int pixels, float at) {
    const Vec3f per_pixel = step * (2 / (static_cast<float>(pixels) * dot(step, step)));
    return std::array<float, 4>{per_pixel.x, per_pixel.y, per_pixel.z,
                                -dot(v.corner, per_pixel) + 2 * (0.5f - at) / static_cast<float>(pixels) - 1};
  };
  return {{v.origin.x, v.origin.y, v.origin.z, 0},
          row(v.right, v.width, place.x),
          row(v.down, v.height, place.y),
          {v.forward.x, v.forward.y, v.forward.z, kNearest}};
}

vk::raii::RenderPass make_render_pass(const vk::raii::Device& d) {
  using Layout = vk::ImageLayout;
  const vk::AttachmentDescription attachments[] = {{{},
                                                    kNumbers,
                                                    vk::SampleCountFlagBits::e1,
                                                    vk::AttachmentLoadOp::eClear,
                                                    vk::AttachmentStoreOp::eStore,
                                                    vk::AttachmentLoadOp::eDontCare,
                                                    vk::AttachmentStoreOp::eDontCare,
                                                    Layout::eUndefined,
                                                    Layout::eTransferSrcOptimal},
                                                   {{},
                                                    kDepths,
                                                    vk::SampleCountFlagBits::e1,
                                                    vk::AttachmentLoadOp::eClear,
                                                    vk::AttachmentStoreOp::eDontCare,
                                                    vk::AttachmentLoadOp::eDontCare,
                                                    vk::AttachmentStoreOp::eDontCare,
                                                    Layout::eUndefined,
                                                    Layout::eDepthStencilAttachmentOptimal}};
  const vk::AttachmentReference numbers(0, Layout::eColorAttachmentOptimal), depths(1, Layout::eDepthStencilAttachmentOptimal);
  const vk::SubpassDescription subpass({}, vk::PipelineBindPoint::eGraphics, {}, numbers, {}, &depths);
  using Stage = vk::PipelineStageFlagBits;
  using Access = vk::AccessFlagBits;
  const vk::PipelineStageFlags tests = Stage::eEarlyFragmentTests | Stage::eLateFragmentTests;
  const vk::SubpassDependency dependencies[] = {
      // The picture may be drawn over once the last copy has read it.
      {VK_SUBPASS_EXTERNAL, 0, Stage::eTransfer | tests, Stage::eColorAttachmentOutput | tests, Access::eDepthStencilAttachmentWrite,
       Access::eColorAttachmentWrite | Access::eDepthStencilAttachmentRead | Access::eDepthStencilAttachmentWrite},
      {0, VK_SUBPASS_EXTERNAL, Stage::eColorAttachmentOutput, Stage::eTransfer, Access::eColorAttachmentWrite, Access::eTransferRead}};
  return d.createRenderPass({{}, attachments, subpass, dependencies});
}

vk::raii::Pipeline make_pipeline(const Device::Handles& d, vk::PipelineLayout layout, vk::RenderPass pass) {
  const ShaderCode codes[] = {shader("visibility.vert"), shader("visibility.frag")};
  const auto words = [&](int i) { return codes[i].modules.front().words; };
  const vk::raii::ShaderModule vertex = module_of(d.device, words(0)), fragment = module_of(d.device, words(1));
  const vk::PipelineShaderStageCreateInfo stages[] = {{{}, vk::ShaderStageFlagBits::eVertex, *vertex, "main"},
                                                      {{}, vk::ShaderStageFlagBits::eFragment, *fragment, "main"}};
  const vk::PipelineVertexInputStateCreateInfo input;  // vertices come from buffers of texels
  const vk::PipelineInputAssemblyStateCreateInfo assembly({}, vk::PrimitiveTopology::eTriangleList);
  const vk::PipelineViewportStateCreateInfo viewports({}, 1, nullptr, 1, nullptr);
  const vk::DynamicState of_a_picture[] = {vk::DynamicState::eViewport, vk::DynamicState::eScissor};
  const vk::PipelineDynamicStateCreateInfo dynamic({}, of_a_picture);
  vk::PipelineRasterizationStateCreateInfo raster;  // both sides: rays hit both
  raster.lineWidth = 1;
  const vk::PipelineMultisampleStateCreateInfo samples;
  const vk::PipelineDepthStencilStateCreateInfo depth({}, VK_TRUE, VK_TRUE, vk::CompareOp::eGreater);
  vk::PipelineColorBlendAttachmentState blend;
  blend.colorWriteMask = vk::ColorComponentFlagBits::eR;
  const vk::PipelineColorBlendStateCreateInfo blends({}, VK_FALSE, vk::LogicOp::eCopy, blend);
  const auto start = std::chrono::steady_clock::now();
  vk::raii::Pipeline made = d.device.createGraphicsPipeline(
      d.pipeline_cache,
      {d.pipeline_flags(), stages, &input, &assembly, nullptr, &viewports, &raster, &samples, &depth, &blends, &dynamic, layout, pass, 0});
  std::vector<PipelineReport> reports;
  for (int i = 0; i < 2; ++i) reports.push_back({codes[i].name, {}, words(i).size_bytes(), ms_since(start)});
  report(d, made, std::move(reports));
  return made;
}

}  // namespace

CameraView::CameraView(const CameraRays& camera, int w, int h) : width(w), height(h), origin(camera.origin()) {
  const PixelSteps steps = camera.steps(1);
  const Vec3f to_corner = camera.direction(0, 0);
  right = steps.right;
  down = steps.down;
  forward = steps.forward;
  corner = to_corner * (1 / dot(to_corner, forward));
}

struct Visibility::Handles {
  Picture2d numbers, depths;
  vk::raii::RenderPass pass = nullptr;
  vk::raii::Framebuffer frame = nullptr;
  vk::raii::DescriptorSetLayout set_layout = nullptr;
  vk::raii::PipelineLayout layout = nullptr;
  vk::raii::Pipeline pipeline = nullptr;
  vk::raii::DescriptorPool pool = nullptr;
  vk::raii::DescriptorSet set = nullptr;
  vk::raii::CommandBuffer commands = nullptr;
  vk::raii::QueryPool queries = nullptr;
};

Visibility::Visibility(const Device& device) : device_(device), seen_(device), handles_(std::make_unique<Handles>()) {
  checked(device, "prepare to draw triangles", [&] {
    const Device::Handles& d = device.handles();
    Handles& h = *handles_;
    h.pass = make_render_pass(d.device);
    std::vector<vk::DescriptorSetLayoutBinding> bindings;
    for (std::uint32_t i = 0; i < 2; ++i)
      bindings.emplace_back(i, vk::DescriptorType::eUniformTexelBuffer, 1, vk::ShaderStageFlagBits::eVertex);
    h.set_layout = d.device.createDescriptorSetLayout({{}, bindings});
    const vk::PushConstantRange push(vk::ShaderStageFlagBits::eVertex, 0, sizeof(Push));
    h.layout = d.device.createPipelineLayout({{}, *h.set_layout, push});
    h.pipeline = make_pipeline(d, *h.layout, *h.pass);
    if (device.only_compiles()) return;
    const vk::DescriptorPoolSize size(vk::DescriptorType::eUniformTexelBuffer, 2);
    h.pool = d.device.createDescriptorPool({vk::DescriptorPoolCreateFlagBits::eFreeDescriptorSet, 1, size});
    h.set = std::move(d.device.allocateDescriptorSets({*h.pool, *h.set_layout}).front());
    h.commands = std::move(d.device.allocateCommandBuffers({*d.commands, vk::CommandBufferLevel::ePrimary, 1}).front());
    if (device.info().timestamps) h.queries = d.device.createQueryPool({{}, vk::QueryType::eTimestamp, 2});
  });
}

Visibility::~Visibility() {
  std::erase(device_.handles().ahead, *handles_->commands);
  device_.handles().leave(handles_);
}

// Makes pictures as wide and as high as any so far; a corner of them is drawn to.
void Visibility::fit(int width, int height) {
  seen_.fit(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * sizeof(std::uint32_t));
  if (width <= width_ && height <= height_) return;
  const Device::Handles& d = device_.handles();
  Handles& h = *handles_;
  using Usage = vk::ImageUsageFlagBits;
  const int wide = std::max(width, width_), high = std::max(height, height_);
  const vk::Extent2D size = extent_of(wide, high);
  width_ = height_ = 0;
  h.frame = nullptr;
  h.numbers = Picture2d();
  h.depths = Picture2d();
  h.numbers = make_picture(d, size, kNumbers, Usage::eColorAttachment | Usage::eTransferSrc, vk::ImageAspectFlagBits::eColor);
  h.depths = make_picture(d, size, kDepths, Usage::eDepthStencilAttachment, vk::ImageAspectFlagBits::eDepth);
  const vk::ImageView views[] = {*h.numbers.view, *h.depths.view};
  h.frame = d.device.createFramebuffer({{}, *h.pass, views, size.width, size.height, 1});
  width_ = wide;
  height_ = high;
}

void Visibility::draw(const SceneBuffers& scene, const CameraView& view, PixelPlace place) {
  if (device_.only_compiles()) {
    seen_.fit(static_cast<std::size_t>(view.width) * static_cast<std::size_t>(view.height) * sizeof(std::uint32_t));
    return;
  }
  checked(device_, "draw triangles", [&] {
    fit(view.width, view.height);
    const Handles& h = *handles_;
    const vk::BufferView buffers[] = {*scene.vertices().handles().texels, *scene.triangles().handles().texels};
    for (std::uint32_t i = 0; i < 2; ++i)
      device_.handles().device.updateDescriptorSets(
          vk::WriteDescriptorSet(*h.set, i, 0, 1, vk::DescriptorType::eUniformTexelBuffer, nullptr, nullptr, &buffers[i]), nullptr);
    using Stage = vk::PipelineStageFlagBits;
    const bool timed = device_.info().timestamps;
    const vk::Extent2D size = extent_of(view.width, view.height);
    h.commands.begin({vk::CommandBufferUsageFlagBits::eOneTimeSubmit});
    if (timed) {
      h.commands.resetQueryPool(*h.queries, 0, 2);
      h.commands.writeTimestamp(Stage::eBottomOfPipe, *h.queries, 0);
    }
    const vk::ClearValue clear[] = {vk::ClearColorValue(std::array<std::uint32_t, 4>{}), vk::ClearDepthStencilValue(0, 0)};
    h.commands.beginRenderPass({*h.pass, *h.frame, {{0, 0}, size}, clear}, vk::SubpassContents::eInline);
    h.commands.bindPipeline(vk::PipelineBindPoint::eGraphics, *h.pipeline);
    h.commands.bindDescriptorSets(vk::PipelineBindPoint::eGraphics, *h.layout, 0, *h.set, nullptr);
    h.commands.pushConstants<Push>(*h.layout, vk::ShaderStageFlagBits::eVertex, 0, push_of(view, place));
    h.commands.setViewport(0, vk::Viewport(0, 0, static_cast<float>(view.width), static_cast<float>(view.height), 0, 1));
    h.commands.setScissor(0, vk::Rect2D({0, 0}, size));
    h.commands.draw(static_cast<std::uint32_t>(3 * scene.triangle_count()), 1, 0, 0);
    h.commands.endRenderPass();
    const vk::BufferImageCopy all(0, 0, 0, {vk::ImageAspectFlagBits::eColor, 0, 0, 1}, {0, 0, 0}, {size.width, size.height, 1});
    h.commands.copyImageToBuffer(*h.numbers.image, vk::ImageLayout::eTransferSrcOptimal, *seen_.get().handles().buffer, all);
    const vk::MemoryBarrier copied(vk::AccessFlagBits::eTransferWrite, vk::AccessFlagBits::eShaderRead | vk::AccessFlagBits::eHostRead);
    h.commands.pipelineBarrier(Stage::eTransfer, Stage::eComputeShader | Stage::eHost, {}, copied, nullptr, nullptr);
    if (timed) h.commands.writeTimestamp(Stage::eBottomOfPipe, *h.queries, 1);
    h.commands.end();
    std::vector<vk::CommandBuffer>& ahead = device_.handles().ahead;
    std::erase(ahead, *h.commands);  // an earlier drawing that no submission has taken
    ahead.push_back(*h.commands);
  });
}

double Visibility::time() const {
  if (device_.only_compiles() || !device_.info().timestamps) return 0;
  return checked(device_, "read the time of triangles", [&] { return times_between(device_, handles_->queries, 2).front(); });
}

}  // namespace steradian::vulkan
