// Derivatives of the Phong lobe over a polygon, by its vertices and by the view, by quadrature along its outline.
#pragma once

#include "integrals/polygon_slopes.h"

namespace steradian::slopes {

struct PhongDerivatives {
  std::vector<BothParts> by_vertex;  // in walk order; the fresnel part is 0
  Vec3d by_view;                     // perpendicular to the view; not with foreshortening, which is no turn of the lobe
};

// Derivatives of (n + 1) / (2 pi) times the integral of max(l.r, 0)^n, r the mirrored view. The rule's error is about 1e-12 of the lobe
// along the outline.
PhongDerivatives phong_derivatives(const PreparedPolygon& light, int side, const ShadingPoint& at, const Material& material);

}  // namespace steradian::slopes
