// Derivatives of GGX over a polygon, by its vertices and by the view (docs/theory/derivatives.md).
#pragma once

#include "integrals/polygon_slopes.h"
#include "steradian/closed_form.h"

namespace steradian::slopes {

struct GgxDerivatives {
  std::vector<BothParts> by_vertex;  // in walk order
  BothParts by_view;                 // perpendicular to the view; only with shadowing, without which the horizon has a term
};

// By the vertices, these are derivatives of the lobe's true integral: shadowing and Fresnel count along the edges alone, where they are
// known. By the view, edges and inside count. Along the edges the lobe is known. Inside, the half vectors' distribution stays, and only
// shadowing and Fresnel change, whose mean the closed form has by cubature.
GgxDerivatives ggx_derivatives(const PreparedPolygon& light, int side, const ShadingPoint& at, const Material& material, Quality quality);

}  // namespace steradian::slopes
