// An environment turned about the vertical axis.
#pragma once

#include "steradian/environment.h"

namespace steradian::scene {

// Turns the map, and the irradiance, by an angle [degrees] about +y, counter-clockwise as seen from above. The map moves along its rows;
// between whole columns it is interpolated linearly.
void turn(Environment& environment, double degrees);

}  // namespace steradian::scene
