// HDF5: named arrays as datasets of one file. Without that part (STERADIAN_HDF5), writing says how to get it.
#pragma once

#include <string>
#include <vector>

#include "exchange/files/npz.h"

namespace steradian::exchange {

// Throws UsageError where this build has no HDF5.
void check_hdf5();

// Writes all arrays to a file, whole or not at all; texts are UTF-8. The file is composed in memory first. The same arrays give the same
// bytes with the same version of HDF5.
void write_hdf5(const std::string& path, const std::vector<NpyArray>& arrays);

}  // namespace steradian::exchange
