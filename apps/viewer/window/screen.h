// Screen: a GLFW window, and the way of the picture and Dear ImGui's widgets into it, by OpenGL or by Vulkan.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "display.h"

struct GLFWwindow;

namespace steradian::view {

struct ScreenRequest {
  int width = 1, height = 1;
  std::string title;
  std::string device;                       // of Vulkan, as in RenderOptions
  std::function<void(GLFWwindow*)> listen;  // sets callbacks of the window, which Dear ImGui's callbacks call first
};

// A frame is begin(), ImGui's NewFrame() to Render(), draw(), pixels() if they are wanted, and present(). All functions throw Error if the
// device is lost. The context of Dear ImGui outlives the screen.
class Screen {
 public:
  Screen() = default;
  virtual ~Screen() = default;
  Screen(const Screen&) = delete;
  Screen& operator=(const Screen&) = delete;

  virtual GLFWwindow* window() const = 0;
  virtual std::string name() const = 0;  // as in "OpenGL"

  virtual void show(const Display& picture) = 0;  // from the next frame on
  virtual void* picture() const = 0;              // the texture that holds it, for Dear ImGui
  virtual void begin() = 0;
  virtual void draw() = 0;             // what Dear ImGui has rendered
  virtual Display pixels() const = 0;  // of the window, as drawn
  virtual void present() = 0;          // waits for the screen's next turn
};

// Throw Error if there is no such window here.
std::unique_ptr<Screen> open_opengl_screen(const ScreenRequest& request);
std::unique_ptr<Screen> open_vulkan_screen(const ScreenRequest& request);

}  // namespace steradian::view
