// Light of a point without size: the lobe in one direction, over the square of the distance.
#pragma once

#include "shapes/shape.h"
#include "steradian/material.h"
#include "steradian/shading_point.h"

namespace steradian::methods {

// f cos intensity / d^2. 0 below the surface, for a view below it and at no distance.
Vec3d point_light_radiance(const PointLight& light, const ShadingPoint& at, const Material& material);

}  // namespace steradian::methods
