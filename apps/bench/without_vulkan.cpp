// Compiled where STERADIAN_VULKAN is OFF: there are no benches of kernels on a device.
#include "bench/benches.h"

namespace steradian::bench {

void add_phong_on_device(BenchList&, const std::string&) {}

}  // namespace steradian::bench
