// Bodies as lists of numbers, the form in which JavaScript hands them over (src/bodies.js writes and reads the same).
//
//   shape (0 polygon, 1 polyline, 2 ellipse, 3 capsule), even-odd, center 2, x axis 2, y axis 2, radius, colour 3,
//   has albedo, albedo 3, shines; of what shines: radiance 3, profile (0 uniform, 1 lambert, 2 inverse), range, spot axis 2, half angle,
//   stops of the gradient; of a gradient: from 2, to 2, and for every stop offset, radiance 3;
//   contours, and of each its vertices' number, then x, y of each
#pragma once

#include <vector>

#include "steradian/plane.h"

namespace steradian::plane {

std::vector<double> numbers_of(const PlaneBody& body);
// Throws Error where the list ends early, has more, or counts what cannot be counted.
PlaneBody body_of(const double* numbers, std::size_t count);

}  // namespace steradian::plane
