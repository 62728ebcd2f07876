// The scenes of the frame benches: circular lights among random boxes.
#pragma once

#include "steradian/plane.h"

namespace steradian::plane {

struct LightField {
  int lights, boxes;
  double range, radius, size;  // pixels; half sides of boxes are 0.4 to 1.2 times the size
  int width = 1920, height = 1080;
};

inline constexpr LightField kLightFields[] = {
    {16, 200, 500, 14, 16}, {64, 500, 400, 12, 14}, {256, 1000, 300, 8, 12}, {1000, 2000, 150, 6, 10}, {4096, 5000, 60, 4, 8}};

// Uniform centres and rotations, with overlaps, and lights' centres outside boxes. It is the same on every machine.
PlaneScene make_light_field(const LightField& field, std::uint64_t seed);

}  // namespace steradian::plane
