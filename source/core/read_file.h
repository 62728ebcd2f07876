// A whole file in memory, its size known and allowed before memory is taken.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/budget.h"

namespace steradian {

using Bytes = std::vector<std::uint8_t>;

// place: who names the file, for the Error. Only regular files: a device has no size and may never end.
Bytes read_file(const std::string& path, const std::string& place, Budget& budget);

}  // namespace steradian
