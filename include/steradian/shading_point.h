// ShadingPoint: where light is asked for.
#pragma once

#include "steradian/vector.h"

namespace steradian {

// Unit vectors, away from the surface.
struct ShadingPoint {
  Vec3d position;
  Vec3d normal;
  Vec3d view;  // towards the eye
};

}  // namespace steradian
