// Reading of a whole file: its size is known and checked against the budget before memory is allocated.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/budget.h"

namespace steradian {

using Bytes = std::vector<std::uint8_t>;

// place: the source that names the file, for the Error. Only regular files are read: a device has no size and may never end.
Bytes read_file(const std::string& path, const std::string& place, Budget& budget);

}  // namespace steradian
