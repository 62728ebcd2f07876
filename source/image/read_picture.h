// read_picture (steradian/picture.h) within limits of the caller's.
#pragma once

#include <string>

#include "steradian/limits.h"
#include "steradian/picture.h"

namespace steradian {

// The bytes must be of the format that the name's ending says. Throws Error with the path for what is damaged or would take
// more than the limits.
Picture read_picture(const std::string& path, const Limits& limits);

}  // namespace steradian
