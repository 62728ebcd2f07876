#include "window/window.h"

#include <imgui.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <map>

#include "core/files.h"
#include "image/codecs.h"
#include "player.h"
#include "steradian/error.h"
#include "window/glfw_window.h"
#include "window/screen.h"

namespace steradian::view {
namespace {

using Clock = std::chrono::steady_clock;

// The name of a key as in keys.h; empty for keys without a name.
std::string name_of_key(int key, int mods) {
  static const std::map<int, const char*> kNamed = {{GLFW_KEY_TAB, "Tab"},       {GLFW_KEY_HOME, "Home"},
                                                    {GLFW_KEY_DELETE, "Delete"}, {GLFW_KEY_BACKSPACE, "Backspace"},
                                                    {GLFW_KEY_ESCAPE, "Escape"}, {GLFW_KEY_SPACE, "Space"}};
  std::string name;
  if ((mods & GLFW_MOD_CONTROL) != 0) name += "Ctrl+";
  if ((mods & GLFW_MOD_SHIFT) != 0) name += "Shift+";
  if (key >= GLFW_KEY_F1 && key <= GLFW_KEY_F12) return name + "F" + std::to_string(key - GLFW_KEY_F1 + 1);
  if (const auto named = kNamed.find(key); named != kNamed.end()) return name + named->second;
  // Uses the keyboard's layout.
  const char* letter = glfwGetKeyName(key, 0);
  return letter != nullptr ? name + letter : std::string();
}

PointerButton button_named(const std::string& name) {
  return name == "right" ? PointerButton::right : name == "middle" ? PointerButton::middle : PointerButton::left;
}
const char* name_of(PointerButton button) {
  return button == PointerButton::right ? "right" : button == PointerButton::middle ? "middle" : "left";
}
PointerButton button_of(int glfw_button) {
  return glfw_button == GLFW_MOUSE_BUTTON_RIGHT    ? PointerButton::right
         : glfw_button == GLFW_MOUSE_BUTTON_MIDDLE ? PointerButton::middle
                                                   : PointerButton::left;
}

// Initialises GLFW and Dear ImGui for its lifetime.
struct Libraries {
  Libraries() {
    if (glfwInit() == GLFW_FALSE)
      throw Error("view", "no window can be opened: " + glfw_error(),
                  "it needs a display (DISPLAY or WAYLAND_DISPLAY); xvfb-run makes one, and `steradian render` needs none");
    ImGui::CreateContext();
    ImGui::GetIO().IniFilename = nullptr;
    ImGui::StyleColorsDark();
  }
  ~Libraries() {
    ImGui::DestroyContext();
    glfwTerminate();
  }
  Libraries(const Libraries&) = delete;
  Libraries& operator=(const Libraries&) = delete;
};

class Window {
 public:
  explicit Window(const WindowOptions& options) : options_(options) {
    open_stage(state_, options.scene, options.render);
    state_.panel = options.panel;
    state_.tone = options.tone;
    if (options.exposure) {
      state_.exposure = *options.exposure;
      state_.exposure_known = true;
    }
    if (!options.script.empty()) {
      Budget budget;
      const Bytes text = read_file(options.script, options.script, budget);
      script_ = read_script({text.begin(), text.end()}, options.script);
    }
    state_.stage->update();  // the worker starts while the window is created
    open_screen();
  }
  Window(const Window&) = delete;
  Window& operator=(const Window&) = delete;

  void run() {
    while (glfwWindowShouldClose(window()) == 0 && !state_.quit) {
      const bool busy = !state_.stage->settled() || playing() || flying_ || state_.playing;
      busy ? glfwWaitEventsTimeout(1.0 / 120) : glfwWaitEventsTimeout(0.25);
      play();
      fly();
      run_time();
      watch_file();
      const bool fresh = state_.stage->update();
      if (fresh) take_picture();
      // Drawing takes time from the picture that is computed.
      constexpr std::chrono::milliseconds kStill{100};
      if (!busy || fresh || std::exchange(touched_, false) || !shot_.empty() || flying_ || state_.playing ||
          Clock::now() - last_draw_ >= kStill)
        draw();
      if (by_vulkan() != shown_by_vulkan_) open_screen();
    }
    if (!options_.record.empty()) write_file(options_.record, recorded_);
  }

 private:
  void open_screen();
  void leave_vulkan(const std::exception& why);
  void listen(GLFWwindow* window);
  GLFWwindow* window() const { return screen_->window(); }
  // The window is shown by the device that renders, until that is lost or cannot show it.
  bool by_vulkan() const {
    return vulkan_shows_ && (state_.session != nullptr ? state_.session->options() : options_.render).backend == Backend::vulkan;
  }
  void take_picture();
  void make_display();
  void draw();
  void draw_widgets();
  void shoot(const std::string& path);
  void play();
  void play(const ScriptEvent& event);
  void fly();
  void run_time();  // advances an animation that plays
  void watch_file();
  bool playing() const { return next_event_ < script_.size(); }
  void record(const ScriptEvent& event) {
    if (!options_.record.empty()) recorded_ += script_line(event) + "\n";
  }

  // User input, from a person or a script.
  void on_pointer(PointerButton button, bool down, bool shift, Vec2d at);
  void on_move(Vec2d at);
  void on_key(const std::string& name, bool down);
  void on_wheel(double steps, Vec2d at);

  double pixels_per_point() const {
    const int framebuffer = pixel_size(window()).width;
    int width = 1;
    glfwGetWindowSize(window(), &width, nullptr);
    return width > 0 && framebuffer > 0 ? static_cast<double>(framebuffer) / width : 1.0;
  }
  Vec2d pointer() const {
    Vec2d p;
    glfwGetCursorPos(window(), &p.x, &p.y);
    return p * pixels_per_point();
  }
  static Window& of(GLFWwindow* window) { return *static_cast<Window*>(glfwGetWindowUserPointer(window)); }

  const Clock::time_point start_ = Clock::now();
  const WindowOptions& options_;
  Libraries libraries_;
  std::unique_ptr<Screen> screen_;
  bool shown_by_vulkan_ = false;
  bool vulkan_shows_ = true;                      // until it fails
  int pictures_ = 0, pictures_of_all_light_ = 0;  // taken so far
  ViewState state_;
  std::map<char, bool> held_;  // the held keys that fly
  bool flying_ = false;
  bool touched_ = false;  // input since the window was drawn
  Clock::time_point last_fly_ = Clock::now(), last_look_ = Clock::now(), last_moment_ = Clock::now(), last_draw_ = Clock::now();

  std::vector<ScriptEvent> script_;
  std::size_t next_event_ = 0;
  Clock::time_point wait_until_ = Clock::now();
  std::optional<Vec2d> scripted_pointer_;
  bool scripted_down_[3] = {};
  std::string shot_, recorded_;
};

// Opens the window, or the same window in place of another, by Vulkan if the picture is by Vulkan.
void Window::open_screen() {
  ScreenRequest request{options_.render.width, options_.render.height, "steradian: " + options_.scene, options_.render.device,
                        [this](GLFWwindow* w) { listen(w); }};
  std::optional<std::pair<int, int>> place;
  if (screen_ != nullptr) {
    glfwGetWindowSize(window(), &request.width, &request.height);
    place.emplace();
    glfwGetWindowPos(window(), &place->first, &place->second);
    state_.quit = state_.quit || glfwWindowShouldClose(window()) != 0;
    // The new window hears of no button that is let go.
    if (state_.stage->dragging()) attempt(state_, [&] { state_.stage->release(scripted_pointer_.value_or(pointer())); });
    screen_.reset();
  }
  shown_by_vulkan_ = by_vulkan();
  if (shown_by_vulkan_) try {
      screen_ = open_vulkan_screen(request);
    } catch (const std::exception& e) {
      leave_vulkan(e);
    }
  if (screen_ == nullptr) screen_ = open_opengl_screen(request);
  if (place) glfwSetWindowPos(window(), place->first, place->second);
  state_.screen = screen_->name();
  if (state_.display.width > 0) screen_->show(state_.display);
  held_.clear();
  touched_ = true;
  const PixelSize size = pixel_size(window());
  state_.stage->resize(size.width, size.height);
}

// OpenGL shows the window from now on.
void Window::leave_vulkan(const std::exception& why) {
  vulkan_shows_ = shown_by_vulkan_ = false;
  std::fprintf(stderr, "warning: the window is shown by OpenGL: %s\n", why.what());
  state_.stage->say(std::string(why.what()) + "; OpenGL shows the window");
}

void Window::listen(GLFWwindow* window) {
  glfwSetWindowUserPointer(window, this);
  glfwSetMouseButtonCallback(window, [](GLFWwindow* w, int button, int action, int mods) {
    if (button > GLFW_MOUSE_BUTTON_MIDDLE) return;
    of(w).on_pointer(button_of(button), action == GLFW_PRESS, (mods & GLFW_MOD_SHIFT) != 0, of(w).pointer());
  });
  glfwSetCursorPosCallback(window, [](GLFWwindow* w, double x, double y) { of(w).on_move(Vec2d{x, y} * of(w).pixels_per_point()); });
  glfwSetScrollCallback(window, [](GLFWwindow* w, double, double steps) { of(w).on_wheel(steps, of(w).pointer()); });
  glfwSetKeyCallback(window, [](GLFWwindow* w, int key, int, int action, int mods) {
    of(w).touched_ = true;
    if (const std::string name = name_of_key(key, mods); !name.empty() && action != GLFW_REPEAT) of(w).on_key(name, action == GLFW_PRESS);
  });
  glfwSetFramebufferSizeCallback(window, [](GLFWwindow* w, int width, int height) { of(w).state_.stage->resize(width, height); });
  glfwSetDropCallback(window, [](GLFWwindow* w, int count, const char** paths) {
    Window& self = of(w);
    if (count > 0) attempt(self.state_, [&] { open_stage(self.state_, paths[0], self.options_.render); });
  });
}

// ---- pictures

void Window::take_picture() {
  state_.display_wanted = true;
  if (state_.session != nullptr && state_.session->frame().same) return;
  ++pictures_;
  pictures_of_all_light_ += state_.session != nullptr && state_.session->frame().light != ShownLight::direct ? 1 : 0;
  constexpr std::size_t kShown = 120;
  state_.history.push_back(state_.session != nullptr ? state_.session->frame().stats.passes
                                                     : std::vector<PassTime>{{"tiles", state_.drawing->stats().ms}});
  if (state_.history.size() > kShown) state_.history.pop_front();
}

void Window::make_display() {
  const Picture& picture = state_.stage->picture();
  if (picture.width == 0) return;
  // The exposure is that of all the light, if the picture is to have it.
  const bool waits = state_.session != nullptr && state_.session->frame().light == ShownLight::direct;
  if (!state_.exposure_known && waits) {
    state_.exposure = auto_exposure(picture);
    state_.display_wanted = true;
  } else if (!state_.exposure_known) {
    state_.exposure = state_.drawing != nullptr ? 0 : auto_exposure(picture);  // like `render`: light maps keep their scale
    state_.exposure_known = state_.display_wanted = true;
  }
  if (!state_.display_wanted) return;
  state_.display_wanted = false;
  const Picture* other = state_.session != nullptr ? &state_.session->frame().other : nullptr;
  const bool both = other != nullptr && other->width == picture.width && other->height == picture.height;
  if (both && state_.error_map)
    state_.display = error_map(picture, *other, static_cast<double>(state_.error_most));
  else if (both && state_.split)
    state_.display = split(shown(picture, state_.exposure, state_.tone), shown(*other, state_.exposure, state_.tone),
                           static_cast<int>(std::lround(static_cast<double>(state_.split_at) * picture.width)));
  else
    state_.display = shown(picture, state_.exposure, state_.tone);
  screen_->show(state_.display);
}

void Window::draw() try {
  last_draw_ = Clock::now();
  if (const PixelSize size = pixel_size(window()); size.width == 0 || size.height == 0) return;  // minimised
  make_display();
  screen_->begin();
  draw_widgets();
  screen_->draw();
  if (!shot_.empty()) attempt(state_, [&] { shoot(std::exchange(shot_, {})); });
  screen_->present();
} catch (const Error& e) {
  if (!shown_by_vulkan_) throw;
  leave_vulkan(e);
  open_screen();
}

// Renders the picture and what stands over it, for the screen.
void Window::draw_widgets() {
  ImGuiIO& io = ImGui::GetIO();
  if (scripted_pointer_) {
    const double scale = pixels_per_point();
    io.MousePos = {static_cast<float>(scripted_pointer_->x / scale), static_cast<float>(scripted_pointer_->y / scale)};
    for (int i = 0; i < 3; ++i) io.MouseDown[i] = scripted_down_[i];
  }
  ImGui::NewFrame();
  if (state_.display.width > 0) ImGui::GetBackgroundDrawList()->AddImage(screen_->picture(), {0, 0}, io.DisplaySize);
  draw_overlay(state_, pixels_per_point());
  if (state_.panel) draw_panel(state_);
  if (state_.help) draw_help(state_);
  draw_message(state_);
  // Changes by a held widget are one step of undo, and are rendered fast.
  if (!flying_ && !state_.stage->dragging()) state_.stage->set_moving(ImGui::IsAnyItemActive() || state_.playing);
  ImGui::Render();
}

// Writes the window as it is drawn into a file.
void Window::shoot(const std::string& path) {
  const Display shot = screen_->pixels();
  const auto width = static_cast<std::size_t>(shot.width);
  write_file(path, image::encode_png_bytes(shot.width, shot.height, [&](int y, std::uint8_t* row) {
               const std::uint8_t* from = shot.rgba.data() + 4 * width * static_cast<std::size_t>(y);
               for (std::size_t x = 0; x < width; ++x) std::copy_n(from + 4 * x, 3, row + 3 * x);
             }));
}

// ---- a hand

void Window::on_pointer(PointerButton button, bool down, bool shift, Vec2d at) {
  touched_ = true;
  record({down ? ScriptWord::press : ScriptWord::release, name_of(button), at, 0, shift, {}});
  if (!down)
    attempt(state_, [&] { state_.stage->release(at); });
  else if (!ImGui::GetIO().WantCaptureMouse)
    attempt(state_, [&] { state_.stage->press(button, shift, at); });
}

void Window::on_move(Vec2d at) {
  touched_ = true;
  record({ScriptWord::move, {}, at, 0, false, {}});
  attempt(state_, [&] { state_.stage->drag(at); });
}

void Window::on_wheel(double steps, Vec2d at) {
  touched_ = true;
  record({ScriptWord::wheel, {}, at, steps, false, {}});
  if (!ImGui::GetIO().WantCaptureMouse) state_.stage->wheel(steps, at);
}

void Window::on_key(const std::string& name, bool down) {
  if (down) record({ScriptWord::key, name, {}, 0, false, {}});
  const std::optional<Action> action = action_of(name);
  if (!action) return;
  if (*action == Action::fly) {
    held_[static_cast<char>(std::toupper(name.front()))] = down && !ImGui::GetIO().WantTextInput;
    return;
  }
  if (down && !ImGui::GetIO().WantTextInput) act(state_, *action);
}

void Window::fly() {
  const auto now = Clock::now();
  const double seconds = std::min(std::chrono::duration<double>(now - std::exchange(last_fly_, now)).count(), 0.1);
  const auto axis = [&](char plus, char minus) { return (held_[plus] ? 1.0 : 0.0) - (held_[minus] ? 1.0 : 0.0); };
  const double right = axis('D', 'A'), up = axis('E', 'Q'), forward = axis('W', 'S');
  const bool flies = right != 0 || up != 0 || forward != 0;
  if (flies != flying_) state_.stage->set_moving(flies);
  flying_ = flies;
  constexpr double kSpeed = 0.7;  // fraction of the distance to the orbited point per second
  if (flies) state_.stage->fly(right * kSpeed * seconds, up * kSpeed * seconds, forward * kSpeed * seconds);
}

void Window::run_time() {
  const auto now = Clock::now();
  const double seconds = std::chrono::duration<double>(now - std::exchange(last_moment_, now)).count();
  if (state_.playing) attempt(state_, [&] { state_.stage->set_time(state_.stage->time() + seconds); });
}

// Another program may write the file, so it is checked twice a second.
void Window::watch_file() {
  const auto now = Clock::now();
  if (now - last_look_ < std::chrono::milliseconds(500)) return;
  last_look_ = now;
  follow_file(state_);
}

// ---- a script

void Window::play() {
  if (!playing() || Clock::now() < wait_until_ || !shot_.empty()) return;
  if (const ScriptEvent& next = script_[next_event_]; next.word == ScriptWord::wait) {
    if (next.number == kSettled && !state_.stage->settled()) return;
    if (next.number == kPicture && state_.display.width == 0 && !state_.stage->settled()) return;
  }
  const ScriptEvent event = script_[next_event_++];
  touched_ = true;
  attempt(state_, [&] { play(event); });
}

void Window::play(const ScriptEvent& event) {
  const auto down = [&](bool is_down) { scripted_down_[event.text == "right" ? 1 : event.text == "middle" ? 2 : 0] = is_down; };
  switch (event.word) {
    case ScriptWord::press:
      scripted_pointer_ = event.at;
      down(true);
      on_pointer(button_named(event.text), true, event.shift, event.at);
      break;
    case ScriptWord::move:
      scripted_pointer_ = event.at;
      on_move(event.at);
      break;
    case ScriptWord::release:
      down(false);
      on_pointer(button_named(event.text), false, false, event.at == Vec2d{} && scripted_pointer_ ? *scripted_pointer_ : event.at);
      break;
    case ScriptWord::click:
      scripted_pointer_ = event.at;
      on_pointer(PointerButton::left, true, false, event.at);
      on_pointer(PointerButton::left, false, false, event.at);
      break;
    case ScriptWord::wheel: on_wheel(event.number, event.at); break;
    case ScriptWord::key:
      if (!action_of(event.text)) throw Error("script", "no key " + event.text, "F1 shows them");
      on_key(event.text, true);
      on_key(event.text, false);
      break;
    case ScriptWord::select: state_.stage->select_named(event.text); break;
    case ScriptWord::set: set_value(state_, event.text, event.value); break;
    case ScriptWord::wait:
      if (event.number > 0)
        wait_until_ = Clock::now() + std::chrono::microseconds(static_cast<std::int64_t>(std::min(event.number, 3600.0) * 1e6));
      break;
    case ScriptWord::time:
      std::printf("%s %.3f s, pictures %d, with all light %d, window by %s\n", event.text.c_str(),
                  std::chrono::duration<double>(Clock::now() - start_).count(), pictures_, pictures_of_all_light_, state_.screen.c_str());
      break;
    case ScriptWord::shot: shot_ = event.text; break;
    case ScriptWord::picture: state_.stage->save_picture(event.text, state_.exposure, state_.tone); break;
    case ScriptWord::save: state_.stage->save_scene(event.text); break;
    case ScriptWord::resize: glfwSetWindowSize(window(), static_cast<int>(event.at.x), static_cast<int>(event.at.y)); break;
    case ScriptWord::minimise: glfwIconifyWindow(window()); break;
    case ScriptWord::restore: glfwRestoreWindow(window()); break;
    case ScriptWord::open: open_stage(state_, event.text, options_.render); break;
    case ScriptWord::quit: glfwSetWindowShouldClose(window(), GLFW_TRUE); break;
  }
}

}  // namespace

void run_window(const WindowOptions& options) { Window(options).run(); }

}  // namespace steradian::view
