// A window of GLFW, and what GLFW says of its errors.
#pragma once

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <memory>
#include <string>

namespace steradian::view {

struct DestroyGlfwWindow {
  void operator()(GLFWwindow* window) const { glfwDestroyWindow(window); }
};
using GlfwWindow = std::unique_ptr<GLFWwindow, DestroyGlfwWindow>;

// The last error of this thread; forgotten once it is read.
inline std::string glfw_error() {
  const char* text = nullptr;
  glfwGetError(&text);
  return text != nullptr ? text : "GLFW gives no reason";
}

struct PixelSize {
  int width = 0, height = 0;
};
// Pixels of the window's contents; 0 if it is minimised.
inline PixelSize pixel_size(GLFWwindow* window) {
  PixelSize size;
  glfwGetFramebufferSize(window, &size.width, &size.height);
  return size;
}

}  // namespace steradian::view
