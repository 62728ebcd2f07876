// Session: an interactive scene: its document, camera, selection and picture. A window, a script and a test use the same calls.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "paint/fitter.h"
#include "gizmo.h"
#include "document/outline.h"
#include "pick.h"
#include "scene/gltf/gltf_animation.h"
#include "stage.h"
#include "worker.h"

namespace steradian::view {

struct Selection {
  int node = -1;      // node of the document; -1: nothing
  int material = -1;  // material of the picked mesh; -1: a lamp without one
};

struct CornerPlace {
  std::size_t contour = 0, corner = 0;
  bool operator==(const CornerPlace&) const = default;
};

class Session : public Stage {
 public:
  // Throws Error if the file cannot be read. Problems of its scene appear in message() after the first picture was tried.
  Session(const std::string& path, RenderOptions options, Worker::Render render = {});

  bool update() override;
  void wait_until_settled() override;
  bool settled() const override { return settled_ && !fitting(); }
  const Picture& picture() const override { return frame_.picture; }
  const RenderedFrame& frame() const { return frame_; }

  // The options of the picture: method, shadows, size and so on. Call changed() after a change.
  RenderOptions& options() { return options_; }
  std::optional<RenderOptions>& other() { return other_; }
  void resize(int width, int height) override;
  Vec2d size() const { return {static_cast<double>(options_.width), static_cast<double>(options_.height)}; }
  void changed() { ++wanted_; }
  void set_moving(bool moving) override;

  // The pointer. On a handle it drags the selected object. Otherwise left orbits, or selects if the pointer has not moved. Middle, and left
  // with shift, pans; right looks around.
  void press(PointerButton button, bool shift, Vec2d at) override;
  void drag(Vec2d to) override;
  void release(Vec2d at) override;
  void wheel(double steps, Vec2d at) override;
  void fly(double right, double up, double forward) override;
  Handle handle_under(Vec2d at) const;
  bool dragging() const override { return button_.has_value(); }
  Handle dragged_handle() const { return handle_; }

  bool has_camera() const { return camera_.has_value(); }
  ViewCamera& camera() { return *camera_; }  // valid if has_camera(); call changed() after a change
  Camera shown_camera() const { return camera_->camera(); }
  void frame_selected() override;  // orbits about the selected object, or the whole scene
  void reset_camera() override;

  EditedDocument& document() { return *document_; }
  const NodeTree& tree() const;            // nodes of the document in its present state
  const std::vector<Lamp>& lamps() const;  // lamps of the document in its present state
  const Selection& selection() const { return selection_; }
  void select(Selection selection) {
    selection_ = selection;
    corner_.reset();
  }
  void select_named(const std::string& name) override;
  void deselect() override { selection_ = {}; }
  // The corners in world space of a selected lamp that is a polygon, contour after contour. A press takes a corner. A drag carries it over
  // the polygon's plane as long as the outline does not cross itself.
  const std::vector<std::vector<Vec3d>>& corners() const;
  std::optional<CornerPlace> corner_under(Vec2d at) const;
  std::optional<CornerPlace> corner() const;  // the corner taken last
  void add_corner();                          // at the middle of the edge after the taken corner; takes the new corner
  void remove_corner();

  GizmoMode gizmo_mode = GizmoMode::move;
  std::optional<Gizmo> gizmo() const;  // the handles of the selected object

  // The displayed moment of the file's animation; nothing if it has none.
  const std::vector<scene::GltfAnimation>& animations() const { return animations_; }
  std::size_t animation() const { return animation_; }
  void choose_animation(std::size_t animation);
  double duration() const override { return animations_.empty() ? 0 : animations_[animation_].duration; }
  double time() const override { return time_; }
  void set_time(double seconds) override;

  // With the brush, a left drag paints strokes of a wanted radiance. A fit moves the lights towards them, in the background: its steps are
  // one step of undo, and any other change ends it.
  Brush brush;
  FitChoice fit_choice;
  bool fits_at_once = true;  // after each stroke
  void take_brush(bool on);
  const std::vector<PaintStroke>& strokes() const { return strokes_; }
  void remove_stroke();  // the last one
  void clear_strokes() { strokes_.clear(); }
  void fit();
  void stop_fit();
  bool fitting() const { return fitter_.running(); }
  const std::string& fit_state() const { return fit_state_; }  // of the fit that runs or ran last; empty: none

  void add_light(const std::string& type);  // above the orbited point, and selected; polygon: with five corners
  void remove_selected() override;
  void undo() override;
  void redo() override;

  const std::string& path() const override { return document_->file().path; }
  void reload() override;  // keeps the camera; throws Error and changes nothing
  bool unsaved() const override { return !document_->saved(); }
  bool file_changed() const override;
  void save_scene(const std::string& path) override;
  void save_picture(const std::string& path, float exposure_stops, ToneCurve curve) override;

 private:
  Ray ray(Vec2d at) const { return ray_through(camera_->camera(), at, size().x, size().y); }
  void submit();
  bool moves() const { return moving_ || fitting(); }
  void take_document(std::unique_ptr<EditedDocument> document);
  Json shown_json() const;  // the document at the displayed moment
  void click(Vec2d at);
  void paint(Vec2d at);
  bool take_fit();  // true if lights have moved
  void drag_handle(Vec2d to);
  const Lamp* selected_mesh() const;  // null if no emitting mesh is selected
  void drag_corner(Vec2d to);
  bool put_corners(const Outline& outline, Vec3d taken);

  std::unique_ptr<EditedDocument> document_;
  RenderOptions options_;
  std::optional<RenderOptions> other_;
  std::optional<ViewCamera> camera_;
  std::optional<Camera> first_camera_;
  Selection selection_;
  std::filesystem::file_time_type file_time_{};

  std::uint64_t wanted_ = 1, submitted_ = 0, request_ = 0;
  std::uint64_t lost_at_ = 0;  // the request in which the device was lost; later frames keep the message
  // Offsets that give the revisions of another document, and other moments, different numbers.
  std::uint64_t base_revision_ = 0, source_ = 0;
  std::vector<scene::GltfAnimation> animations_;
  std::size_t animation_ = 0;
  double time_ = 0;
  mutable std::optional<NodeTree> tree_;
  mutable std::vector<Lamp> lamps_;  // lamps of tree_
  mutable std::uint64_t tree_revision_ = 0;
  bool moving_ = false, submitted_moving_ = false, settled_ = false;
  RenderedFrame frame_;

  // State of a drag since its beginning.
  std::optional<PointerButton> button_;
  bool shift_ = false, moved_ = false;
  Vec2d pressed_, last_;
  Handle handle_ = Handle::none;
  Gizmo drag_gizmo_;
  NodePose drag_pose_;
  Affine drag_parent_;
  std::optional<CornerPlace> corner_;
  std::optional<CornerPlace> drags_corner_;  // corner of drag_outline_
  Outline drag_outline_;

  // Outline and corners of the selected object, with the revision and node that they belong to.
  mutable std::optional<Outline> outline_;
  mutable std::vector<std::vector<Vec3d>> corners_;
  mutable std::pair<std::uint64_t, int> corners_of_{0, -1};

  std::vector<PaintStroke> strokes_;
  bool painting_ = false;  // the drag is a stroke
  std::string fit_state_;
  bool fit_applied_ = false;        // the open step of undo is the fit's
  std::uint64_t fit_revision_ = 0;  // of the document, after the latest step of the fit

  Worker worker_;
  Fitter fitter_;
};

}  // namespace steradian::view
