// read_picture (steradian/picture.h) within limits that the caller sets.
#pragma once

#include <string>

#include "steradian/limits.h"
#include "steradian/picture.h"

namespace steradian {

// The bytes must be of the format that the name's ending says. Throws Error with the path for damaged files and for files that would exceed
// the limits.
Picture read_picture(const std::string& path, const Limits& limits);

}  // namespace steradian
