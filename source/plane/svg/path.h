// The d attribute of a path.
#pragma once

#include <string_view>

#include "plane/svg/contours.h"

namespace steradian::plane::svg {

// Draws path data. Throws std::string with a description of the error.
void draw_path(std::string_view data, Pen& pen);

// Draws lines from point to point, as in the points attribute.
void draw_points(std::string_view points, Pen& pen);

}  // namespace steradian::plane::svg
