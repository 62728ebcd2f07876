// EXR in memory: the file's bytes, so that writing to disk happens in one place.
#pragma once

#include <string>

#include "steradian/picture.h"

namespace steradian {

std::string encode_exr(const Picture& picture);
Picture decode_exr(const std::string& path);

}  // namespace steradian
