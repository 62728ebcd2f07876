// Scenes that the benches make: fields of lights and boxes, and drawings.
#pragma once

#include <string>
#include <vector>

#include "steradian/plane.h"

namespace steradian::plane {

// The scenes of the frame benches: circular lights among random boxes.

struct LightField {
  int lights, boxes;
  double range, radius, size;  // pixels; half sides of boxes are 0.4 to 1.2 times the size
  int width = 1920, height = 1080;
};

inline constexpr LightField kLightFields[] = {
    {16, 200, 500, 14, 16}, {64, 500, 400, 12, 14}, {256, 1000, 300, 8, 12}, {1000, 2000, 150, 6, 10}, {4096, 5000, 60, 4, 8}};

// Uniform centres and rotations, with overlaps, and lights' centres outside boxes. It is the same on every machine.
PlaneScene make_light_field(const LightField& field, std::uint64_t seed);

// Drawings of fifteen shapes, of which two are lights of one kind: for tests and benches of every kind of light.

struct LightPairDrawing {
  std::string shape;     // shape of its lights: circle, ellipse, polygon, capsule, stroke or curve
  std::string emission;  // uniform, range, lambert, inverse, spot or gradient
};

std::vector<LightPairDrawing> all_drawings();

// A scene of 640 x 360 units with circles, ellipses, rectangles and round strokes as occluders. It is the same on every machine.
PlaneScene make_drawing(const LightPairDrawing& drawing);

}  // namespace steradian::plane
