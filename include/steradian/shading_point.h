// ShadingPoint: a point on a surface at which light is computed.
#pragma once

#include "steradian/vector.h"

namespace steradian {

// The vectors are unit and point away from the surface.
struct ShadingPoint {
  Vec3d position;
  Vec3d normal;
  Vec3d view;  // towards the eye
};

}  // namespace steradian
