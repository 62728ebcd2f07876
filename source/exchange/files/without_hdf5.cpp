#include "exchange/files/hdf5_file.h"
#include "steradian/error.h"

namespace steradian::exchange {

void check_hdf5() {
  throw UsageError(".h5", "this build writes no HDF5",
                   "configure with -DSTERADIAN_HDF5=ON (Debian: libhdf5-dev), or write .npz, which has the same arrays");
}

void write_hdf5(const std::string&, const std::vector<NpyArray>&) { check_hdf5(); }

}  // namespace steradian::exchange
