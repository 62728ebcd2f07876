#include <backends/imgui_impl_opengl3_loader.h>  // OpenGL's functions; before GLFW, which would include others
#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>
#include <imgui.h>

#include <algorithm>

#include "steradian/error.h"
#include "window/glfw_window.h"
#include "window/screen.h"

namespace steradian::view {
namespace {

// GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T and GL_CLAMP_TO_EDGE, which Dear ImGui's header lacks.
constexpr GLenum kWrapS = 0x2802, kWrapT = 0x2803;
constexpr GLint kClampToEdge = 0x812F;

class OpenGlScreen : public Screen {
 public:
  explicit OpenGlScreen(const ScreenRequest& request) {
    glfwDefaultWindowHints();
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 0);
    window_.reset(glfwCreateWindow(request.width, request.height, request.title.c_str(), nullptr, nullptr));
    if (window_ == nullptr)
      throw Error("view", "no window can be opened: " + glfw_error(),
                  "it needs OpenGL 3.0, which Mesa's software driver has, too (libgl1-mesa-dri)");
    glfwMakeContextCurrent(window_.get());
    glfwSwapInterval(1);
    request.listen(window_.get());
    ImGui_ImplGlfw_InitForOpenGL(window_.get(), true);
    ImGui_ImplOpenGL3_Init("#version 130");
    glGenTextures(1, &texture_);
    glBindTexture(GL_TEXTURE_2D, texture_);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, kWrapS, kClampToEdge);
    glTexParameteri(GL_TEXTURE_2D, kWrapT, kClampToEdge);
  }
  ~OpenGlScreen() override {
    ImGui_ImplOpenGL3_Shutdown();
    ImGui_ImplGlfw_Shutdown();
  }

  GLFWwindow* window() const override { return window_.get(); }
  std::string name() const override { return "OpenGL"; }

  void show(const Display& picture) override {
    glBindTexture(GL_TEXTURE_2D, texture_);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA, picture.width, picture.height, 0, GL_RGBA, GL_UNSIGNED_BYTE, picture.rgba.data());
  }
  void* picture() const override { return reinterpret_cast<void*>(static_cast<std::uintptr_t>(texture_)); }

  void begin() override {
    ImGui_ImplOpenGL3_NewFrame();
    ImGui_ImplGlfw_NewFrame();
  }
  void draw() override {
    const PixelSize size = pixel_size(window());
    glViewport(0, 0, size.width, size.height);
    glClearColor(0, 0, 0, 1);
    glClear(GL_COLOR_BUFFER_BIT);
    ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
  }
  Display pixels() const override {
    const PixelSize size = pixel_size(window());
    const std::size_t row = 4 * static_cast<std::size_t>(size.width), height = static_cast<std::size_t>(size.height);
    Display shot{size.width, size.height, std::vector<std::uint8_t>(row * height)};
    glReadPixels(0, 0, size.width, size.height, GL_RGBA, GL_UNSIGNED_BYTE, shot.rgba.data());
    for (std::size_t y = 0; y < height / 2; ++y)  // OpenGL's rows ascend
      std::swap_ranges(shot.rgba.data() + y * row, shot.rgba.data() + (y + 1) * row, shot.rgba.data() + (height - 1 - y) * row);
    return shot;
  }
  void present() override { glfwSwapBuffers(window()); }

 private:
  GlfwWindow window_;
  GLuint texture_ = 0;
};

}  // namespace

std::unique_ptr<Screen> open_opengl_screen(const ScreenRequest& request) { return std::make_unique<OpenGlScreen>(request); }

}  // namespace steradian::view
