// Drawings of fifteen shapes, of which two are lights of one kind: for tests and benches of every kind of light.
#pragma once

#include <string>
#include <vector>

#include "steradian/plane.h"

namespace steradian::plane {

struct Drawing {
  std::string shape;     // shape of its lights: circle, ellipse, polygon, capsule, stroke or curve
  std::string emission;  // uniform, range, lambert, inverse, spot or gradient
};

std::vector<Drawing> all_drawings();

// A scene of 640 x 360 units with circles, ellipses, rectangles and round strokes as occluders. It is the same on every machine.
PlaneScene make_drawing(const Drawing& drawing);

}  // namespace steradian::plane
