// What lobes reflect of an even sky, and what follows from it: multiple scattering between facets, layers under sheen.
#pragma once

#include "steradian/material.h"
#include "steradian/shading_point.h"

namespace steradian {

// Share of an even sky's light that the lobe with F = 1 sends to the view, in (0, 1]: one bounce between the facets.
// Isotropic by the shipped table, anisotropic by 128 nodes over the visible normals; error: docs/ltc.md, "Layers".
double ggx_albedo(const Material& material, const ShadingPoint& at);

// The same of Charlie's sheen of colour 1, by its table. cosine: of the view to the normal.
double charlie_albedo(double alpha, double cosine);

// The material whose one bounce has the energy of all: f0 and f90 grow by 1 + f0 (1 - a) / a, a the albedo. It has no
// multiple_scattering any more; one that had none is returned as it is. Every function of the library that takes a Material
// does this itself.
// Source: Turquin, "Practical multiple scattering compensation for microfacet models", 2019, eq. 16.
Material with_multiple_scattering(const Material& material, const ShadingPoint& at);

}  // namespace steradian
