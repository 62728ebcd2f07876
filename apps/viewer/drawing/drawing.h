// Drawing: an editable scene of the plane, from SVG. Its lamps and blockers can be dragged, turned, resized, recoloured, added and removed.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "drawing/drawing_worker.h"
#include "drawing/plane_body.h"
#include "stage.h"
#include "steradian/plane_animation.h"

namespace steradian::view {

class DrawingStage : public Stage {
 public:
  // Throws Error if the file is no scene of the plane.
  DrawingStage(const std::string& path, int width, int height, int threads);

  bool update() override;
  bool settled() const override { return settled_; }
  void wait_until_settled() override;
  const Picture& picture() const override { return picture_; }
  const PlaneStageStats& stats() const { return stats_; }

  void resize(int width, int height) override;
  // The left button drags the body under the pointer. The corner handle of a selected body resizes it.
  void press(PointerButton button, bool shift, Vec2d at) override;
  void drag(Vec2d to) override;
  void release(Vec2d at) override;
  bool dragging() const override { return hold_ != Hold::nothing; }
  void wheel(double steps, Vec2d at) override;  // over the selected body: larger and smaller
  void fly(double, double, double) override {}
  void set_moving(bool moving) override;

  // For an animated file. Animated bodies move as the file says. Bodies that were changed here and are not animated stay unchanged.
  double duration() const override { return duration_; }
  double time() const override { return time_; }
  void set_time(double seconds) override;

  const PlaneScene& scene() const { return sheet_.scene; }
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
  std::optional<Vec2d> resize_handle() const;  // in pixels: the lower right corner of the selected body

  const std::string& path() const override { return path_; }
  bool unsaved() const override { return open_.has_value() || before_.size() != saved_steps_; }
  bool file_changed() const override;
  void reload() override;
  void save_scene(const std::string& path) override;
  void save_picture(const std::string& path, float exposure_stops, ToneCurve curve) override;

 private:
  struct Sheet {
    PlaneScene scene;         // scene with the edits
    PlaneScene moment;        // moment of an animated file, without edits
    std::vector<int> origin;  // for each body of scene its index in moment; -1: added here
  };
  void load();
  Sheet fresh_sheet(PlaneScene scene) const;
  void show();
  void show_again();
  void show_time();
  void close_step();

  std::string path_;
  Sheet sheet_;
  std::optional<PlaneAnimation> animation_;
  double duration_ = 0, time_ = 0;
  bool endless_ = false, time_wanted_ = false;  // time_wanted_: the moment differs from that of sheet_
  std::filesystem::file_time_type file_time_{};
  int width_, height_;
  std::optional<std::size_t> selection_;
  // States before the steps that can be undone, and after those that can be redone. open_ is the state before the current step.
  std::vector<Sheet> before_, after_;
  std::optional<Sheet> open_;
  std::size_t saved_steps_ = 0;  // size of before_ when it was saved

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
