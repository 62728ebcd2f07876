// The solved scene as a file: the input with the fitted lights changed, and nothing else.
#pragma once

#include <string>

#include "steradian/solve.h"

namespace steradian::app {

// Throws Error for a light that the file does not hold in a form that can be changed. `start`: the scene of `input`.
void write_solved(const std::string& input, const Scene& start, const Solution& found, const std::string& output);

}  // namespace steradian::app
