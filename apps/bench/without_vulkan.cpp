// Compiled where STERADIAN_VULKAN is OFF: there are no benches of kernels on a device.
#include "bench/benches.h"
#include "bench/phong_on_device.h"
#include "steradian/error.h"

namespace steradian::bench {

void add_phong_on_device(BenchList&, const std::string&) {}

std::vector<vulkan::PipelineReport> compile_phong(const std::string&) {
  throw Error("--pipelines", "this program was built without Vulkan", "build it with -DSTERADIAN_VULKAN=ON, as ./dev build does");
}

}  // namespace steradian::bench
