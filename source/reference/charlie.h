// Charlie: the sheen of cloth, glTF's KHR_materials_sheen.
#pragma once

#include "steradian/vector.h"

namespace steradian::reference {

// BRDF times the light's cosine for a colour of 1, with the shadowing of its authors. Unit directions in the shading frame,
// alpha in (0, 1] the roughness squared, taken to be at least kSmoothestCharlie: below, the model reflects more than arrives
// and only within a few degrees of the horizon. 0 where light or view is not above the surface.
// Source: Estevez, Kulla, "Production friendly microfacet sheen BRDF", 2017, eq. 2 to 4 and table 1.
inline constexpr double kSmoothestCharlie = 0.04;
double charlie_lobe(double alpha, Vec3d view, Vec3d light);

}  // namespace steradian::reference
