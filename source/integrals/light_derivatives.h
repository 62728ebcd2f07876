// Derivatives of the radiance that one lobe sends to the view under an area light, by a method of the table.
#pragma once

#include "integrals/methods.h"
#include "integrals/outline_derivatives.h"

namespace steradian::methods {

struct LightDerivativesOfLobe {
  OutlineDerivatives light;
  std::array<Vec3d, 3> normal{};  // of the function of n/|n|, with view and tangent fixed: perpendicular to the normal
  std::array<Vec3d, 3> view{};    // of the function of v/|v|, likewise
};

// The row's own derivatives of polygons, where it has them. Else those of its density, by quadrature along the outline. By normal and view,
// the outline of a round light is fixed. Rows without derivatives of their own have central differences there (fine_method: by which
// method). Throws Error for a method without a density, for lights with a profile, and for lines.
LightDerivativesOfLobe light_derivatives(const AreaLight& light, const ShadingPoint& at, const Material& material, const Row& row,
                                         const RadianceOptions& options);

// The angle over which a lobe changes [rad].
double narrowest_width(const Material& material, const ShadingPoint& at);

}  // namespace steradian::methods
