#include "paths.h"

namespace steradian::test {

const std::string kSourceDir = STERADIAN_SOURCE_DIR;
const std::string kProgram = STERADIAN_PROGRAM;

}  // namespace steradian::test
