// Shapes of a drawing that are not in its scene, for people.
#pragma once

#include <string>

#include "steradian/plane.h"

namespace steradian::app {

// The names of the shapes that one reason leaves out: "page, <rect> in line 4 and 3 more".
std::string names_of(const PlaneLeftOut& left_out);

// Prints one line about the shapes that are taken for backdrops, if there are any.
void say_backdrops(const PlaneSvg& drawing, const std::string& file);

}  // namespace steradian::app
