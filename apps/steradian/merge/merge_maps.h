// The parts of a light map, joined.
#pragma once

#include <string>
#include <vector>

#include "steradian/limits.h"

namespace steradian::app {

// Throws WrongOption for a name that is no baked scene.
void check_baked_name(const std::string& path);

// Joins the pictures of bake --part, and writes the baked scene of which they are. Throws Error for parts that are missing or do not belong
// together.
void merge_maps(const std::vector<std::string>& parts, const std::string& output, const Limits& limits);

}  // namespace steradian::app
