// The Phong lobe's boundary integrals in double, by quadrature that subdivides until it has converged.
#pragma once

#include "steradian/kernels.h"

namespace steradian {

// Two integrals over the part in front of an edge: of (1 - x^m)/(1 - x^2), times |s|, and of x^m; m = n + 1 > 0. The absolute error of each
// is below 1e-12.
Kernels<double>::MomentIntegrands integrate_front(const Kernels<double>::MomentEdge& edge, double n);

}  // namespace steradian
