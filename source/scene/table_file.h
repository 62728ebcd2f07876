// A fitted table in a file, as `steradian fit --layout classic -o FILE.json` writes it.
#pragma once

#include <string>

#include "integrals/ltc/table.h"

namespace steradian::scene {

// Throws Error with the path for what is no whole table of finite numbers.
ClassicTable read_classic_table(const std::string& path);

}  // namespace steradian::scene
