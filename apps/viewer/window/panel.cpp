// The panel: lights, the selection, render options, files, times.
#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "core/words.h"
#include "integrals/methods.h"
#include "keys.h"
#include "steradian/bounces.h"
#include "view_state.h"

namespace steradian::view {
namespace {

// ImGui works in float; an untouched value keeps its double precision.
bool drag_double(const char* label, double& value, float speed, double low, double high, const char* format = "%.3g") {
  auto v = static_cast<float>(value);
  if (!ImGui::DragFloat(label, &v, speed, static_cast<float>(low), static_cast<float>(high), format, ImGuiSliderFlags_AlwaysClamp))
    return false;
  value = static_cast<double>(v);
  return true;
}

bool edit_color(const char* label, Vec3d& color) {
  float c[3] = {static_cast<float>(color.x), static_cast<float>(color.y), static_cast<float>(color.z)};
  if (!ImGui::ColorEdit3(label, c, ImGuiColorEditFlags_Float)) return false;
  color = {std::max(0.0, static_cast<double>(c[0])), std::max(0.0, static_cast<double>(c[1])), std::max(0.0, static_cast<double>(c[2]))};
  return true;
}

// Chooses one of some names; true if the choice changed.
template <class Names>
bool choose_name(const char* label, const Names& names, std::string& chosen) {
  bool changed = false;
  if (!ImGui::BeginCombo(label, chosen.c_str())) return false;
  for (const std::string_view each : names) {
    const std::string name(each);
    if (ImGui::Selectable(name.c_str(), name == chosen) && name != chosen) {
      chosen = name;
      changed = true;
    }
  }
  ImGui::EndCombo();
  return changed;
}

// The same for the words of an option.
template <class Value>
bool choose_word(const char* label, Value& chosen) {
  std::string name = words::name_of(chosen);
  if (!choose_name(label, words::names<Value>(), name)) return false;
  chosen = *words::find<Value>(name);
  return true;
}

bool edit_area_shape(const Lamp& lamp, LampValues& v) {
  constexpr const char* kShapes[] = {"rect", "disk", "sphere", "capsule"};
  constexpr const char* kKinds[] = {"point", "spot", "directional"};
  bool changed = false;
  if (v.type && lamp.kind == LampKind::area) changed |= choose_name("shape", kShapes, *v.type);
  if (v.type && lamp.kind == LampKind::punctual) changed |= choose_name("kind", kKinds, *v.type);
  if (v.size) changed |= drag_double("size", *v.size, 0.01f, 1e-4, 1e6);
  if (v.aspect) changed |= drag_double("aspect", *v.aspect, 0.01f, 1e-3, 1e3);
  if (v.length) changed |= drag_double("length", *v.length, 0.01f, 0, 1e6);
  return changed;
}

void lamp_controls(Session& s, const Lamp& lamp) {
  LampValues v = values_of(s.document(), lamp);
  bool changed = edit_color("colour", v.color);
  changed |= drag_double(lamp.kind == LampKind::punctual ? "intensity" : "radiance", v.intensity,
                         std::max(0.01f, static_cast<float>(v.intensity) * 0.01f), 0, 1e9);
  changed |= edit_area_shape(lamp, v);
  if (v.two_sided) changed |= ImGui::Checkbox("shines both ways", &*v.two_sided);
  if (v.outer_angle) changed |= drag_double("outer angle", *v.outer_angle, 0.005f, v.inner_angle.value_or(0) + 0.01, 1.57);
  if (v.inner_angle) changed |= drag_double("inner angle", *v.inner_angle, 0.005f, 0, v.outer_angle.value_or(1.5) - 0.01);
  if (!changed) return;
  set_values(s.document(), lamp, v);
  s.changed();
}

void corner_controls(Session& s) {
  if (s.corners().empty()) return;
  const auto corner = s.corner();
  std::size_t count = 0;
  for (const auto& contour : s.corners()) count += contour.size();
  if (!corner) return ImGui::Text("%zu corners: drag one", count);
  ImGui::Text("corner %zu of %zu", corner->corner + 1, count);
  ImGui::SameLine();
  if (ImGui::SmallButton("add next")) s.add_corner();
  ImGui::SameLine();
  if (ImGui::SmallButton("remove")) s.remove_corner();
}

// Edits the keys in a lobe's JSON.
bool edit_lobe(Json& lobe) {
  bool changed = false;
  for (auto& [key, value] : lobe.items()) {
    if (value.is_boolean()) {
      bool flag = value.get<bool>();
      if (!ImGui::Checkbox(("lobe: " + key).c_str(), &flag)) continue;
      value = flag;
      changed = true;
    } else if (value.is_number()) {
      auto number = value.get<double>();
      const bool exponent = key.ends_with("exponent");
      if (!drag_double(("lobe: " + key).c_str(), number, exponent ? 1.0f : 0.005f, 0, exponent ? 1e5 : 1)) continue;
      value = number;
      changed = true;
    }
  }
  return changed;
}

bool choose_lobe(Json& lobe) {
  const std::string own = "metal and roughness";
  std::vector<std::string> names = lobe_names();
  names.insert(names.begin(), own);
  std::string name = lobe.is_null() ? own : "several";
  if (lobe.is_object()) name = lobe.value("brdf", "");
  if (!choose_name("lobe", names, name)) return lobe.is_object() && edit_lobe(lobe);
  lobe = name == own ? Json() : lobe_named(name);
  return true;
}

void material_controls(Session& s, int material) {
  MaterialValues v = material_values(s.document(), material);
  ImGui::TextUnformatted(("material: " + v.name).c_str());
  bool changed = edit_color("base colour", v.base_color);
  v.base_color = {std::min(v.base_color.x, 1.0), std::min(v.base_color.y, 1.0), std::min(v.base_color.z, 1.0)};
  changed |= drag_double("roughness", v.roughness, 0.005f, 0, 1);
  changed |= drag_double("metalness", v.metallic, 0.005f, 0, 1);
  changed |= choose_lobe(v.lobe);
  if (!changed) return;
  set_material_values(s.document(), material, v);
  s.changed();
}

// Turns about the axes of the world by the amount added while a number is held, because a rotation has no unique angles.
bool edit_turn(NodePose& pose, const Affine& parent) {
  constexpr double kDegree = 3.14159265358979324 / 180;
  constexpr Vec3d kAxes[] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  float by[3] = {};
  if (!ImGui::DragFloat3("turn", by, 0.5f, -180, 180, "%.1f")) return false;
  for (int i = 0; i < 3; ++i)
    if (by[i] != 0) pose = turned(pose, parent, kAxes[i], static_cast<double>(by[i]) * kDegree);
  return true;
}

bool edit_scale(NodePose& pose) {
  float scale[3] = {static_cast<float>(pose.scale.x), static_cast<float>(pose.scale.y), static_cast<float>(pose.scale.z)};
  if (!ImGui::DragFloat3("scale", scale, 0.005f, 0.001f, 1000, "%.3f")) return false;
  pose.scale = {static_cast<double>(scale[0]), static_cast<double>(scale[1]), static_cast<double>(scale[2])};
  return true;
}

void selected_controls(Session& s) {
  const Selection selected = s.selection();
  if (!s.tree().contains(selected.node)) {
    ImGui::TextDisabled("click on a light or a thing");
    return;
  }
  int mode = static_cast<int>(s.gizmo_mode);
  if (ImGui::Combo("handles", &mode, "move\0turn\0scale\0")) s.gizmo_mode = static_cast<GizmoMode>(mode);
  NodePose pose = pose_of(s.document(), selected.node);
  if (!pose.is_matrix) {
    bool changed = drag_double("x", pose.translation.x, 0.01f, -1e6, 1e6, "%.3f");
    changed |= drag_double("y", pose.translation.y, 0.01f, -1e6, 1e6, "%.3f");
    changed |= drag_double("z", pose.translation.z, 0.01f, -1e6, 1e6, "%.3f");
    if (edit_turn(pose, s.tree().parent_world(selected.node))) changed = true;
    changed |= edit_scale(pose);
    if (changed) {
      set_pose(s.document(), selected.node, pose);
      s.changed();
    }
  }
  for (const Lamp& lamp : s.lamps())
    if (lamp.node == selected.node) {
      ImGui::PushID(lamp.light);
      lamp_controls(s, lamp);
      ImGui::PopID();
    }
  corner_controls(s);
  if (selected.material >= 0) material_controls(s, selected.material);
}

void light_list(Session& s) {
  const std::vector<Lamp>& lamps = s.lamps();
  if (ImGui::BeginListBox("##lights",
                          {-1, std::min(8.0f, static_cast<float>(lamps.size()) + 0.5f) * ImGui::GetTextLineHeightWithSpacing()})) {
    ImGuiListClipper clipper;  // draws only the visible ones of thousands
    clipper.Begin(static_cast<int>(lamps.size()));
    while (clipper.Step())
      for (int i = clipper.DisplayStart; i < clipper.DisplayEnd; ++i) {
        const Lamp& lamp = lamps[static_cast<std::size_t>(i)];
        ImGui::PushID(i);
        if (ImGui::Selectable((lamp.name + "  (" + lamp.type + ")").c_str(), lamp.node == s.selection().node)) s.select({lamp.node, -1});
        ImGui::PopID();
      }
    ImGui::EndListBox();
  }
  for (const std::string type : {"rect", "disk", "sphere", "capsule", "polygon", "point", "spot", "directional"}) {
    if (type != "rect" && type != "polygon") ImGui::SameLine();
    if (ImGui::SmallButton(("+ " + (type == "directional" ? "sun" : type)).c_str())) s.add_light(type);
  }
  if (ImGui::SmallButton("delete")) s.remove_selected();
}

bool choose_method(const char* label, std::string& method) {
  std::vector<std::string> names = {"auto"};
  for (const methods::Row& row : methods::all()) names.emplace_back(row.name);
  return choose_name(label, names, method);
}

bool choose_light(RenderOptions& o) {
  constexpr const char *kDirect = "direct", *kAll = "all bounces", *kVirtual = "one bounce, virtual lights";
  std::string name = o.bounces != 0 ? kAll : o.indirect.mode == IndirectMode::ltc ? kVirtual : kDirect;
  if (!choose_name("light", std::array{kDirect, kAll, kVirtual}, name)) return false;
  o.bounces = name == kAll ? kAllBounces : 0;
  o.indirect.mode = name == kVirtual ? IndirectMode::ltc : IndirectMode::off;
  return true;
}

void render_controls(ViewState& state, Session& s) {
  RenderOptions& o = s.options();
  bool changed = choose_method("method", o.method);
  changed |= choose_word("quality", o.quality);
  changed |= choose_word("shadows", o.shadows);
  changed |= choose_light(o);
  if (o.indirect.mode == IndirectMode::ltc &&
      ImGui::SliderInt("virtual lights", &o.indirect.virtual_lights, 64, 1 << 20, "%d", ImGuiSliderFlags_Logarithmic))
    changed = true;
  if (ImGui::SliderInt("samples a pixel", &o.aa, 1, 16)) changed = true;

  bool other = ImGui::Checkbox("split screen", &state.split);
  ImGui::SameLine();
  other |= ImGui::Checkbox("error map", &state.error_map);
  if (state.split || state.error_map) {
    std::string& method = state.other_method;
    other |= choose_method("beside", method);
    if (const RenderedFrame& frame = s.frame(); frame.pairs > 0)
      ImGui::Text("%llu samples, standard error %.2f %%", static_cast<unsigned long long>(frame.pairs), 100 * frame.standard_error);
    if (state.split && !state.error_map && ImGui::SliderFloat("split at", &state.split_at, 0, 1)) state.display_wanted = true;
    if (state.error_map && ImGui::SliderFloat("white at", &state.error_most, 1e-4f, 10, "%.4f of the mean", ImGuiSliderFlags_Logarithmic))
      state.display_wanted = true;
  }
  if (other) choose_other(state);
  if (changed) {
    choose_other(state);
    s.changed();
  }
}

// The brush, the parameters of the fit, and its state.
void brush_controls(Session& s) {
  bool on = s.brush.on;
  if (ImGui::Checkbox("brush", &on)) s.take_brush(on);
  drag_double("radius", s.brush.radius, 0.2f, 1, 200, "%.0f pixels");
  Vec3d& wanted = s.brush.radiance;
  double value = std::max({wanted.x, wanted.y, wanted.z});
  Vec3d color = value > 0 ? wanted / value : Vec3d{1, 1, 1};
  if (drag_double("wanted", value, std::max(0.01f, static_cast<float>(value) * 0.01f), 0, 1e9)) wanted = color * value;
  if (edit_color("wanted colour", color)) wanted = color * value;
  choose_word("part", s.brush.part);
  FitChoice& c = s.fit_choice;
  ImGui::Checkbox("power", &c.power);
  ImGui::SameLine();
  ImGui::Checkbox("color", &c.color);
  ImGui::SameLine();
  ImGui::Checkbox("position", &c.position);
  ImGui::Checkbox("rotation", &c.rotation);
  ImGui::SameLine();
  ImGui::Checkbox("size", &c.size);
  ImGui::SameLine();
  ImGui::Checkbox("vertices", &c.vertices);
  ImGui::Checkbox("selected light alone", &c.selected);
  ImGui::Checkbox("fit after each stroke", &s.fits_at_once);
  if (ImGui::SmallButton(s.fitting() ? "stop" : "fit")) s.fitting() ? s.stop_fit() : s.fit();
  ImGui::SameLine();
  if (ImGui::SmallButton("remove last")) s.remove_stroke();
  ImGui::SameLine();
  if (ImGui::SmallButton("clear")) s.clear_strokes();
  ImGui::TextWrapped("%zu strokes%s%s", s.strokes().size(), s.fit_state().empty() ? "" : ", ", s.fit_state().c_str());
}

void choose_animation(Session& s) {
  const auto& animations = s.animations();
  if (!ImGui::BeginCombo("animation", animations[s.animation()].name.c_str())) return;
  for (std::size_t i = 0; i < animations.size(); ++i) {
    ImGui::PushID(static_cast<int>(i));
    if (ImGui::Selectable((animations[i].name + "##").c_str(), i == s.animation())) s.choose_animation(i);
    ImGui::PopID();
  }
  ImGui::EndCombo();
}

void time_controls(ViewState& state) {
  Stage& stage = *state.stage;
  if (state.session != nullptr) choose_animation(*state.session);
  auto time = static_cast<float>(std::fmod(stage.time(), stage.duration()));
  if (ImGui::SliderFloat("time", &time, 0, static_cast<float>(stage.duration()), "%.2f s")) {
    state.playing = false;
    stage.set_time(static_cast<double>(time));
  }
  if (ImGui::SmallButton(state.playing ? "pause" : "play")) state.playing = !state.playing;
}

// A colour for a pass of the list that differs from its neighbours.
ImU32 color_of_pass(std::size_t number) {
  return ImColor::HSV(std::fmod(0.58f + 0.381966f * static_cast<float>(number), 1.0f), 0.55f, 0.9f);
}

// The latest pictures from left to right, with the times of their passes stacked.
void graph_of_passes(const ViewState& state) {
  double most = 1e-3;
  for (const auto& passes : state.history) {
    double sum = 0;
    for (const PassTime& pass : passes) sum += std::max(pass.ms, 0.0);
    most = std::max(most, sum);
  }
  const ImVec2 at = ImGui::GetCursorScreenPos(), size{ImGui::GetContentRegionAvail().x, 60};
  ImDrawList* list = ImGui::GetWindowDrawList();
  list->AddRectFilled(at, {at.x + size.x, at.y + size.y}, IM_COL32(0, 0, 0, 120));
  const float wide = size.x / 120;
  float x = at.x;
  for (const auto& passes : state.history) {
    float y = at.y + size.y;
    for (std::size_t i = 0; i < passes.size(); ++i) {
      const float high = static_cast<float>(std::max(passes[i].ms, 0.0) / most) * size.y;
      list->AddRectFilled({x, y - high}, {x + wide, y}, color_of_pass(i));
      y -= high;
    }
    x += wide;
  }
  char text[32];
  std::snprintf(text, sizeof text, "%.1f ms", most);
  list->AddText({at.x + 3, at.y + 1}, IM_COL32(220, 220, 220, 255), text);
  ImGui::Dummy(size);
}

void list_of_passes(const std::vector<PassTime>& passes) {
  for (std::size_t i = 0; i < passes.size(); ++i) {
    ImGui::TextColored(ImColor(color_of_pass(i)), "%8.1f ms", passes[i].ms);
    ImGui::SameLine();
    ImGui::TextUnformatted(passes[i].name.c_str());
  }
}

void times(ViewState& state, Session& s) {
  const RenderedFrame& frame = s.frame();
  ImGui::Text("%d x %d%s, %.0f ms", frame.picture.width, frame.picture.height, s.settled() ? "" : " ...", frame.stats.total_ms);
  if (s.options().bounces != 0) {
    switch (frame.light) {
      case ShownLight::direct: ImGui::TextUnformatted("direct light, all light follows"); break;
      case ShownLight::preview: ImGui::TextUnformatted("preview of all light"); break;
      case ShownLight::all: ImGui::Text("all light, estimated error %.2f %%", 100 * frame.stats.bounce_error); break;
    }
  }
  graph_of_passes(state);
  list_of_passes(frame.stats.passes);
  if (frame.load_ms > 0 && frame.scene)
    ImGui::Text("%8.1f ms reading, %zu of %zu meshes kept", frame.load_ms, frame.scene->kept_meshes, frame.scene->scene.meshes.size());
  if (frame.other_stats.method.empty() || !(state.split || state.error_map)) return;
  ImGui::Text("beside: %s, %.0f ms", frame.other_stats.method.c_str(), frame.other_stats.total_ms);
  list_of_passes(frame.other_stats.passes);
}

const char* name_of(const PlaneBody& body) {
  switch (body.shape) {
    case PlaneBody::Shape::polygon: return "polygon";
    case PlaneBody::Shape::polyline: return "line";
    case PlaneBody::Shape::ellipse: return "ellipse";
    case PlaneBody::Shape::capsule: return "stroke";
  }
  return "";
}

void body_list(DrawingStage& d) {
  const auto& bodies = d.scene().bodies;
  if (ImGui::BeginListBox("##bodies", {-1, 8 * ImGui::GetTextLineHeightWithSpacing()})) {
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      const std::string name = bodies[i].name.empty() ? name_of(bodies[i]) : bodies[i].name;
      ImGui::PushID(static_cast<int>(i));
      if (ImGui::Selectable(((bodies[i].light ? "lamp: " : "blocker: ") + name).c_str(), d.selection() == i)) d.select(i);
      ImGui::PopID();
    }
    ImGui::EndListBox();
  }
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  const Vec2d middle{static_cast<double>(size.x) / 2, static_cast<double>(size.y) / 2};
  if (ImGui::SmallButton("+ lamp")) d.add(true, middle);
  ImGui::SameLine();
  if (ImGui::SmallButton("+ blocker")) d.add(false, middle);
  ImGui::SameLine();
  if (ImGui::SmallButton("delete")) d.remove_selected();
}

void body_controls(DrawingStage& d) {
  if (!d.selection()) {
    ImGui::TextDisabled("click on a lamp or a blocker");
    return;
  }
  PlaneBody body = d.scene().bodies[*d.selection()];
  const Box2d box = bounds_of(body);
  bool changed = false;
  Vec2d middle = box.center();
  if (drag_double("x", middle.x, 0.5f, -1e6, 1e6, "%.1f") | drag_double("y", middle.y, 0.5f, -1e6, 1e6, "%.1f")) {
    body = moved(std::move(body), middle - box.center());
    changed = true;
  }
  double width = box.high.x - box.low.x;
  if (const double before = width; before > 0 && drag_double("width", width, 0.5f, 0.1, 1e6, "%.1f")) {
    body = scaled(std::move(body), box.center(), width / before);
    changed = true;
  }
  double turn = 0;
  if (drag_double("turn", turn, 0.5f, -180, 180, "%.0f degrees")) {
    body = turned(std::move(body), box.center(), turn * 3.14159265358979324 / 180);
    changed = true;
  }
  if (body.light && !body.light->gradient) changed |= edit_color("radiance", body.light->radiance);
  if (body.light && body.light->gradient)
    for (std::size_t i = 0; i < body.light->gradient->stops.size(); ++i)
      changed |= edit_color(("stop " + std::to_string(i + 1)).c_str(), body.light->gradient->stops[i].radiance);
  if (!body.light) changed |= edit_color("colour", body.color);
  if (changed) d.change(*d.selection(), std::move(body));
}

void drawing_times(ViewState& state, const DrawingStage& d) {
  ImGui::Text("%.1f ms, %zu of %zu tiles drawn", d.stats().ms, d.stats().drawn, d.stats().tiles);
  graph_of_passes(state);
}

}  // namespace

void draw_panel(ViewState& state) {
  ImGui::SetNextWindowPos({8, 8}, ImGuiCond_FirstUseEver);
  ImGui::SetNextWindowSize({290, std::max(200.0f, ImGui::GetIO().DisplaySize.y - 16)}, ImGuiCond_FirstUseEver);
  ImGui::SetNextWindowBgAlpha(0.8f);
  ImGui::Begin("steradian", &state.panel, ImGuiWindowFlags_NoSavedSettings);
  ImGui::PushItemWidth(150);
  if (state.session != nullptr) {
    Session& s = *state.session;
    if (ImGui::CollapsingHeader("Lights", ImGuiTreeNodeFlags_DefaultOpen)) light_list(s);
    if (ImGui::CollapsingHeader("Selected", ImGuiTreeNodeFlags_DefaultOpen)) selected_controls(s);
    if (ImGui::CollapsingHeader("Wanted light", s.brush.on ? ImGuiTreeNodeFlags_DefaultOpen : 0)) brush_controls(s);
    if (ImGui::CollapsingHeader("Picture", ImGuiTreeNodeFlags_DefaultOpen)) render_controls(state, s);
  }
  if (state.drawing != nullptr) {
    if (ImGui::CollapsingHeader("Bodies", ImGuiTreeNodeFlags_DefaultOpen)) body_list(*state.drawing);
    if (ImGui::CollapsingHeader("Selected", ImGuiTreeNodeFlags_DefaultOpen)) body_controls(*state.drawing);
  }
  if (state.stage->duration() > 0 && ImGui::CollapsingHeader("Time", ImGuiTreeNodeFlags_DefaultOpen)) time_controls(state);
  if (ImGui::SliderFloat("exposure", &state.exposure, -8, 8, "%.2f stops")) state.display_wanted = true;
  ImGui::SameLine();
  if (ImGui::SmallButton("auto")) state.exposure_known = false;
  if (choose_word("tone curve", state.tone)) state.display_wanted = true;
  if (ImGui::CollapsingHeader("Files", ImGuiTreeNodeFlags_DefaultOpen)) {
    ImGui::InputText("##scene", &state.scene_name);
    ImGui::SameLine();
    if (ImGui::Button("save scene")) attempt(state, [&] { state.stage->save_scene(state.scene_name); });
    ImGui::InputText("##picture", &state.picture_name);
    ImGui::SameLine();
    if (ImGui::Button("save picture")) attempt(state, [&] { state.stage->save_picture(state.picture_name, state.exposure, state.tone); });
  }
  if (ImGui::CollapsingHeader("Times")) {
    state.session != nullptr ? times(state, *state.session) : drawing_times(state, *state.drawing);
    ImGui::TextWrapped("window by %s", state.screen.c_str());
  }
  ImGui::TextDisabled("F1: keys");
  ImGui::PopItemWidth();
  ImGui::End();
}

void draw_message(const ViewState& state) {
  if (state.stage->message().empty()) return;
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos({size.x - 8, size.y - 8}, ImGuiCond_Always, {1, 1});
  ImGui::SetNextWindowSize({std::min(420.0f, size.x - 16), 0});
  ImGui::Begin(
      "##message", nullptr,
      ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoFocusOnAppearing);
  ImGui::PushStyleColor(ImGuiCol_Text, IM_COL32(255, 150, 120, 255));
  ImGui::TextWrapped("%s", state.stage->message().c_str());
  ImGui::PopStyleColor();
  ImGui::End();
}

void draw_help(ViewState& state) {
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos({size.x / 2, size.y / 2}, ImGuiCond_Always, {0.5f, 0.5f});
  ImGui::Begin("Keys", &state.help, ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoMove);
  for (const KeyBinding& binding : key_bindings()) {
    ImGui::TextUnformatted(std::string(binding.key).c_str());
    ImGui::SameLine(110);
    ImGui::TextUnformatted(std::string(binding.help).c_str());
  }
  ImGui::Separator();
  ImGui::TextUnformatted("left: select, drag a handle, orbit    middle, Shift+left: pan\nright: look around    wheel: nearer and farther");
  ImGui::End();
}

}  // namespace steradian::view
