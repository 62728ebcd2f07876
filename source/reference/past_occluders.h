// Quadrature past occluders, on the light's true surface. It shares nothing with the visible parts of source/shadow: half planes through
// one axis cut the light and the triangles into intervals of angle. docs/theory/reference.md derives it.
#pragma once

#include <array>
#include <optional>
#include <span>

#include "steradian/area_light.h"
#include "steradian/reference.h"

namespace steradian::reference {

// Corners of a triangle that blocks light from both sides.
using Blocker = std::array<Vec3d, 3>;

// The radiance that a lobe sends to the view: the integral over what the point sees of a polygon, an ellipse, an ellipsoid or a tube. A
// triangle blocks up to the light's front surface. One that contains the point in its inside blocks the side from which the horizon points
// away.
//
//   horizon   nothing below its plane arrives; the geometric normal
//   emission  factor on the light's radiance; empty: 1
ReferenceResult radiance_past(std::span<const Blocker> blockers, const AreaLight& light, const ShadingPoint& at, Vec3d horizon,
                              const Material& material, const ReferenceOptions& options, const EmissionFactor& emission = {});

}  // namespace steradian::reference
