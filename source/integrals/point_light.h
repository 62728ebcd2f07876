// Lights without an extent from a point: the lobe in one direction.
#pragma once

#include "integrals/methods.h"
#include "shapes/shape.h"

namespace steradian::methods {

// f cos towards a unit direction by a method: its own lobe, or else the material's. 0 below the surface and for a view below it.
Vec3d lobe_towards(Vec3d direction, const ShadingPoint& at, const Material& material, const Row& row, const RadianceOptions& options = {});

// The same times intensity / d^2. 0 at distance 0.
Vec3d point_light_radiance(const PointLight& light, const ShadingPoint& at, const Material& material, const Row& row,
                           const RadianceOptions& options = {});

// The same times the illuminance.
Vec3d directional_light_radiance(const DirectionalLight& light, const ShadingPoint& at, const Material& material, const Row& row,
                                 const RadianceOptions& options = {});

}  // namespace steradian::methods
