// The faces of flat lights: what is seen of them, and lit by others, lies in the very plane that shines.
#pragma once

#include "steradian/area_light.h"

namespace steradian::scene {

// How far in float a point of a flat light's own face may seem to be off its plane; 0 for a round one.
//
// With c the largest coordinate of its corners and u = 2^-24: corners and the point are stored within u c in each of three coordinates,
// their differences, at most 2 sqrt(3) c long, are multiplied with a normal that is off by some 4 u and added up within 3 u: 30 u c in all.
// Taken twice, for triangles whose own normal is less exact; and corners may be off their plane by 1e-5 of the light's size
// (prepare_polygon).
float roundings_of_plane(const AreaLight& light);

}  // namespace steradian::scene
