// The integral of ln(distance) over two straight edges, from which the exchange between polygons is summed (docs/theory/view_factors.md).
#pragma once

#include "steradian/vector.h"

namespace steradian::exchange {

struct LogIntegral {
  double value = 0;
  double error = 0;     // bound of the quadrature and of rounding
  int evaluations = 0;  // of the inner integral
};

// The integral over the edges p0 p1 and q0 q1 by arc length. Both edges have a length. Distances are best near 1, where logarithms are
// small.
//
//   tolerance  error of the quadrature that is enough; rounding may exceed it
LogIntegral integrate_log(Vec3d p0, Vec3d p1, Vec3d q0, Vec3d q1, double tolerance);

// The same in closed form, where it exists without special functions: edges that are parallel, or whose lines meet. Rounding grows with the
// distance of the edges from the point where the lines meet.
bool lines_are_parallel(Vec3d p0, Vec3d p1, Vec3d q0, Vec3d q1);
double parallel_log_integral(Vec3d p0, Vec3d p1, Vec3d q0, Vec3d q1);
bool lines_meet(Vec3d p0, Vec3d p1, Vec3d q0, Vec3d q1);
double meeting_log_integral(Vec3d p0, Vec3d p1, Vec3d q0, Vec3d q1);

}  // namespace steradian::exchange
