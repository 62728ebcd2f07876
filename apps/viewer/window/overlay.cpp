// Overlay on the picture: the handles of the selected object, and marks for lamps without an extent.
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <string>
#include <vector>

#include "view_state.h"

namespace steradian::view {
namespace {

constexpr ImU32 kAxisColors[] = {IM_COL32(235, 80, 70, 255), IM_COL32(110, 200, 70, 255), IM_COL32(80, 140, 250, 255)};
constexpr ImU32 kBright = IM_COL32(255, 220, 90, 255), kMark = IM_COL32(255, 240, 180, 255), kEdge = IM_COL32(0, 0, 0, 160);

class Overlay {
 public:
  Overlay(const Session& session, const Camera& camera, double scale)
      : session_(session), camera_(camera), scale_(scale), list_(ImGui::GetBackgroundDrawList()) {}

  void mark(Vec3d point, bool selected) const {
    const auto p = at(point);
    if (!p) return;
    list_->AddCircle(*p, 7, kEdge, 0, 4);
    list_->AddCircle(*p, 7, selected ? kBright : kMark, 0, 2);
    list_->AddCircleFilled(*p, 2, selected ? kBright : kMark);
  }

  void corners(const std::vector<std::vector<Vec3d>>& contours, const std::optional<CornerPlace>& taken,
               const std::optional<CornerPlace>& hot) const {
    for (std::size_t i = 0; i < contours.size(); ++i)
      for (std::size_t k = 0; k < contours[i].size(); ++k) {
        const auto p = at(contours[i][k]);
        if (!p) continue;
        const bool bright = taken == CornerPlace{i, k} || hot == CornerPlace{i, k};
        list_->AddRectFilled({p->x - 5, p->y - 5}, {p->x + 5, p->y + 5}, kEdge);
        list_->AddRectFilled({p->x - 4, p->y - 4}, {p->x + 4, p->y + 4}, bright ? kBright : kMark);
      }
  }

  // In its own color, translucent. From its own camera it lies where it was painted.
  void stroke(const PaintStroke& stroke) const {
    const double most = std::max({stroke.radiance.x, stroke.radiance.y, stroke.radiance.z, 1e-30});
    const auto byte = [&](double v) { return static_cast<int>(std::lround(155 + 100 * v / most)); };
    const ImU32 color = IM_COL32(byte(stroke.radiance.x), byte(stroke.radiance.y), byte(stroke.radiance.z), 90);
    const double zoom = session_.size().y / stroke.height;
    const auto wide = static_cast<float>(2 * stroke.radius * zoom / scale_);
    std::vector<ImVec2> line;
    for (const Vec3d& place : stroke.places)
      if (const auto p = at(place)) line.push_back(*p);
    if (line.size() == 1) list_->AddCircleFilled(line[0], wide / 2, color);
    if (line.size() > 1) list_->AddPolyline(line.data(), static_cast<int>(line.size()), color, 0, wide);
  }

  void brush(Vec2d pointer, double radius) const {
    const ImVec2 p(static_cast<float>(pointer.x / scale_), static_cast<float>(pointer.y / scale_));
    list_->AddCircle(p, static_cast<float>(radius / scale_), kEdge, 0, 3);
    list_->AddCircle(p, static_cast<float>(radius / scale_), kBright, 0, 1.5f);
  }

  void handles(const Gizmo& gizmo, Handle hot) const {
    for (int i = 0; i < 3; ++i) {
      const Vec3d axis = gizmo.axes[i];
      const ImU32 color = static_cast<int>(hot) == i + 1 ? kBright : kAxisColors[i];
      if (gizmo.mode == GizmoMode::turn)
        ring(gizmo, axis, color);
      else
        arrow(gizmo, axis, color);
    }
    if (const auto center = at(gizmo.origin); center && gizmo.mode != GizmoMode::turn)
      list_->AddCircleFilled(*center, 5, hot == Handle::free ? kBright : IM_COL32(230, 230, 230, 255));
  }

 private:
  std::optional<ImVec2> at(Vec3d point) const {
    const auto p = project(camera_, point, session_.size().x, session_.size().y);
    if (!p || std::fabs(p->x) > 1e5 || std::fabs(p->y) > 1e5) return {};
    return ImVec2(static_cast<float>(p->x / scale_), static_cast<float>(p->y / scale_));
  }

  void line(Vec3d a, Vec3d b, ImU32 color) const {
    const auto p = at(a), q = at(b);
    if (!p || !q) return;
    list_->AddLine(*p, *q, kEdge, 5);
    list_->AddLine(*p, *q, color, 3);
  }

  void arrow(const Gizmo& gizmo, Vec3d axis, ImU32 color) const {
    line(gizmo.origin + axis * (0.2 * gizmo.size), gizmo.origin + axis * gizmo.size, color);
    const auto tip = at(gizmo.origin + axis * gizmo.size);
    if (!tip) return;
    if (gizmo.mode == GizmoMode::scale)
      list_->AddRectFilled({tip->x - 5, tip->y - 5}, {tip->x + 5, tip->y + 5}, color);
    else
      list_->AddCircleFilled(*tip, 6, color);
  }

  void ring(const Gizmo& gizmo, Vec3d axis, ImU32 color) const {
    constexpr int kSegments = 64;
    const Frame frame = Frame::from_normal(axis);
    const auto point = [&](int i) {
      const double angle = 2 * std::numbers::pi * i / kSegments;
      return gizmo.origin + (frame.x * std::cos(angle) + frame.y * std::sin(angle)) * gizmo.size;
    };
    for (int i = 0; i < kSegments; ++i) line(point(i), point(i + 1), color);
  }

  const Session& session_;
  const Camera& camera_;
  double scale_;
  ImDrawList* list_;
};

void draw_plane_handles(const DrawingStage& drawing, double scale) {
  if (!drawing.selection()) return;
  const Box2d box = bounds_of(drawing.scene().bodies[*drawing.selection()]);
  const auto at = [&](Vec2d p) {
    const Vec2d pixel = drawing.to_pixel(p) / scale;
    return ImVec2(static_cast<float>(pixel.x), static_cast<float>(pixel.y));
  };
  ImDrawList* list = ImGui::GetBackgroundDrawList();
  list->AddRect(at(box.low), at(box.high), kEdge, 0, 0, 3);
  list->AddRect(at(box.low), at(box.high), kBright, 0, 0, 1.5f);
  const ImVec2 corner = at(box.high);
  list->AddRectFilled({corner.x - 5, corner.y - 5}, {corner.x + 5, corner.y + 5}, kBright);
}

// Labels both sides of the split screen.
void name_halves(const Session& s, float x) {
  const RenderedFrame& frame = s.frame();
  std::string right = frame.other_stats.method;
  if (frame.pairs > 0) {
    char text[80];
    std::snprintf(text, sizeof text, ": %llu samples, standard error %.2f %%", static_cast<unsigned long long>(frame.pairs),
                  100 * frame.standard_error);
    right += text;
  }
  const float y = ImGui::GetIO().DisplaySize.y - ImGui::GetTextLineHeight() - 6;
  const auto write = [&](float at, const std::string& text) {
    ImDrawList* list = ImGui::GetBackgroundDrawList();
    list->AddText({at + 1, y + 1}, IM_COL32(0, 0, 0, 255), text.c_str());
    list->AddText({at, y}, IM_COL32(255, 255, 255, 255), text.c_str());
  };
  write(x - 8 - ImGui::CalcTextSize(frame.stats.method.c_str()).x, frame.stats.method);
  write(x + 8, right);
}

}  // namespace

void draw_overlay(ViewState& state, double scale) {
  if (state.drawing != nullptr) draw_plane_handles(*state.drawing, scale);
  if (state.session == nullptr || !state.session->has_camera()) return;
  Session& s = *state.session;
  const Camera camera = s.camera().camera();
  const Overlay overlay(s, camera, scale);
  for (const Lamp& lamp : s.lamps())
    if (lamp.kind == LampKind::punctual || lamp.kind == LampKind::profile)
      overlay.mark(s.tree().world(lamp.node).t, lamp.node == s.selection().node);
  const ImVec2 mouse = ImGui::GetIO().MousePos;
  const Vec2d pointer{static_cast<double>(mouse.x) * scale, static_cast<double>(mouse.y) * scale};
  for (const PaintStroke& stroke : s.strokes()) overlay.stroke(stroke);
  if (s.brush.on) overlay.brush(pointer, s.brush.radius);
  if (const auto gizmo = s.gizmo(); gizmo && !s.brush.on)
    overlay.handles(*gizmo, s.dragging() ? s.dragged_handle() : s.handle_under(pointer));
  overlay.corners(s.corners(), s.corner(), s.corner_under(pointer));
  if (state.split && !state.error_map) {
    const float x = state.split_at * ImGui::GetIO().DisplaySize.x;
    ImGui::GetBackgroundDrawList()->AddLine({x, 0}, {x, ImGui::GetIO().DisplaySize.y}, IM_COL32(255, 255, 255, 180));
    name_halves(s, x);
  }
}

}  // namespace steradian::view
