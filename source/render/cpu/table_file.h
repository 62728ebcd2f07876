// A fitted table in a file, as `steradian fit --layout classic -o FILE.json` writes it.
#pragma once

#include <string>

#include "render/cpu/ltc_points.h"

namespace steradian {

// Throws Error with the path for what is no whole table of finite numbers.
LtcPackTables read_classic_table(const std::string& path);

}  // namespace steradian
