// Pictures of --part, joined into one.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "part.h"
#include "steradian/limits.h"
#include "steradian/picture.h"

namespace steradian::app {

// Reads the pictures of all parts. take(all, part, which) copies what a part holds into the first one. The result has the metadata on which
// all parts agree. Throws Error for parts that are missing, stand twice, or do not belong together. kind: the verb that makes such parts.
Picture join_parts(const std::vector<std::string>& paths, const std::string& kind, const Limits& limits,
                   const std::function<void(Picture& all, const Picture& part, Part which)>& take);

}  // namespace steradian::app
