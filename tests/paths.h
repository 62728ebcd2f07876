// Paths of this checkout and of the built program. Only paths.cpp has their values. So every other test compiles to the same bytes in every
// checkout, and a compiler cache serves them all.
#pragma once

#include <string>

namespace steradian::test {

extern const std::string kSourceDir;     // the repository's folder
extern const std::string kProgram;       // the program `steradian`
extern const std::string kFaultyDevice;  // folder of the Vulkan layer that fails on demand

}  // namespace steradian::test
