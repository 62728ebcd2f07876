#include "drawing/drawing.h"

#include <algorithm>
#include <cmath>
#include <fstream>

#include "core/files.h"
#include "plane/frame/tiles/tiles.h"
#include "steradian/error.h"

namespace steradian::view {
namespace {

std::filesystem::file_time_type drawing_time(const std::string& path) {
  std::error_code ignored;
  return std::filesystem::last_write_time(path, ignored);
}

constexpr double kReach = 6;  // pixels around thin bodies and handles

}  // namespace

DrawingStage::DrawingStage(const std::string& path, int width, int height, int threads)
    : path_(path), width_(width), height_(height), worker_(threads) {
  load();
}

void DrawingStage::load() {
  PlaneAnimation animation(path_);
  PlaneScene scene = animation.at(animation.moves() ? time_ : 0).scene;
  duration_ = animation.duration();
  endless_ = animation.endless();
  animation_ = std::move(animation);
  sheet_ = fresh_sheet(std::move(scene));
  file_time_ = drawing_time(path_);
  before_.clear();
  saved_steps_ = 0;
  after_.clear();
  open_.reset();
  show();
}

void DrawingStage::show() {
  if (selection_ && *selection_ >= sheet_.scene.bodies.size()) selection_.reset();
  request_ = worker_.show(sheet_.scene, width_, height_);
  settled_ = false;
}

namespace {

std::vector<int> in_order(std::size_t count) {
  std::vector<int> numbers(count);
  for (std::size_t i = 0; i < count; ++i) numbers[i] = static_cast<int>(i);
  return numbers;
}

}  // namespace

DrawingStage::Sheet DrawingStage::fresh_sheet(PlaneScene scene) const {
  std::vector<int> numbers = in_order(scene.bodies.size());
  return {scene, duration_ > 0 ? scene : PlaneScene{}, std::move(numbers)};
}

// ---- time

void DrawingStage::set_time(double seconds) {
  if (!(duration_ > 0)) return;
  time_ = seconds > duration_ && !endless_ ? std::fmod(seconds, duration_) : std::max(seconds, 0.0);
  time_wanted_ = true;
  if (settled_) show_time();
}

void DrawingStage::show_time() {
  time_wanted_ = false;
  PlaneScene next = animation_->at(time_).scene;
  std::vector<PlaneBody>& bodies = sheet_.scene.bodies;
  const std::vector<PlaneBody>& last = sheet_.moment.bodies;
  if (next.bodies.size() != last.size()) {
    // Shapes were added or removed, and nothing tells which is which. Bodies that were added by hand stay on top.
    std::vector<PlaneBody> added;
    for (std::size_t i = 0; i < bodies.size(); ++i)
      if (sheet_.origin[i] < 0) added.push_back(std::move(bodies[i]));
    sheet_ = fresh_sheet(std::move(next));
    sheet_.origin.resize(sheet_.origin.size() + added.size(), -1);
    bodies.insert(bodies.end(), added.begin(), added.end());
  } else {
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      const int of = sheet_.origin[i];
      if (of < 0) continue;
      const auto number = static_cast<std::size_t>(of);
      if (!looks_alike(last[number], next.bodies[number])) bodies[i] = next.bodies[number];
    }
    sheet_.moment = std::move(next);
  }
  if (selection_ && *selection_ >= bodies.size()) selection_.reset();
  request_ = worker_.follow(sheet_.scene);
  settled_ = false;
}

bool DrawingStage::update() {
  auto drawn = worker_.take();
  if (!drawn) return false;
  settled_ = drawn->request == request_;
  say(drawn->error);
  if (!drawn->error.empty()) return false;
  picture_ = std::move(drawn->picture);
  stats_ = drawn->stats;
  if (settled_ && time_wanted_) try {
      show_time();
    } catch (const std::exception& e) {
      say(e.what());
    }
  return true;
}

void DrawingStage::wait_until_settled() {
  while (!settled_) {
    worker_.wait();
    update();
  }
}

void DrawingStage::resize(int width, int height) {
  if (width < 1 || height < 1 || (width == width_ && height == height_)) return;
  width_ = width;
  height_ = height;
  show();
}

Vec2d DrawingStage::to_scene(Vec2d pixel) const {
  const plane::PixelGrid grid = plane::grid_of(sheet_.scene, width_, height_);
  return grid.origin + Vec2d{pixel.x * grid.step.x, pixel.y * grid.step.y};
}

Vec2d DrawingStage::to_pixel(Vec2d point) const {
  const plane::PixelGrid grid = plane::grid_of(sheet_.scene, width_, height_);
  return {(point.x - grid.origin.x) / grid.step.x, (point.y - grid.origin.y) / grid.step.y};
}

std::optional<Vec2d> DrawingStage::resize_handle() const {
  if (!selection_) return {};
  return to_pixel(bounds_of(sheet_.scene.bodies[*selection_]).high);
}

// ---- the pointer

void DrawingStage::press(PointerButton button, bool, Vec2d at) {
  if (button != PointerButton::left || hold_ != Hold::nothing) return;
  pressed_ = to_scene(at);
  const auto corner = resize_handle();
  if (corner && length(*corner - at) <= kReach) {
    hold_ = Hold::corner;
  } else {
    selection_ = body_at(sheet_.scene, pressed_, kReach * std::fabs(to_scene({1, 0}).x - to_scene({0, 0}).x));
    if (selection_) hold_ = Hold::body;
  }
  if (selection_) pressed_body_ = sheet_.scene.bodies[*selection_];
}

void DrawingStage::drag(Vec2d to) {
  if (hold_ == Hold::nothing || !selection_) return;
  const Vec2d now = to_scene(to);
  set_moving(true);
  if (hold_ == Hold::body) {
    change(*selection_, moved(pressed_body_, now - pressed_));
    return;
  }
  const Vec2d middle = bounds_of(pressed_body_).center();
  const double from = length(pressed_ - middle);
  if (from > 0) change(*selection_, scaled(pressed_body_, middle, std::max(length(now - middle) / from, 0.02)));
}

void DrawingStage::release(Vec2d at) {
  drag(at);
  hold_ = Hold::nothing;
  set_moving(false);
}

void DrawingStage::wheel(double steps, Vec2d) {
  if (!selection_) return;
  const PlaneBody& body = sheet_.scene.bodies[*selection_];
  change(*selection_, scaled(body, bounds_of(body).center(), std::pow(1.1, steps)));
  close_step();
}

void DrawingStage::set_moving(bool moving) {
  if (moving_ && !moving) close_step();
  moving_ = moving;
}

// ---- edits

void DrawingStage::change(std::size_t body, PlaneBody with) {
  if (!open_) open_ = sheet_;
  sheet_.scene.bodies[body] = with;
  request_ = worker_.edit({PlaneEdit::Kind::replace, body, std::move(with)});
  settled_ = false;
  if (!moving_) close_step();
}

void DrawingStage::close_step() {
  if (!open_) return;
  before_.push_back(std::move(*open_));
  open_.reset();
  after_.clear();
}

void DrawingStage::add(bool light, Vec2d at) {
  close_step();
  open_ = sheet_;
  PlaneBody body = plane_circle(to_scene(at), std::min(sheet_.scene.width, sheet_.scene.height) / 20);
  if (light) body.light = PlaneEmission{};
  sheet_.scene.bodies.push_back(body);
  sheet_.origin.push_back(-1);
  request_ = worker_.edit({PlaneEdit::Kind::add, 0, std::move(body)});
  settled_ = false;
  selection_ = sheet_.scene.bodies.size() - 1;
  close_step();
}

void DrawingStage::remove_selected() {
  if (!selection_) return;
  close_step();
  open_ = sheet_;
  sheet_.origin.erase(sheet_.origin.begin() + static_cast<std::ptrdiff_t>(*selection_));
  sheet_.scene.bodies.erase(sheet_.scene.bodies.begin() + static_cast<std::ptrdiff_t>(*selection_));
  request_ = worker_.edit({PlaneEdit::Kind::remove, *selection_, {}});
  settled_ = false;
  selection_.reset();
  close_step();
}

void DrawingStage::select_named(const std::string& name) {
  selection_.reset();
  for (std::size_t i = 0; i < sheet_.scene.bodies.size(); ++i)
    if (sheet_.scene.bodies[i].name == name) selection_ = i;
}

void DrawingStage::undo() {
  close_step();
  if (before_.empty()) return;
  after_.push_back(std::move(sheet_));
  sheet_ = std::move(before_.back());
  before_.pop_back();
  show_again();
}

// A step may belong to another moment.
void DrawingStage::show_again() {
  show();
  if (duration_ > 0) time_wanted_ = true;
}

void DrawingStage::redo() {
  if (after_.empty()) return;
  before_.push_back(std::move(sheet_));
  sheet_ = std::move(after_.back());
  after_.pop_back();
  show_again();
}

// ---- files

bool DrawingStage::file_changed() const {
  const auto now = drawing_time(path_);
  return now != std::filesystem::file_time_type{} && now != file_time_;
}

void DrawingStage::reload() { load(); }

void DrawingStage::save_scene(const std::string& path) {
  if (!path.ends_with(".svg")) throw Error(path, "is no .svg", "name the scene scene.svg");
  write_file(path, plane_scene_to_svg(sheet_.scene));
  close_step();
  saved_steps_ = before_.size();
  if (std::filesystem::weakly_canonical(path) == std::filesystem::weakly_canonical(path_)) file_time_ = drawing_time(path);
}

void DrawingStage::save_picture(const std::string& path, float exposure_stops, ToneCurve curve) {
  wait_until_settled();
  write_picture(picture_, path, exposure_stops, curve);
}

}  // namespace steradian::view
