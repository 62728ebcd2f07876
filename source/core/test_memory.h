// What tests ask of this process's memory.
#pragma once

#include <unistd.h>

#include <fstream>

namespace steradian::test {

// What of the process's memory is in the machine's, in MiB.
inline double resident_mib() {
  std::ifstream file("/proc/self/statm");
  double all = 0, resident = 0;
  file >> all >> resident;
  return resident * static_cast<double>(sysconf(_SC_PAGESIZE)) / (1 << 20);
}

}  // namespace steradian::test
