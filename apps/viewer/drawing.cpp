#include "drawing.h"

#include <algorithm>
#include <cmath>
#include <fstream>

#include "core/atomic_file.h"
#include "plane/frame/tiles.h"
#include "steradian/error.h"

namespace steradian::view {
namespace {

std::filesystem::file_time_type time_of(const std::string& path) {
  std::error_code ignored;
  return std::filesystem::last_write_time(path, ignored);
}

constexpr double kReach = 6;  // pixels around thin bodies and handles

}  // namespace

Drawing::Drawing(const std::string& path, int width, int height, int threads)
    : path_(path), width_(width), height_(height), worker_(threads) {
  load();
}

void Drawing::load() {
  scene_ = load_plane_scene(path_).scene;
  file_time_ = time_of(path_);
  before_.clear();
  saved_steps_ = 0;
  after_.clear();
  open_.reset();
  show();
}

void Drawing::show() {
  if (selection_ && *selection_ >= scene_.bodies.size()) selection_.reset();
  request_ = worker_.show(scene_, width_, height_);
  settled_ = false;
}

bool Drawing::update() {
  auto drawn = worker_.take();
  if (!drawn) return false;
  settled_ = drawn->request == request_;
  say(drawn->error);
  if (!drawn->error.empty()) return false;
  picture_ = std::move(drawn->picture);
  stats_ = drawn->stats;
  return true;
}

void Drawing::wait_until_settled() {
  while (!settled_) {
    worker_.wait();
    update();
  }
}

void Drawing::resize(int width, int height) {
  if (width < 1 || height < 1 || (width == width_ && height == height_)) return;
  width_ = width;
  height_ = height;
  show();
}

Vec2d Drawing::to_scene(Vec2d pixel) const {
  const plane::PixelGrid grid = plane::grid_of(scene_, width_, height_);
  return grid.origin + Vec2d{pixel.x * grid.step.x, pixel.y * grid.step.y};
}

Vec2d Drawing::to_pixel(Vec2d point) const {
  const plane::PixelGrid grid = plane::grid_of(scene_, width_, height_);
  return {(point.x - grid.origin.x) / grid.step.x, (point.y - grid.origin.y) / grid.step.y};
}

std::optional<Vec2d> Drawing::resize_handle() const {
  if (!selection_) return {};
  return to_pixel(bounds_of(scene_.bodies[*selection_]).high);
}

// ---- the pointer

void Drawing::press(PointerButton button, bool, Vec2d at) {
  if (button != PointerButton::left || hold_ != Hold::nothing) return;
  pressed_ = to_scene(at);
  const auto corner = resize_handle();
  if (corner && length(*corner - at) <= kReach) {
    hold_ = Hold::corner;
  } else {
    selection_ = body_at(scene_, pressed_, kReach * std::fabs(to_scene({1, 0}).x - to_scene({0, 0}).x));
    if (selection_) hold_ = Hold::body;
  }
  if (selection_) pressed_body_ = scene_.bodies[*selection_];
}

void Drawing::drag(Vec2d to) {
  if (hold_ == Hold::nothing || !selection_) return;
  const Vec2d now = to_scene(to);
  set_moving(true);
  if (hold_ == Hold::body) {
    change(*selection_, moved(pressed_body_, now - pressed_));
    return;
  }
  const Vec2d middle = bounds_of(pressed_body_).middle();
  const double from = length(pressed_ - middle);
  if (from > 0) change(*selection_, scaled(pressed_body_, middle, std::max(length(now - middle) / from, 0.02)));
}

void Drawing::release(Vec2d at) {
  drag(at);
  hold_ = Hold::nothing;
  set_moving(false);
}

void Drawing::wheel(double steps, Vec2d) {
  if (!selection_) return;
  const PlaneBody& body = scene_.bodies[*selection_];
  change(*selection_, scaled(body, bounds_of(body).middle(), std::pow(1.1, steps)));
  close_step();
}

void Drawing::set_moving(bool moving) {
  if (moving_ && !moving) close_step();
  moving_ = moving;
}

// ---- edits

void Drawing::change(std::size_t body, PlaneBody with) {
  if (!open_) open_ = scene_;
  scene_.bodies[body] = with;
  request_ = worker_.edit({PlaneEdit::Kind::replace, body, std::move(with)});
  settled_ = false;
  if (!moving_) close_step();
}

void Drawing::close_step() {
  if (!open_) return;
  before_.push_back(std::move(*open_));
  open_.reset();
  after_.clear();
}

void Drawing::add(bool light, Vec2d at) {
  close_step();
  open_ = scene_;
  PlaneBody body = plane_circle(to_scene(at), std::min(scene_.width, scene_.height) / 20);
  if (light) body.light = PlaneEmission{};
  scene_.bodies.push_back(body);
  request_ = worker_.edit({PlaneEdit::Kind::add, 0, std::move(body)});
  settled_ = false;
  selection_ = scene_.bodies.size() - 1;
  close_step();
}

void Drawing::remove_selected() {
  if (!selection_) return;
  close_step();
  open_ = scene_;
  scene_.bodies.erase(scene_.bodies.begin() + static_cast<std::ptrdiff_t>(*selection_));
  request_ = worker_.edit({PlaneEdit::Kind::remove, *selection_, {}});
  settled_ = false;
  selection_.reset();
  close_step();
}

void Drawing::select_named(const std::string& name) {
  selection_.reset();
  for (std::size_t i = 0; i < scene_.bodies.size(); ++i)
    if (scene_.bodies[i].name == name) selection_ = i;
}

void Drawing::undo() {
  close_step();
  if (before_.empty()) return;
  after_.push_back(std::move(scene_));
  scene_ = std::move(before_.back());
  before_.pop_back();
  show();
}

void Drawing::redo() {
  if (after_.empty()) return;
  before_.push_back(std::move(scene_));
  scene_ = std::move(after_.back());
  after_.pop_back();
  show();
}

// ---- files

bool Drawing::file_changed() const {
  const auto now = time_of(path_);
  return now != std::filesystem::file_time_type{} && now != file_time_;
}

void Drawing::reload() { load(); }

void Drawing::save_scene(const std::string& path) {
  if (!path.ends_with(".svg")) throw Error(path, "is no .svg", "name the scene scene.svg");
  write_file(path, plane_scene_to_svg(scene_));
  close_step();
  saved_steps_ = before_.size();
  if (std::filesystem::weakly_canonical(path) == std::filesystem::weakly_canonical(path_)) file_time_ = time_of(path);
}

void Drawing::save_picture(const std::string& path, float exposure_stops) {
  wait_until_settled();
  write_picture(picture_, path, exposure_stops);
}

}  // namespace steradian::view
