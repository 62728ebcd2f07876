#include "device/vulkan/handles.h"  // Vulkan's types; before GLFW, whose functions take them

#include <backends/imgui_impl_glfw.h>
#include <imgui.h>

#include "window/glfw_window.h"
#include "window/screen.h"
#include "window/swapchain.h"
#include "window/widget_painter.h"

namespace steradian::view {
namespace {

GlfwWindow open_window(const ScreenRequest& request) {
  glfwDefaultWindowHints();
  glfwWindowHint(GLFW_CLIENT_API, GLFW_NO_API);
  GlfwWindow window(glfwCreateWindow(request.width, request.height, request.title.c_str(), nullptr, nullptr));
  if (window == nullptr) throw Error("view", "no window can be opened: " + glfw_error());
  return window;
}

vulkan::DeviceOptions device_options(const ScreenRequest& request) {
  std::uint32_t count = 0;
  const char** names = glfwGetRequiredInstanceExtensions(&count);
  if (names == nullptr) throw Error("Vulkan", "no window can be shown: " + glfw_error());
  return {.name = request.device, .window_extensions = {names, names + count}};
}

vk::raii::SurfaceKHR surface_of(const vulkan::Device& device, GLFWwindow* window) {
  const vk::raii::Instance& instance = device.handles().instance;
  VkSurfaceKHR surface = VK_NULL_HANDLE;
  if (glfwCreateWindowSurface(*instance, window, nullptr, &surface) != VK_SUCCESS)
    throw Error("Vulkan", "the window has no surface: " + glfw_error());
  return {instance, surface};
}

// The device is the screen's own: the thread that renders has another one, whose long batches its queue would put before a frame.
class VulkanScreen : public Screen {
 public:
  explicit VulkanScreen(const ScreenRequest& request) : window_(open_window(request)), device_(device_options(request)) {
    parts_ = vulkan::checked(device_, "open a window", [&] { return std::make_unique<Parts>(device_, window()); });
    request.listen(window());
    ImGui_ImplGlfw_InitForVulkan(window(), true);
    ImGui::GetIO().BackendRendererName = "steradian_vulkan";
    ImGui::GetIO().BackendFlags |= ImGuiBackendFlags_RendererHasVtxOffset;
  }
  ~VulkanScreen() override {
    ImGui_ImplGlfw_Shutdown();
    ImGuiIO& io = ImGui::GetIO();
    io.Fonts->SetTexID(nullptr);
    io.BackendRendererName = nullptr;
    io.BackendFlags &= ~ImGuiBackendFlags_RendererHasVtxOffset;
    try {
      if (!device_.handles().hangs) device_.handles().device.waitIdle();
    } catch (const vk::SystemError&) {  // the device is lost
    }
    device_.handles().leave(parts_);
  }

  GLFWwindow* window() const override { return window_.get(); }
  std::string name() const override { return "Vulkan, " + device_.info().name; }

  void show(const Display& picture) override {
    vulkan::checked(device_, "show a picture", [&] {
      parts_->chain.wait();
      parts_->painter.write(parts_->painter.picture(), picture.width, picture.height, picture.rgba.data());
    });
  }
  void* picture() const override { return &parts_->painter.picture(); }

  void begin() override { ImGui_ImplGlfw_NewFrame(); }
  void draw() override {
    vulkan::checked(device_, "draw the window", [&] {
      const PixelSize size = pixel_size(window());
      Swapchain& chain = parts_->chain;
      if (!chain.acquire(vulkan::extent_of(size.width, size.height))) return;
      const ImDrawData& data = *ImGui::GetDrawData();
      const vk::raii::CommandBuffer& commands = chain.begin();
      parts_->painter.prepare(commands, data);
      chain.enter_pass();
      parts_->painter.draw(commands, data, chain.size());
      chain.submit();
    });
  }
  Display pixels() const override {
    return vulkan::checked(device_, "read the window", [&] { return parts_->chain.pixels(); });
  }
  void present() override {
    vulkan::checked(device_, "show the window", [&] { parts_->chain.present(); });
  }

 private:
  struct Parts {
    Parts(const vulkan::Device& device, GLFWwindow* window) : chain(device, surface_of(device, window)), painter(device, chain.pass()) {}
    Swapchain chain;
    WidgetPainter painter;
  };

  GlfwWindow window_;
  vulkan::Device device_;
  std::unique_ptr<Parts> parts_;
};

}  // namespace

std::unique_ptr<Screen> open_vulkan_screen(const ScreenRequest& request) { return std::make_unique<VulkanScreen>(request); }

}  // namespace steradian::view
