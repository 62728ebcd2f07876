// Memory use of the test process.
#pragma once

#include <malloc.h>
#include <unistd.h>

#include <fstream>

namespace steradian::test {

// Resident memory of this process [MiB], without what the allocator holds for later: that depends on the tests before.
inline double resident_mib() {
  malloc_trim(0);
  std::ifstream file("/proc/self/statm");
  double all = 0, resident = 0;
  file >> all >> resident;
  return resident * static_cast<double>(sysconf(_SC_PAGESIZE)) / (1 << 20);
}

}  // namespace steradian::test
