#include "paths.h"

namespace steradian::test {

std::string find_source_dir() { return STERADIAN_SOURCE_DIR; }
std::string find_program() { return STERADIAN_PROGRAM; }
std::string find_faulty_device() { return STERADIAN_FAULTY_DEVICE; }

}  // namespace steradian::test
