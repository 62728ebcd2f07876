// The parts of a picture, joined.
#pragma once

#include <string>
#include <vector>

#include "steradian/limits.h"

namespace steradian::app {

// Joins the pictures of render --part into the picture that one run would have made. Throws Error for parts that are missing or do not
// belong together.
void merge_pictures(const std::vector<std::string>& parts, const std::string& output, const Limits& limits);

}  // namespace steradian::app
