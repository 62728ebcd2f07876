#include <fmt/format.h>

#include <ostream>

#include "gpu.h"
#include "sections.h"

namespace steradian::accuracy {
namespace {

using namespace parity;

constexpr std::size_t kCount = 10000;

const char* name_of(Domain domain) {
  switch (domain) {
    case Domain::direction: return "direction";
    case Domain::upper_direction: return "upper direction";
    case Domain::vector: return "vector of length";
    case Domain::range: return "uniform in";
    case Domain::log: return "log-uniform in";
    case Domain::signed_log: return "±log-uniform in";
    case Domain::integer: return "whole in";
  }
  return "?";
}

std::string describe(const Input& input) {
  if (input.domain == Domain::direction || input.domain == Domain::upper_direction) return name_of(input.domain);
  return fmt::format("{} [{:g}, {:g}]", name_of(input.domain), input.low, input.high);
}

// Equal inputs are counted, not repeated: "3 x direction".
std::string describe(const std::vector<Input>& inputs) {
  std::string words;
  for (std::size_t i = 0; i < inputs.size();) {
    std::size_t n = i;
    while (n < inputs.size() && describe(inputs[n]) == describe(inputs[i])) ++n;
    words += (words.empty() ? "" : "; ") + (n - i > 1 ? fmt::format("{} × ", n - i) : "") + describe(inputs[i]);
    i = n;
  }
  return words;
}

}  // namespace

void write_functions(std::ostream& out) {
  out << "\n## Float against double\n\n"
      << fmt::format("{} random inputs each, the same floats for both. A relative error is relative to each result.\n\n", kCount)
      << "| function | domain | error | largest | rms |\n|---|---|---|---:|---:|\n";
  for (std::size_t index = 0; index < cases().size(); ++index) {
    const CaseReport r = compare(index, {}, kCount);
    out << fmt::format("| {} | {} | {} | {:.1e} | {:.1e} |\n", r.which->title, describe(r.which->inputs),
                       r.which->measure == Measure::relative ? "relative" : "absolute", r.largest, r.rms);
  }
}

void write_targets(std::ostream& out) {
  std::vector<Target> targets = cpu_targets();
  targets.erase(targets.begin());  // scalar float is the reference for the others
  std::string devices;
  for (const vulkan::DeviceInfo& info : vulkan::list_devices()) {
    const auto device = std::make_shared<vulkan::Device>(vulkan::DeviceOptions{info.name, false});
    targets.push_back(gpu_target(device, ShaderText::glsl));
    targets.push_back(gpu_target(device, ShaderText::hlsl));
    devices += fmt::format(" Vulkan device: {} ({}).", info.name, info.driver);
  }
  out << "\n## Packs and GPUs against scalar float\n\n"
      << "The same inputs. \"=\" means the same bits for every one of them; a number is the largest difference, relative where the\n"
      << "table above is. Strict packs and shaders run without contraction; the other packs are the renderer's, with fused\n"
      << "multiply-add and approximate reciprocal roots. \"Bound\" is the median over the inputs of the bound that running error analysis\n"
      << "derives for each of them (relative to the result, or to the largest result where errors are absolute); the tests hold every\n"
      << "target to that bound on every input, and demand equal bits of the strict packs and of software Vulkan where neither exp nor\n"
      << "log is involved. With an asterisk: where that analysis finds none, 11.5 standard deviations of sixteen evaluations with random\n"
      << "roundings (tests/parity/shaken.h)." << devices << "\n\n| function | bound |";
  for (const Target& t : targets) out << ' ' << t.name << " |";
  out << "\n|---|---:|";
  for (std::size_t t = 0; t < targets.size(); ++t) out << "---:|";
  out << '\n';
  for (std::size_t index = 0; index < cases().size(); ++index) {
    const CaseReport r = compare(index, targets, kCount);
    out << fmt::format("| {} | {:.0e}{} |", r.which->title, r.typical_bound, r.which->bound == Bound::running ? "" : "*");
    for (const Difference& d : r.targets) out << (d.unequal == 0 ? " = |" : fmt::format(" {:.0e} |", d.largest));
    out << '\n';
  }
}

}  // namespace steradian::accuracy
