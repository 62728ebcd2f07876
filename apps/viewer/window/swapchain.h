// Swapchain: the pictures that a window shows one after the other, by a Vulkan device. One frame is drawn at a time.
#pragma once

#include <optional>
#include <vector>

#include "device/vulkan/handles.h"
#include "display.h"

namespace steradian::view {

class Swapchain {
 public:
  // Throws Error if the device cannot present to the surface. The device must outlive this object.
  Swapchain(const vulkan::Device& device, vk::raii::SurfaceKHR surface);

  // One subpass that clears and draws a picture of 8 bits per channel, whose bytes reach the screen as they are.
  vk::RenderPass pass() const { return *pass_; }
  vk::Extent2D size() const { return size_; }

  // Waits until the last frame is drawn. Its buffers and textures may then change.
  void wait() const;
  // Waits for the next picture, and makes the pictures anew if the window has another size. False: there is none, as for a minimised
  // window.
  bool acquire(vk::Extent2D window);
  // Begins the commands of the acquired picture's frame, which then enter the pass.
  const vk::raii::CommandBuffer& begin() const;
  void enter_pass() const;
  void submit();
  // Returns the acquired picture after submit(). Throws Error if the window system does not let it be read.
  Display pixels() const;
  // Shows the acquired picture, if there is one, at the screen's next refresh (FIFO).
  void present();

 private:
  struct Target {
    vk::Image image;
    vk::raii::ImageView view = nullptr;
    vk::raii::Framebuffer frame = nullptr;
    vk::raii::Semaphore drawn = nullptr;
  };
  void make(vk::Extent2D window);

  const vulkan::Device& device_;
  const vulkan::Device::Handles& d_;
  vk::raii::SurfaceKHR surface_;
  vk::SurfaceFormatKHR format_;
  vk::raii::RenderPass pass_ = nullptr;
  vk::raii::SwapchainKHR chain_ = nullptr;
  std::vector<Target> targets_;
  vk::Extent2D asked_, size_;  // of the window, and of the pictures made for it
  bool stale_ = true;          // to be made anew
  bool readable_ = false;      // pictures can be read back
  std::optional<std::uint32_t> acquired_;
  vk::raii::Semaphore available_ = nullptr;
  vk::raii::Fence done_ = nullptr;  // signalled unless a frame is being drawn
  vk::raii::Fence read_ = nullptr;  // of pixels()
  vk::raii::CommandBuffer commands_ = nullptr;
};

}  // namespace steradian::view
