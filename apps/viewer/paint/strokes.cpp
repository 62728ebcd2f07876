#include "paint/strokes.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace steradian::view {
namespace {

constexpr double kMostSide = 160;
constexpr float kAround = 0.1f;  // weight of a pixel without a highlight, as that of the key `around` of solve's questions

double distance_to(const std::vector<Vec2d>& line, Vec2d p) {
  double nearest = length(p - line.front());
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    const Vec2d a = line[i], along = line[i + 1] - a;
    const double length2 = dot(along, along), t = length2 > 0 ? std::clamp(dot(p - a, along) / length2, 0.0, 1.0) : 0;
    nearest = std::min(nearest, length(p - (a + along * t)));
  }
  return nearest;
}

bool same(const Camera& a, const Camera& b) {
  return a.position == b.position && a.x == b.x && a.y == b.y && a.z == b.z && a.yfov == b.yfov;
}

// Strokes that share a target.
bool go_together(const PaintStroke& a, const PaintStroke& b) {
  return a.width == b.width && a.height == b.height && a.part == b.part && same(a.camera, b.camera);
}

PictureTarget empty_target(const PaintStroke& like, const std::string& camera) {
  const double scale = std::min(1.0, kMostSide / std::max(like.width, like.height));
  const auto side = [&](int pixels) { return std::max(1, static_cast<int>(std::lround(pixels * scale))); };
  PictureTarget target;
  target.picture = Picture(side(like.width), side(like.height));
  target.pixel_weights.assign(target.picture.pixels.size(), like.part == LightPart::specular ? kAround : 0.0f);
  target.camera = camera;
  target.part = like.part;
  target.painted = true;
  return target;
}

void draw(const PaintStroke& stroke, PictureTarget& target) {
  const double x_scale = static_cast<double>(stroke.width) / target.picture.width;
  const double y_scale = static_cast<double>(stroke.height) / target.picture.height;
  // A thin stroke covers a pixel at least.
  const double reach = std::max(stroke.radius, 0.71 * std::max(x_scale, y_scale));
  for (int y = 0; y < target.picture.height; ++y)
    for (int x = 0; x < target.picture.width; ++x) {
      if (distance_to(stroke.points, {(x + 0.5) * x_scale, (y + 0.5) * y_scale}) > reach) continue;
      target.picture.at(x, y) = static_cast<Vec3f>(stroke.radiance);
      target.pixel_weights[static_cast<std::size_t>(y) * static_cast<std::size_t>(target.picture.width) + static_cast<std::size_t>(x)] = 1;
    }
}

}  // namespace

std::vector<LightTarget> targets_of(const std::vector<PaintStroke>& strokes, Scene& scene) {
  std::vector<PictureTarget> targets;
  std::vector<const PaintStroke*> first;  // of each target
  scene.cameras.clear();
  for (const PaintStroke& stroke : strokes) {
    if (stroke.points.empty()) continue;
    auto found = std::find_if(first.begin(), first.end(), [&](const PaintStroke* s) { return go_together(*s, stroke); });
    if (found == first.end()) {
      Camera camera = stroke.camera;
      camera.name = "painted " + std::to_string(targets.size() + 1);
      scene.cameras.push_back(camera);
      targets.push_back(empty_target(stroke, camera.name));
      found = first.insert(first.end(), &stroke);
    }
    draw(stroke, targets[static_cast<std::size_t>(found - first.begin())]);
  }
  return {targets.begin(), targets.end()};
}

}  // namespace steradian::view
