// What a scene gets that brings no camera or no light.
#pragma once

#include "steradian/scene.h"

namespace steradian {

// Sets bounds_min and bounds_max from all meshes.
void measure_bounds(Scene& scene);

// A camera in front of the scene and above it that sees its bounding sphere whole.
Camera framing_camera(const Scene& scene);

// A square light above, in front and to the left, that looks at the scene's centre. It is not visible itself.
AreaLight default_light(const Scene& scene);

}  // namespace steradian
