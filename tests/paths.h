// Paths of this checkout and of the built program. Only paths.cpp has their values. So every other test compiles to the same bytes in every
// checkout, and a compiler cache serves them all.
#pragma once

#include <string>

namespace steradian::test {

std::string find_source_dir();
std::string find_program();
std::string find_faulty_device();

// They are inline, so a constant of a test file that is made of one of them is always made after it.
inline const std::string kSourceDir = find_source_dir();        // the repository's folder
inline const std::string kProgram = find_program();             // the program `steradian`
inline const std::string kFaultyDevice = find_faulty_device();  // folder of the Vulkan layer that fails on demand

}  // namespace steradian::test
