#include "session.h"

#include <cmath>
#include <cstdio>
#include <utility>

#include "steradian/error.h"

namespace steradian::view {
namespace {

std::filesystem::file_time_type scene_time(const std::string& path) {
  std::error_code ignored;
  return std::filesystem::last_write_time(path, ignored);
}

Vec3d middle_of(const Scene& scene) { return (scene.bounds_min + scene.bounds_max) * 0.5; }

// The distance to the point that a camera first orbits: the surface in the middle of its picture, or else the middle of the scene.
double distance_of_view(const Scene& scene, const Camera& camera) {
  if (const auto hit = pick(scene, {camera.position, -camera.z})) return hit->distance;
  const double d = dot(camera.position - middle_of(scene), camera.z);
  return d > 0 ? d : std::max(length(scene.bounds_max - scene.bounds_min), 1.0);
}

}  // namespace

Session::Session(const std::string& path, RenderOptions options, Worker::Render render)
    : options_(std::move(options)), worker_(std::move(render)) {
  take_document(std::make_unique<EditedDocument>(scene::read_gltf_file(path)));
}

void Session::take_document(std::unique_ptr<EditedDocument> document) {
  std::vector<scene::GltfAnimation> animations = read_animations(document->file());
  if (document_) base_revision_ += document_->revision() + 1;
  ++source_;
  fitter_.stop();
  fit_applied_ = false;
  strokes_.clear();
  document_ = std::move(document);
  animations_ = std::move(animations);
  if (animation_ >= animations_.size()) animation_ = 0;
  file_time_ = scene_time(this->path());
  changed();
}

Json Session::shown_json() const {
  return animations_.empty() ? document_->json() : json_at(document_->json(), animations_[animation_], time_);
}

// ---- pictures

void Session::submit() {
  const bool same = submitted_ == wanted_ && submitted_moving_;
  submitted_ = wanted_;
  RenderRequest request{document_->file(), base_revision_ + document_->revision(), source_, {}, options_, other_, moves()};
  request.file.json = shown_json();
  request.refine = same && !moves() && frame_.request == request_;
  if (camera_) {
    request.camera = as_read(camera_->camera());
    request.file = with_camera(std::move(request.file), camera_->camera());
    request.options.camera.clear();
    if (request.other) request.other->camera.clear();
  }
  request_ = worker_.submit(std::move(request));
  submitted_moving_ = moves();
  settled_ = false;
}

bool Session::update() {
  bool fresh = false;
  if (take_fit()) changed();
  if (auto frame = worker_.take()) {
    if (!frame->error.empty()) {
      say(frame->error);
      if (frame->request == request_) settled_ = true;
    } else {
      if (frame->request == request_ && frame->load_ms > 0 && frame->request != lost_at_) say({});
      settled_ = frame->request == request_ && frame->last && submitted_ == wanted_ && !moves();
      if (!frame->device_lost.empty() && options_.backend != Backend::cpu) {
        options_.backend = Backend::cpu;
        lost_at_ = frame->request;
        if (other_) other_->backend = Backend::cpu;
        say(frame->device_lost + "; the CPU goes on");
      }
      frame_ = std::move(*frame);
      fresh = true;
      if (!camera_) {
        first_camera_ = frame_.camera;
        camera_.emplace(frame_.camera, distance_of_view(frame_.scene->scene, frame_.camera));
      }
    }
  }
  if (submitted_ != wanted_ || (submitted_moving_ && !moves())) try {
      submit();
    } catch (const std::exception& e) {  // the file is too broken to contain a camera
      say(e.what());
      submitted_moving_ = moves();
      settled_ = true;
    }
  return fresh;
}

void Session::wait_until_settled() {
  do {
    update();
    if (fitting())
      fitter_.wait();
    else if (!settled_)
      worker_.wait();
  } while (fitting() || !settled_);
}

void Session::resize(int width, int height) {
  if (width < 1 || height < 1 || (width == options_.width && height == options_.height)) return;
  options_.width = width;
  options_.height = height;
  if (other_) {
    other_->width = width;
    other_->height = height;
  }
  changed();
}

void Session::set_moving(bool moving) {
  if (moving_ && !moving) document_->close_step();
  moving_ = moving;
}

const NodeTree& Session::tree() const {
  const std::uint64_t now = base_revision_ + document_->revision();
  if (tree_ && tree_revision_ == now) return *tree_;
  tree_revision_ = now;
  lamps_.clear();
  try {
    tree_.emplace(shown_json(), path());
    lamps_ = lamps_of(*document_, *tree_);
  } catch (const std::exception&) {
    tree_.emplace();  // the file is broken; message() tells it when it is read
  }
  return *tree_;
}

const std::vector<Lamp>& Session::lamps() const {
  tree();
  return lamps_;
}

// ---- the pointer

std::optional<Gizmo> Session::gizmo() const {
  if (!camera_ || selection_.node < 0) return {};
  if (!tree().contains(selection_.node)) return {};
  return gizmo_at(gizmo_mode, tree().world(selection_.node), camera_->camera());
}

Handle Session::handle_under(Vec2d at) const {
  const auto handles = gizmo();
  return handles ? handle_at(*handles, camera_->camera(), at, size().x, size().y) : Handle::none;
}

void Session::press(PointerButton button, bool shift, Vec2d at) {
  if (!camera_ || button_) return;
  button_ = button;
  shift_ = shift;
  moved_ = false;
  pressed_ = last_ = at;
  drags_corner_.reset();
  handle_ = Handle::none;
  painting_ = brush.on && button == PointerButton::left && !shift;
  if (painting_) {
    stop_fit();
    strokes_.push_back({camera_->camera(), options_.width, options_.height, {}, {}, brush.radius, brush.radiance, brush.part});
    return paint(at);
  }
  if (const auto corner = button == PointerButton::left && !shift ? corner_under(at) : std::nullopt) {
    corner_ = drags_corner_ = corner;
    drag_outline_ = *outline_;
    return;
  }
  handle_ = button == PointerButton::left && !shift ? handle_under(at) : Handle::none;
  if (handle_ == Handle::none) return;
  drag_gizmo_ = *gizmo();
  drag_pose_ = pose_of(*document_, selection_.node);
  drag_parent_ = tree().parent_world(selection_.node);
}

void Session::drag_handle(Vec2d to) {
  const Camera& camera = camera_->camera();
  const Ray from = ray(pressed_), towards = ray(to);
  NodePose pose = drag_pose_;
  switch (drag_gizmo_.mode) {
    case GizmoMode::move: {
      const auto by = drag_move(drag_gizmo_, handle_, camera, from, towards);
      if (!by) return;
      pose = moved(pose, drag_parent_, *by);
      break;
    }
    case GizmoMode::turn: {
      const auto turn = drag_turn(drag_gizmo_, handle_, camera, from, towards);
      if (!turn) return;
      pose = turned(pose, drag_parent_, turn->axis, turn->angle);
      break;
    }
    case GizmoMode::scale: {
      const auto factors = drag_scale(drag_gizmo_, handle_, camera, from, towards);
      if (!factors) return;
      pose = scaled(pose, *factors);
      break;
    }
  }
  set_pose(*document_, selection_.node, pose);
}

void Session::drag(Vec2d to) {
  if (!button_) return;
  if (painting_) return paint(to);
  constexpr double kClick = 3;  // tolerance of a click in pixels
  if (!moved_ && length(to - pressed_) <= kClick) return;
  moved_ = true;
  set_moving(true);
  const Vec2d by = (to - last_) / size().y;
  last_ = to;
  if (drags_corner_)
    drag_corner(to);
  else if (handle_ != Handle::none)
    drag_handle(to);
  else if (*button_ == PointerButton::right)
    camera_->look(by.x, by.y);
  else if (*button_ == PointerButton::middle || shift_)
    camera_->pan(by.x, by.y);
  else
    camera_->orbit(by.x, by.y);
  changed();
}

void Session::release(Vec2d at) {
  if (!button_) return;
  drag(at);
  if (std::exchange(painting_, false)) {
    button_.reset();
    if (fits_at_once) fit();
    return;
  }
  if (!moved_ && *button_ == PointerButton::left && handle_ == Handle::none && !drags_corner_) click(at);
  button_.reset();
  drags_corner_.reset();
  handle_ = Handle::none;
  set_moving(false);
}

// ---- corners

const Lamp* Session::selected_mesh() const {
  for (const Lamp& lamp : lamps())
    if (lamp.node == selection_.node && lamp.kind == LampKind::mesh) return &lamp;
  return nullptr;
}

const std::vector<std::vector<Vec3d>>& Session::corners() const {
  const std::pair<std::uint64_t, int> now{base_revision_ + document_->revision(), selection_.node};
  if (corners_of_ == now) return corners_;
  corners_of_ = now;
  corners_.clear();
  const Lamp* lamp = selected_mesh();
  outline_ = lamp != nullptr ? outline_of(*document_, *lamp) : std::nullopt;
  if (!outline_) return corners_;
  for (const auto& contour : outline_->contours) {
    auto& world = corners_.emplace_back();
    for (const Vec3d& p : contour) world.push_back(tree().world(lamp->node).point(p));
  }
  return corners_;
}

std::optional<CornerPlace> Session::corner_under(Vec2d at) const {
  if (!camera_) return {};
  std::optional<CornerPlace> best;
  double nearest = 7;  // pixels
  for (std::size_t i = 0; i < corners().size(); ++i)
    for (std::size_t k = 0; k < corners()[i].size(); ++k) {
      const auto seen = project(camera_->camera(), corners()[i][k], size().x, size().y);
      if (!seen || length(*seen - at) >= nearest) continue;
      nearest = length(*seen - at);
      best = CornerPlace{i, k};
    }
  return best;
}

std::optional<CornerPlace> Session::corner() const {
  if (!corner_ || corner_->contour >= corners().size() || corner_->corner >= corners()[corner_->contour].size()) return {};
  return corner_;
}

// The outline is read back from its triangles. It may start at another corner, and corners on a straight line are dropped.
bool Session::put_corners(const Outline& outline, Vec3d taken) {
  const Lamp* lamp = selected_mesh();
  if (lamp == nullptr || !set_outline(*document_, *lamp, outline)) return false;
  corner_.reset();
  corners();
  double nearest = 0;
  for (const auto& contour : outline.contours)
    for (const Vec3d& p : contour) nearest = std::max({nearest, std::fabs(p.x), std::fabs(p.y), std::fabs(p.z)});
  nearest *= 1e-6;  // vertices are single precision
  for (std::size_t i = 0; outline_ && i < outline_->contours.size(); ++i)
    for (std::size_t k = 0; k < outline_->contours[i].size(); ++k)
      if (const double away = length(outline_->contours[i][k] - taken); away <= nearest) {
        nearest = away;
        corner_ = CornerPlace{i, k};
      }
  changed();
  return true;
}

void Session::drag_corner(Vec2d to) {
  const Affine& world = tree().world(selection_.node);
  if (!(std::fabs(world.determinant()) > 0)) return;
  Vec3d& corner = drag_outline_.contours[drags_corner_->contour][drags_corner_->corner];
  const Vec3d before = corner, at = world.point(before), normal = normalized(world.normal(drag_outline_.normal));
  const auto met = meets_plane(at, normal, ray(to));
  if (!met) return;
  corner = inverse(world).point(*met);
  if (!put_corners(drag_outline_, corner)) corner = before;  // keeps the last position at which the outline was valid
}

void Session::add_corner() {
  if (!corner()) return;
  constexpr double kOut = 1e-3;  // fraction of the edge: a corner exactly on it would not count
  Outline outline = *outline_;
  auto& contour = outline.contours[corner_->contour];
  const Vec3d from = contour[corner_->corner], to = contour[(corner_->corner + 1) % contour.size()];
  const Vec3d added = (from + to) * 0.5 + cross(to - from, outline.normal) * kOut;
  contour.insert(contour.begin() + static_cast<std::ptrdiff_t>(corner_->corner) + 1, added);
  if (put_corners(outline, added)) document_->close_step();
}

void Session::remove_corner() {
  if (!corner()) return;
  Outline outline = *outline_;
  auto& contour = outline.contours[corner_->contour];
  if (contour.size() > 3)
    contour.erase(contour.begin() + static_cast<std::ptrdiff_t>(corner_->corner));
  else if (corner_->contour > 0)
    outline.contours.erase(outline.contours.begin() + static_cast<std::ptrdiff_t>(corner_->contour));  // a hole of three corners
  else
    return;
  const Vec3d removed = outline_->contours[corner_->contour][corner_->corner];
  if (put_corners(outline, removed)) document_->close_step();
}

void Session::click(Vec2d at) {
  corner_.reset();
  if (!frame_.scene) return;
  // Lamps without an extent are marks in the picture.
  constexpr double kMark = 10;
  const NodeTree& nodes = tree();
  for (const Lamp& lamp : lamps()) {
    if (lamp.kind != LampKind::punctual && lamp.kind != LampKind::profile) continue;
    const auto mark = project(camera_->camera(), nodes.world(lamp.node).t, size().x, size().y);
    if (mark && length(*mark - at) <= kMark) {
      selection_ = {lamp.node, -1};
      return;
    }
  }
  const LoadedScene& loaded = *frame_.scene;
  const auto hit = pick(loaded.scene, ray(at));
  selection_ = {};
  if (!hit || hit->mesh >= loaded.mesh_nodes.size()) return;
  if (!tree().contains(loaded.mesh_nodes[hit->mesh])) return;  // the picture is older than the file
  selection_.node = loaded.mesh_nodes[hit->mesh];
  const Mesh& mesh = loaded.scene.meshes[hit->mesh];
  if (!mesh.is_light_shape && static_cast<std::size_t>(mesh.material) < document_->count("/materials")) selection_.material = mesh.material;
}

void Session::wheel(double steps, Vec2d) {
  if (!camera_) return;
  camera_->dolly(steps);
  changed();
}

// ---- the camera

void Session::fly(double right, double up, double forward) {
  if (!camera_) return;
  camera_->fly(right, up, forward);
  changed();
}

void Session::frame_selected() {
  if (!camera_ || !frame_.scene) return;
  camera_->look_at(selection_.node >= 0 ? tree().world(selection_.node).t : middle_of(frame_.scene->scene));
  changed();
}

void Session::reset_camera() {
  if (!camera_ || !frame_.scene) return;
  camera_.emplace(*first_camera_, distance_of_view(frame_.scene->scene, *first_camera_));
  changed();
}

// ---- time

void Session::choose_animation(std::size_t animation) {
  if (animation >= animations_.size()) return;
  animation_ = animation;
  set_time(0);
}

void Session::set_time(double seconds) {
  if (animations_.empty()) return;
  const double end = animations_[animation_].duration;
  time_ = end > 0 && seconds > end ? std::fmod(seconds, end) : std::max(seconds, 0.0);
  ++base_revision_;
  changed();
}

// ---- edits

void Session::select_named(const std::string& name) {
  selection_ = {};
  for (const Lamp& lamp : lamps())
    if (lamp.name == name) {
      selection_ = {lamp.node, -1};
      return;
    }
  for (const scene::GltfNode& node : tree().visible())
    if (const Json* found = document_->find("/nodes/" + std::to_string(node.index) + "/name");
        found != nullptr && found->is_string() && found->get_ref<const std::string&>() == name) {
      selection_ = {node.index, -1};
      return;
    }
}

void Session::add_light(const std::string& type) {
  if (!camera_) return;
  const double size = camera_->distance() / 5;
  const Vec3d position = camera_->target() + Vec3d{0, 1, 0} * (camera_->distance() / 3);
  select({type == "polygon" ? add_polygon_light(*document_, position, {0, -1, 0}, size)
                            : view::add_light(*document_, type, position, {0, -1, 0}, size),
          -1});
  document_->close_step();
  changed();
}

void Session::remove_selected() {
  for (const Lamp& lamp : lamps())
    if (lamp.node == selection_.node) {
      remove_lamp(*document_, lamp);
      document_->close_step();
      selection_ = {};
      changed();
      return;
    }
}

void Session::undo() {
  stop_fit();
  document_->undo();
  if (!tree().contains(selection_.node)) selection_ = {};
  changed();
}

void Session::redo() {
  stop_fit();
  document_->redo();
  changed();
}

// ---- files

void Session::reload() {
  take_document(std::make_unique<EditedDocument>(scene::read_gltf_file(path())));
  if (!tree().contains(selection_.node)) selection_ = {};
}

bool Session::file_changed() const {
  const auto now = scene_time(document_->file().path);
  return now != std::filesystem::file_time_type{} && now != file_time_;
}

void Session::save_scene(const std::string& path) {
  document_->close_step();
  write_gltf_file(with_camera(document_->file(), camera_ ? camera_->camera() : Camera{}), path);
  document_->mark_saved();
  if (std::filesystem::weakly_canonical(path) == std::filesystem::weakly_canonical(document_->file().path)) file_time_ = scene_time(path);
}

void Session::save_picture(const std::string& path, float exposure_stops, ToneCurve curve) {
  wait_until_settled();
  if (!frame_.last) throw Error(path, "there is no picture to save", message());
  write_picture(frame_.picture, path, exposure_stops, curve);
}

}  // namespace steradian::view
