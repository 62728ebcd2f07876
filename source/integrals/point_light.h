// Lights without an extent from a point: the lobe in one direction.
#pragma once

#include "shapes/shape.h"
#include "steradian/material.h"
#include "steradian/shading_point.h"

namespace steradian::methods {

// f cos intensity / d^2. 0 below the surface, for a view below it, and at distance 0.
Vec3d point_light_radiance(const PointLight& light, const ShadingPoint& at, const Material& material);

// f cos illuminance. 0 below the surface and for a view below it.
Vec3d directional_light_radiance(const DirectionalLight& light, const ShadingPoint& at, const Material& material);

}  // namespace steradian::methods
