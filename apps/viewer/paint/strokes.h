// Strokes: what a user paints over the picture, and the targets of a fit that it means.
#pragma once

#include <vector>

#include "steradian/solve.h"
#include "steradian/vector2.h"

namespace steradian::view {

struct Brush {
  bool on = false;     // a left drag paints
  double radius = 14;  // pixels
  Vec3d radiance{};    // wanted; zero: twice the picture's mean when the brush is first taken
  LightPart part = LightPart::all;
};

struct PaintStroke {
  Camera camera;
  int width = 0, height = 0;  // of the picture under it
  std::vector<Vec2d> points;  // pixels
  std::vector<Vec3d> places;  // on the surfaces, to show the stroke from other cameras
  double radius = 0;
  Vec3d radiance{};
  LightPart part = LightPart::all;
};

// The parameters that a fit to strokes may change.
struct FitChoice {
  bool power = true, color = false, position = false, rotation = false, size = false;
  bool vertices = false;  // of polygons, whose place they include
  bool selected = false;  // of the selected light alone

  bool moves() const { return position || rotation || size || vertices; }
};

// One target for the strokes of each camera and part, over a picture of at most 160 pixels a side. Their cameras take the place of the
// scene's. Later strokes cover earlier ones. Pixels without a stroke do not count; for the specular part, they want none with a tenth of
// the weight.
std::vector<LightTarget> targets_of(const std::vector<PaintStroke>& strokes, Scene& scene);

}  // namespace steradian::view
