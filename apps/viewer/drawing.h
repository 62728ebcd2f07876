// Drawing: a scene of the plane, from SVG, in the hand: its lamps and blockers dragged, turned, resized, recoloured, added and removed.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "drawing_worker.h"
#include "plane_body.h"
#include "stage.h"

namespace steradian::view {

class Drawing : public Stage {
 public:
  // Throws Error where the file is no scene of the plane.
  Drawing(const std::string& path, int width, int height, int threads);

  bool update() override;
  bool settled() const override { return settled_; }
  void wait_until_settled() override;
  const Picture& picture() const override { return picture_; }
  const PlaneStageStats& stats() const { return stats_; }

  void resize(int width, int height) override;
  // Left drags the body under the pointer; its corner handle, when it is selected, resizes it.
  void press(PointerButton button, bool shift, Vec2d at) override;
  void drag(Vec2d to) override;
  void release(Vec2d at) override;
  bool dragging() const override { return hold_ != Hold::nothing; }
  void wheel(double steps, Vec2d at) override;  // over what is selected: larger and smaller
  void fly(double, double, double) override {}
  void set_moving(bool moving) override;

  const PlaneScene& scene() const { return scene_; }
  std::optional<std::size_t> selection() const { return selection_; }
  void select(std::size_t body) { selection_ = body; }
  void change(std::size_t body, PlaneBody with);
  void add(bool light, Vec2d at);  // a circle of a twentieth of the picture; selected
  void remove_selected() override;
  void deselect() override { selection_.reset(); }
  void select_named(const std::string& name) override;
  void undo() override;
  void redo() override;
  void frame_selected() override {}
  void reset_camera() override {}

  Vec2d to_scene(Vec2d pixel) const;
  Vec2d to_pixel(Vec2d point) const;
  std::optional<Vec2d> resize_handle() const;  // in pixels: the lower right corner of what is selected

  const std::string& path() const override { return path_; }
  bool unsaved() const override { return open_.has_value() || before_.size() != saved_steps_; }
  bool file_changed() const override;
  void reload() override;
  void save_scene(const std::string& path) override;
  void save_picture(const std::string& path, float exposure_stops) override;

 private:
  void load();
  void show();
  void close_step();

  std::string path_;
  PlaneScene scene_;
  std::filesystem::file_time_type file_time_{};
  int width_, height_;
  std::optional<std::size_t> selection_;
  // Scenes before the steps that can be undone, and after those that can be redone; the one before the step that is open.
  std::vector<PlaneScene> before_, after_;
  std::optional<PlaneScene> open_;
  std::size_t saved_steps_ = 0;  // of before_, when it was saved

  enum class Hold { nothing, body, corner } hold_ = Hold::nothing;
  bool moving_ = false;
  Vec2d pressed_;
  PlaneBody pressed_body_;

  DrawingWorker worker_;
  std::uint64_t request_ = 0;
  bool settled_ = false;
  Picture picture_;
  PlaneStageStats stats_;
};

}  // namespace steradian::view
