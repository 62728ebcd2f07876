// Memory use of the test process.
#pragma once

#include <unistd.h>

#include <fstream>

namespace steradian::test {

// Resident memory of this process [MiB].
inline double resident_mib() {
  std::ifstream file("/proc/self/statm");
  double all = 0, resident = 0;
  file >> all >> resident;
  return resident * static_cast<double>(sysconf(_SC_PAGESIZE)) / (1 << 20);
}

}  // namespace steradian::test
