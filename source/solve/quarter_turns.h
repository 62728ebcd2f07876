// Rectangles have two descriptions each: a quarter turn with the sides exchanged changes nothing.
#pragma once

#include <vector>

#include "solve/fitted_lights.h"

namespace steradian::solving {

// The same lights, but rectangles whose rotation stands at its bound are turned by a quarter, so that they may turn on. Descriptions
// outside of the ranges are not taken, nor are those of lights that others follow, or that are kept near their start.
std::vector<double> with_quarter_turns(const FittedLights& lights, std::vector<double> x);

}  // namespace steradian::solving
