#include "steradian/version.h"

namespace steradian {

const char* version() { return STERADIAN_VERSION; }

}  // namespace steradian
