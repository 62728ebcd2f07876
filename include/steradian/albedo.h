// Albedos of lobes, and their uses: multiple scattering between facets, layers under sheen.
#pragma once

#include "steradian/material.h"
#include "steradian/shading_point.h"

namespace steradian {

// Fraction of a uniform sky's light that the lobe with F = 1 sends to the view, in (0, 1]: one bounce between the facets. Isotropic lobes
// use the shipped table, anisotropic ones 128 nodes over the visible normals; error: docs/theory/ltc.md, "Layers".
double ggx_albedo(const Material& material, const ShadingPoint& at);

// The same for Charlie's sheen of colour 1, by its table. cosine: cosine of the view to the normal.
double charlie_albedo(double alpha, double cosine);

// The material whose single bounce has the energy of all bounces. f0 and f90 grow by 1 + f0 (1 - a) / a, where a is the albedo. Its
// multiple_scattering is false. A material whose flag was false already is returned unchanged. Every function of the library that takes a
// Material does this itself.
// Source: Turquin, "Practical multiple scattering compensation for microfacet models", 2019, eq. 16.
Material with_multiple_scattering(const Material& material, const ShadingPoint& at);

}  // namespace steradian
