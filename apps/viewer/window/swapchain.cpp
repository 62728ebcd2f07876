#include "window/swapchain.h"

#include <algorithm>
#include <array>

#include "device/vulkan/buffer_handles.h"

namespace steradian::view {
namespace {

using Stage = vk::PipelineStageFlagBits;
using Access = vk::AccessFlagBits;
using Layout = vk::ImageLayout;
using Usage = vk::ImageUsageFlagBits;

constexpr std::uint64_t kSecond = 1'000'000'000;  // ns
constexpr vk::ImageSubresourceRange kAll(vk::ImageAspectFlagBits::eColor, 0, 1, 0, 1);

// Colours are already encoded for the screen, so the format must not encode them again.
vk::SurfaceFormatKHR format_for(const vulkan::Device::Handles& d, const vk::raii::SurfaceKHR& surface) {
  if (!d.physical.getSurfaceSupportKHR(d.queue_family, *surface)) throw Error("Vulkan", "the device cannot present to this window");
  for (const vk::SurfaceFormatKHR& f : d.physical.getSurfaceFormatsKHR(*surface))
    if ((f.format == vk::Format::eB8G8R8A8Unorm || f.format == vk::Format::eR8G8B8A8Unorm) &&
        f.colorSpace == vk::ColorSpaceKHR::eSrgbNonlinear)
      return f;
  throw Error("Vulkan", "the window takes no pictures of 8 bits per channel");
}

vk::raii::RenderPass make_pass(const vk::raii::Device& device, vk::Format format) {
  const vk::AttachmentDescription picture({}, format, vk::SampleCountFlagBits::e1, vk::AttachmentLoadOp::eClear,
                                          vk::AttachmentStoreOp::eStore, vk::AttachmentLoadOp::eDontCare, vk::AttachmentStoreOp::eDontCare,
                                          Layout::eUndefined, Layout::ePresentSrcKHR);
  const vk::AttachmentReference color(0, Layout::eColorAttachmentOptimal);
  const vk::SubpassDescription subpass({}, vk::PipelineBindPoint::eGraphics, {}, color);
  // The picture is drawn to once the window system has given it back.
  const vk::SubpassDependency available(VK_SUBPASS_EXTERNAL, 0, Stage::eColorAttachmentOutput, Stage::eColorAttachmentOutput, {},
                                        Access::eColorAttachmentWrite);
  return device.createRenderPass({{}, picture, subpass, available});
}

// The size of a surface's pictures; a surface that leaves it open has the window's.
vk::Extent2D size_for(const vk::SurfaceCapabilitiesKHR& surface, vk::Extent2D window) {
  constexpr std::uint32_t open = 0xffffffff;
  if (surface.currentExtent.width != open) return surface.currentExtent;
  return {std::clamp(window.width, surface.minImageExtent.width, surface.maxImageExtent.width),
          std::clamp(window.height, surface.minImageExtent.height, surface.maxImageExtent.height)};
}

vk::CompositeAlphaFlagBitsKHR alpha_for(const vk::SurfaceCapabilitiesKHR& surface) {
  using Alpha = vk::CompositeAlphaFlagBitsKHR;
  for (const Alpha alpha : {Alpha::eOpaque, Alpha::eInherit, Alpha::ePreMultiplied})  // pictures are opaque
    if (surface.supportedCompositeAlpha & alpha) return alpha;
  return Alpha::ePostMultiplied;
}

}  // namespace

Swapchain::Swapchain(const vulkan::Device& device, vk::raii::SurfaceKHR surface)
    : device_(device), d_(device.handles()), surface_(std::move(surface)), format_(format_for(d_, surface_)) {
  pass_ = make_pass(d_.device, format_.format);
  available_ = d_.device.createSemaphore({});
  done_ = d_.device.createFence({vk::FenceCreateFlagBits::eSignaled});
  read_ = d_.device.createFence({});
  commands_ = std::move(d_.device.allocateCommandBuffers({*d_.commands, vk::CommandBufferLevel::ePrimary, 1}).front());
}

void Swapchain::make(vk::Extent2D window) {
  d_.device.waitIdle();
  const vk::SurfaceCapabilitiesKHR surface = d_.physical.getSurfaceCapabilitiesKHR(*surface_);
  asked_ = window;
  size_ = size_for(surface, window);
  targets_.clear();
  if (size_.width == 0 || size_.height == 0) {
    chain_ = nullptr;
    return;
  }
  const std::uint32_t most = surface.maxImageCount == 0 ? surface.minImageCount + 1 : surface.maxImageCount;
  readable_ = static_cast<bool>(surface.supportedUsageFlags & Usage::eTransferSrc);
  vk::ImageUsageFlags usage = Usage::eColorAttachment;
  if (readable_) usage |= Usage::eTransferSrc;
  const vk::raii::SwapchainKHR old = std::exchange(chain_, vk::raii::SwapchainKHR(nullptr));
  chain_ = d_.device.createSwapchainKHR({{},
                                         *surface_,
                                         std::min(surface.minImageCount + 1, most),
                                         format_.format,
                                         format_.colorSpace,
                                         size_,
                                         1,
                                         usage,
                                         vk::SharingMode::eExclusive,
                                         {},
                                         surface.currentTransform,
                                         alpha_for(surface),
                                         vk::PresentModeKHR::eFifo,
                                         VK_TRUE,
                                         *old});
  for (const VkImage image : chain_.getImages()) {
    Target t;
    t.image = image;
    t.view = d_.device.createImageView({{}, t.image, vk::ImageViewType::e2D, format_.format, {}, kAll});
    t.frame = d_.device.createFramebuffer({{}, *pass_, *t.view, size_.width, size_.height, 1});
    t.drawn = d_.device.createSemaphore({});
    targets_.push_back(std::move(t));
  }
  stale_ = false;
}

void Swapchain::wait() const {
  if (d_.device.waitForFences(*done_, VK_TRUE, 60 * kSecond) == vk::Result::eSuccess) return;
  d_.hangs = true;
  throw Error("Vulkan device '" + device_.info().name + "'", "did not draw the window within a minute");
}

bool Swapchain::acquire(vk::Extent2D window) {
  wait();
  for (int attempt = 0; attempt < 3; ++attempt) try {
      if (stale_ || window != asked_) make(window);
      if (!*chain_) return false;
      const auto [result, image] = chain_.acquireNextImage(kSecond, *available_);
      if (result != vk::Result::eSuccess && result != vk::Result::eSuboptimalKHR) return false;  // hidden windows get none
      stale_ = result == vk::Result::eSuboptimalKHR;
      acquired_ = image;
      return true;
    } catch (const vk::OutOfDateKHRError&) {  // the window's size has just changed
      stale_ = true;
    }
  return false;
}

const vk::raii::CommandBuffer& Swapchain::begin() const {
  commands_.begin({vk::CommandBufferUsageFlagBits::eOneTimeSubmit});
  return commands_;
}

void Swapchain::enter_pass() const {
  const vk::ClearValue black = vk::ClearColorValue(std::array<float, 4>{0, 0, 0, 1});
  commands_.beginRenderPass({*pass_, *targets_[*acquired_].frame, {{0, 0}, size_}, black}, vk::SubpassContents::eInline);
}

void Swapchain::submit() {
  commands_.endRenderPass();
  commands_.end();
  const vk::PipelineStageFlags stage = Stage::eColorAttachmentOutput;
  d_.device.resetFences(*done_);
  d_.queue.submit(vk::SubmitInfo(*available_, stage, *commands_, *targets_[*acquired_].drawn), *done_);
}

Display Swapchain::pixels() const {
  if (!acquired_ || !readable_) throw Error("view", "the window system does not let the window be read");
  wait();
  const std::size_t bytes = std::size_t{4} * size_.width * size_.height;
  const vulkan::Buffer copy(device_, bytes);
  const vk::Image image = targets_[*acquired_].image;
  commands_.begin({vk::CommandBufferUsageFlagBits::eOneTimeSubmit});
  const auto change = [&](Access from_access, Access to_access, Layout from, Layout to) {
    commands_.pipelineBarrier(
        Stage::eColorAttachmentOutput | Stage::eTransfer, Stage::eTransfer, {}, nullptr, nullptr,
        vk::ImageMemoryBarrier(from_access, to_access, from, to, VK_QUEUE_FAMILY_IGNORED, VK_QUEUE_FAMILY_IGNORED, image, kAll));
  };
  change(Access::eColorAttachmentWrite, Access::eTransferRead, Layout::ePresentSrcKHR, Layout::eTransferSrcOptimal);
  const vk::BufferImageCopy all(0, 0, 0, {vk::ImageAspectFlagBits::eColor, 0, 0, 1}, {0, 0, 0}, {size_.width, size_.height, 1});
  commands_.copyImageToBuffer(image, Layout::eTransferSrcOptimal, *copy.handles().buffer, all);
  change(Access::eTransferRead, {}, Layout::eTransferSrcOptimal, Layout::ePresentSrcKHR);
  commands_.pipelineBarrier(Stage::eTransfer, Stage::eHost, {}, vk::MemoryBarrier(Access::eTransferWrite, Access::eHostRead), nullptr,
                            nullptr);
  commands_.end();
  vulkan::submit_and_wait(device_, {*commands_}, read_, "reading the window");
  Display shot{static_cast<int>(size_.width), static_cast<int>(size_.height), std::vector<std::uint8_t>(bytes)};
  copy.read(shot.rgba.data(), bytes);
  if (format_.format == vk::Format::eB8G8R8A8Unorm)
    for (std::size_t i = 0; i < bytes; i += 4) std::swap(shot.rgba[i], shot.rgba[i + 2]);
  return shot;
}

void Swapchain::present() {
  if (!acquired_) return;
  const std::uint32_t image = *std::exchange(acquired_, std::nullopt);
  try {
    const vk::Result result = d_.queue.presentKHR({*targets_[image].drawn, *chain_, image});
    stale_ = stale_ || result == vk::Result::eSuboptimalKHR;
  } catch (const vk::OutOfDateKHRError&) {
    stale_ = true;
  }
}

}  // namespace steradian::view
