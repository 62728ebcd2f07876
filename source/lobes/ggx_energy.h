// Directional albedo of an isotropic GGX lobe: what a white sky sends through it to the view.
#pragma once

#include <optional>

#include "lobes/lobe_parts.h"
#include "steradian/material.h"

namespace steradian::lobes {

// Integral of the lobe over all directions, by a table that is made at the first call. It is within 2e-3 of quadrature. cosine: of the view
// to the normal.
LobeValue ggx_energy(double alpha, double cosine);

// The light of a lobe whose integrals are given.
inline Vec3d coloured(LobeValue integral, Vec3d f0, Vec3d f90) { return f0 * (integral.plain - integral.fresnel) + f90 * integral.fresnel; }

// Directional albedo of a material. There is none for lobes other than isotropic GGX.
std::optional<Vec3d> known_albedo(const Material& material, double cosine);

}  // namespace steradian::lobes
