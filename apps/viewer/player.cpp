#include "player.h"

#include <filesystem>

#include "core/words.h"
#include "steradian/error.h"

namespace steradian::view {
namespace {

double number_of(const std::string& what, const nlohmann::json& value) {
  if (!value.is_number()) throw Error("set " + what, "needs a number");
  return value.get<double>();
}

Vec3d three_of(const std::string& what, const nlohmann::json& value) {
  if (!value.is_array() || value.size() != 3) throw Error("set " + what, "needs three numbers, as in [1, 0.5, 0]");
  return {number_of(what, value[0]), number_of(what, value[1]), number_of(what, value[2])};
}

std::string text_of(const std::string& what, const nlohmann::json& value) {
  if (!value.is_string()) throw Error("set " + what, "needs a text");
  return value.get<std::string>();
}

// True if it was a value of a lamp.
bool set_of_lamp(LampValues& v, const std::string& what, const nlohmann::json& value) {
  if (what == "intensity")
    v.intensity = number_of(what, value);
  else if (what == "color")
    v.color = three_of(what, value);
  else if (what == "type" && v.type)
    v.type = text_of(what, value);
  else if (what == "size" && v.size)
    v.size = number_of(what, value);
  else if (what == "aspect" && v.aspect)
    v.aspect = number_of(what, value);
  else if (what == "length" && v.length)
    v.length = number_of(what, value);
  else if (what == "two_sided" && v.two_sided && value.is_boolean())
    v.two_sided = value.get<bool>();
  else
    return false;
  return true;
}

bool set_of_material(MaterialValues& v, const std::string& what, const nlohmann::json& value) {
  if (what == "roughness")
    v.roughness = number_of(what, value);
  else if (what == "metallic")
    v.metallic = number_of(what, value);
  else if (what == "base_color")
    v.base_color = three_of(what, value);
  else if (what == "lobe")
    v.lobe = value.is_string() ? lobe_named(text_of(what, value)) : Json(value);
  else
    return false;
  return true;
}

bool set_of_picture(ViewState& state, const std::string& what, const nlohmann::json& value) {
  if (what == "exposure") {
    state.exposure = static_cast<float>(number_of(what, value));
    state.exposure_known = state.display_wanted = true;
  } else if (what == "tone") {
    state.tone = tone_curve_named(text_of(what, value));
    state.display_wanted = true;
  } else if (what == "beside") {
    state.other_method = text_of(what, value);
    choose_other(state);
  } else if (what == "split_at") {
    state.split_at = static_cast<float>(number_of(what, value));
    state.display_wanted = true;
  } else if (what == "white_at") {
    state.error_most = static_cast<float>(number_of(what, value));
    state.display_wanted = true;
  } else if (what == "scene_name") {
    state.scene_name = text_of(what, value);
  } else if (what == "picture_name") {
    state.picture_name = text_of(what, value);
  } else {
    return false;
  }
  return true;
}

bool set_of_brush(Session& s, const std::string& what, const nlohmann::json& value) {
  if (what == "brush") {
    s.brush.radius = number_of(what, value);
    if (!(s.brush.radius > 0 && s.brush.radius <= 1000)) throw Error("set brush", "needs a radius above 0", "at most 1000 pixels");
  } else if (what == "wanted") {
    s.brush.radiance = value.is_number() ? Vec3d{1, 1, 1} * number_of(what, value) : three_of(what, value);
    const Vec3d& r = s.brush.radiance;
    if (!(r.x >= 0 && r.y >= 0 && r.z >= 0)) throw Error("set wanted", "needs a radiance of 0 or more");
  } else if (what == "part") {
    const auto part = words::find<LightPart>(text_of(what, value));
    if (!part) throw Error("set part", text_of(what, value) + " is none", words::choices<LightPart>());
    s.brush.part = *part;
  } else if (what == "fit") {
    FitChoice choice{false};
    choice.selected = s.fit_choice.selected;
    for (const auto& word : value.is_array() ? value : nlohmann::json::array({value})) {
      const std::string name = text_of(what, word);
      bool* const set = name == "power"      ? &choice.power
                        : name == "color"    ? &choice.color
                        : name == "position" ? &choice.position
                        : name == "rotation" ? &choice.rotation
                        : name == "size"     ? &choice.size
                        : name == "vertices" ? &choice.vertices
                                             : nullptr;
      if (set == nullptr) throw Error("set fit", name + " is not a parameter", "power, color, position, rotation, size and vertices are");
      *set = true;
    }
    s.fit_choice = choice;
  } else if (what == "fit_selected" && value.is_boolean()) {
    s.fit_choice.selected = value.get<bool>();
  } else if (what == "fit_at_once" && value.is_boolean()) {
    s.fits_at_once = value.get<bool>();
  } else {
    return false;
  }
  return true;
}

bool set_of_session(Session& s, const std::string& what, const nlohmann::json& value) {
  if (set_of_brush(s, what, value)) return true;
  if (what == "add") {
    s.add_light(text_of(what, value));
    return true;
  }
  if (what == "material") {
    const double material = number_of(what, value);
    if (!(material >= 0 && material < static_cast<double>(s.document().count("/materials"))))
      throw Error("set material", "there is none of that number");
    s.select({s.selection().node, static_cast<int>(material)});
    return true;
  }
  if (what == "method") {
    s.options().method = text_of(what, value);
    return true;
  }
  if (const int node = s.selection().node; what == "position" && node >= 0) {
    const Vec3d by = three_of(what, value) - s.tree().world(node).t;
    set_pose(s.document(), node, moved(pose_of(s.document(), node), s.tree().parent_world(node), by));
    return true;
  }
  for (const Lamp& lamp : s.lamps())
    if (lamp.node == s.selection().node) {
      LampValues values = values_of(s.document(), lamp);
      if (!set_of_lamp(values, what, value)) continue;
      set_values(s.document(), lamp, values);
      return true;
    }
  if (s.selection().material < 0) return false;
  MaterialValues values = material_values(s.document(), s.selection().material);
  if (!set_of_material(values, what, value)) return false;
  set_material_values(s.document(), s.selection().material, values);
  return true;
}

bool set_of_drawing(DrawingStage& d, const std::string& what, const nlohmann::json& value) {
  if (!d.selection()) return false;
  PlaneBody body = d.scene().bodies[*d.selection()];
  if (what == "color" && body.light)
    body.light->radiance = three_of(what, value);
  else if (what == "color")
    body.color = three_of(what, value);
  else if (what == "scale")
    body = scaled(body, bounds_of(body).center(), number_of(what, value));
  else if (what == "turn")
    body = turned(body, bounds_of(body).center(), number_of(what, value) * 3.14159265358979324 / 180);
  else
    return false;
  d.change(*d.selection(), std::move(body));
  return true;
}

std::string beside(const std::string& path, const std::string& ending) {
  std::filesystem::path p(path);
  return p.stem().string() + "-view" + (ending.empty() ? p.extension().string() : ending);
}

}  // namespace

void open_stage(ViewState& state, const std::string& path, const RenderOptions& options) {
  if (path.ends_with(".svg")) {
    auto drawing = std::make_unique<DrawingStage>(path, options.width, options.height, options.threads);
    state.session = nullptr;
    state.drawing = drawing.get();
    state.stage = std::move(drawing);
  } else {
    auto session = std::make_unique<Session>(path, options);
    state.drawing = nullptr;
    state.session = session.get();
    state.stage = std::move(session);
  }
  state.scene_name = beside(path, "");
  state.picture_name = beside(path, ".png");
  state.history.clear();
  state.playing = false;
  if (state.split || state.error_map) choose_other(state);
}

void choose_other(ViewState& state) {
  if (state.session == nullptr) return;
  Session& s = *state.session;
  if (state.split || state.error_map) {
    RenderOptions other = s.options();
    other.method = state.other_method;
    s.other() = other;
  } else {
    s.other().reset();
  }
  s.changed();
  state.display_wanted = true;
}

void set_value(ViewState& state, const std::string& what, const nlohmann::json& value) {
  if (what == "time") return state.stage->set_time(number_of(what, value));
  if (set_of_picture(state, what, value)) return;
  if (state.drawing != nullptr && set_of_drawing(*state.drawing, what, value)) return;
  if (state.session == nullptr || !set_of_session(*state.session, what, value))
    throw Error("set " + what, "is no value of what is selected", "docs/view-scripts.md lists them");
  state.session->document().close_step();
  state.session->changed();
}

void follow_file(ViewState& state) {
  if (!state.stage->file_changed()) return;
  if (state.stage->unsaved())
    state.stage->say(state.stage->path() + " has changed: F5 reads it again, and drops what was changed here and not saved");
  else
    attempt(state, [&] { state.stage->reload(); });
}

void act(ViewState& state, Action action) {
  Stage& stage = *state.stage;
  Session* s = state.session;
  switch (action) {
    case Action::help: state.help = !state.help; break;
    case Action::panel: state.panel = !state.panel; break;
    case Action::gizmo_move:
      if (s != nullptr) s->gizmo_mode = GizmoMode::move;
      break;
    case Action::gizmo_turn:
      if (s != nullptr) s->gizmo_mode = GizmoMode::turn;
      break;
    case Action::gizmo_scale:
      if (s != nullptr) s->gizmo_mode = GizmoMode::scale;
      break;
    case Action::frame_selected: stage.frame_selected(); break;
    case Action::reset_camera: stage.reset_camera(); break;
    case Action::add_light:
      if (s != nullptr) s->add_light("rect");
      if (state.drawing != nullptr)
        state.drawing->add(true, state.drawing->to_pixel(state.drawing->scene().origin +
                                                         Vec2d{state.drawing->scene().width, state.drawing->scene().height} / 2));
      break;
    case Action::remove: stage.remove_selected(); break;
    case Action::deselect: stage.deselect(); break;
    case Action::undo: attempt(state, [&] { stage.undo(); }); break;
    case Action::redo: attempt(state, [&] { stage.redo(); }); break;
    case Action::save_scene: attempt(state, [&] { stage.save_scene(state.scene_name); }); break;
    case Action::save_picture: attempt(state, [&] { stage.save_picture(state.picture_name, state.exposure, state.tone); }); break;
    case Action::reload: attempt(state, [&] { stage.reload(); }); break;
    case Action::split:
      state.split = !state.split;
      choose_other(state);
      break;
    case Action::error_map:
      state.error_map = !state.error_map;
      choose_other(state);
      break;
    case Action::bounce:
      if (s != nullptr) {
        RenderOptions& options = s->options();
        options.indirect.mode = IndirectMode::off;
        options.bounces = options.bounces == 0 ? kAllBounces : 0;
        choose_other(state);
      }
      break;
    case Action::paint:
      if (s != nullptr) s->take_brush(!s->brush.on);
      break;
    case Action::fit:
      if (s != nullptr) s->fitting() ? s->stop_fit() : s->fit();
      break;
    case Action::remove_stroke:
      if (s != nullptr) s->remove_stroke();
      break;
    case Action::play: state.playing = !state.playing && stage.duration() > 0; break;
    case Action::fly: break;  // the window handles it while the key is held
    case Action::quit: state.quit = true; break;
  }
}

}  // namespace steradian::view
