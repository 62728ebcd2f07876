#include "paths.h"

namespace steradian::test {

const std::string kSourceDir = STERADIAN_SOURCE_DIR;
const std::string kProgram = STERADIAN_PROGRAM;
const std::string kFaultyDevice = STERADIAN_FAULTY_DEVICE;

}  // namespace steradian::test
