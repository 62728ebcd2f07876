// parity [COUNT [NAME FOLDER]]: runs every kernel on every target of this machine, one row per kernel, on COUNT random inputs (10000). With
// FOLDER it runs only the shaders in that folder (split_spirv.py), which are shown under NAME.
//
// float is compared with double (largest and rms error), everything else with scalar float. "equal" means the same bits for all inputs. A
// number is the largest difference. The number after the colon is its fraction of the bound that running error analysis finds for that
// input. The exit status is 1 if a target exceeds the bound, or if required bits differ.
#include <fmt/format.h>

#include <cstdlib>

#include "gpu.h"

using namespace steradian;
using namespace steradian::parity;

int main(int argc, char** argv) {
  const std::size_t count = argc > 1 ? std::strtoul(argv[1], nullptr, 10) : 10000;
  std::vector<Target> targets;
  if (argc <= 3) targets = cpu_targets();
  for (const vulkan::DeviceInfo& info : vulkan::list_devices()) {
    const auto device = std::make_shared<vulkan::Device>(vulkan::DeviceOptions{info.name, false});
    if (argc > 3) {
      targets.push_back(gpu_target(device, argv[2], argv[3]));
    } else {
      targets.push_back(gpu_target(device, ShaderText::glsl));
      targets.push_back(gpu_target(device, ShaderText::hlsl));
    }
    fmt::print("{}: {}\n", targets.back().name, info.name);
  }

  fmt::print("{:34} {:>9} {:>9} {:>9}", "case", "max error", "rms error", "bound");
  for (const Target& t : targets) fmt::print(" {:>15}", t.name);
  fmt::print("\n");
  bool failed = false;
  for (std::size_t index = 0; index < cases().size(); ++index) {
    const CaseReport report = compare(index, targets, count);
    fmt::print("{:34} {:9.1e} {:9.1e} {:9.1e}", report.which->name, report.largest, report.rms, report.typical_bound);
    std::string words;
    for (std::size_t t = 0; t < targets.size(); ++t) {
      const Difference& d = report.targets[t];
      fmt::print(" {:>15}", d.unequal == 0 ? "equal" : fmt::format("{:.1e}:{:.2f}", d.largest, d.share));
      if (d.beyond > 0) words += fmt::format("  {}: {} beyond the bound; {}\n", targets[t].name, d.beyond, d.first_beyond);
      if (d.unequal > 0 && report.which->arithmetic && targets[t].equal_in_arithmetic)
        words += fmt::format("  {}: {} of {} have other bits\n", targets[t].name, d.unequal, count);
    }
    fmt::print("  {} without bound\n{}", report.without_bound, words);
    failed = failed || !words.empty();
  }
  return failed ? 1 : 0;
}
