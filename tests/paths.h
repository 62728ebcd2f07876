// Where this checkout and the built program are. Values of paths.cpp alone, so that every other test compiles to the same
// bytes in every checkout and a compiler cache serves them all.
#pragma once

#include <string>

namespace steradian::test {

extern const std::string kSourceDir;     // of the repository
extern const std::string kProgram;       // the program `steradian`
extern const std::string kFaultyDevice;  // folder of the Vulkan layer that fails when it is told to

}  // namespace steradian::test
