// The parts of a fit, joined.
#pragma once

#include <string>
#include <vector>

#include "steradian/limits.h"

namespace steradian::app {

// Joins the files of fit --part into the table that one run would have written. Throws Error for parts that are missing or do not belong
// together.
void merge_fits(const std::vector<std::string>& parts, const std::string& output, const Limits& limits);

}  // namespace steradian::app
