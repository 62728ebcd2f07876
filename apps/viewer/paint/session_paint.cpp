// Session: strokes of wanted light, and the fit of lights to them.
#include <cstdio>
#include <utility>

#include "document/light_changes.h"
#include "session.h"

namespace steradian::view {

void Session::take_brush(bool on) {
  brush.on = on;
  if (!on || !(brush.radiance == Vec3d{}) || picture().pixels.empty()) return;
  double mean = 0;
  for (const Vec3f& p : picture().pixels) mean += luminance(static_cast<Vec3d>(p)) / static_cast<double>(picture().pixels.size());
  brush.radiance = Vec3d{1, 1, 1} * (2 * mean);
}

// Places are a third of the brush apart.
void Session::paint(Vec2d at) {
  PaintStroke& stroke = strokes_.back();
  if (!stroke.points.empty() && length(at - stroke.points.back()) < std::max(stroke.radius / 3, 1.0)) return;
  stroke.points.push_back(at);
  if (!frame_.scene) return;
  if (const auto hit = pick(frame_.scene->scene, ray(at))) stroke.places.push_back(hit->point);
}

void Session::remove_stroke() {
  if (painting_ || strokes_.empty()) return;
  stop_fit();
  strokes_.pop_back();
}

void Session::fit() {
  stop_fit();
  if (strokes_.empty()) return say("there is no stroke to fit lights to");
  document_->close_step();
  FitTask task{document_->file(), strokes_, fit_choice, selection_.node, options_};
  task.file.json = shown_json();
  task.render.backend = Backend::cpu;
  task.render.method = "auto";
  // Places count direct light alone.
  if (fit_choice.moves()) task.render.bounces = 0;
  task.render.indirect.mode = IndirectMode::off;
  fit_revision_ = document_->revision();
  fit_state_ = "fitting";
  fitter_.start(std::move(task));
}

void Session::stop_fit() {
  if (fitting()) fit_state_ = "stopped";
  fitter_.stop();
  if (std::exchange(fit_applied_, false)) document_->close_step();
}

bool Session::take_fit() {
  if (!fitting()) return false;
  if (document_->revision() != fit_revision_) {  // changed by hand
    stop_fit();
    return true;
  }
  const auto news = fitter_.take();
  if (!news) return false;
  // The changes are those from the start.
  if (!news->changes.empty()) {
    if (std::exchange(fit_applied_, false)) document_->undo();
    try {
      apply_changes(*document_, news->scene->scene, news->changes);
    } catch (const std::exception& e) {
      say(e.what());
      fitter_.stop();
    }
    fit_applied_ = true;
    fit_revision_ = document_->revision();
  }
  char text[64];
  std::snprintf(text, sizeof text, "step %d, cost %.4g", news->step, news->cost);
  fit_state_ = news->ended && news->changes.empty() ? "not fitted" : text;
  if (!news->ended) return true;
  if (news->changes.empty())
    say(news->message);
  else
    fit_state_ += ": " + news->message;
  if (std::exchange(fit_applied_, false)) document_->close_step();
  return true;
}

}  // namespace steradian::view
