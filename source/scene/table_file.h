// A fitted table in a file, in the format of `steradian fit --layout classic -o FILE.json`.
#pragma once

#include <string>

#include "integrals/tables/table.h"

namespace steradian::scene {

// The table with the middle element 1, whatever the file's normalisation. Throws Error with the path if the file is no complete table of
// finite numbers.
ClassicTable read_classic_table(const std::string& path);

}  // namespace steradian::scene
