#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "gpu.h"

namespace steradian::parity {
namespace {

constexpr std::size_t kCount = 10000;

// Checks every case on the given targets: within the bound, and the same bits if they are guaranteed.
void check_all(const std::vector<Target>& targets) {
  for (std::size_t index = 0; index < cases().size(); ++index) {
    const CaseReport report = compare(index, targets, kCount);
    for (std::size_t t = 0; t < targets.size(); ++t) {
      const Difference& d = report.targets[t];
      EXPECT_EQ(d.beyond, 0u) << report.which->name << " on " << targets[t].name << ": " << d.first_beyond;
      if (targets[t].equal_in_arithmetic && report.which->arithmetic) {
        EXPECT_EQ(d.unequal, 0u) << report.which->name << " on " << targets[t].name << ": largest difference " << d.largest;
      }
    }
  }
}

}  // namespace

TEST(Parity, PacksAgreeWithScalarFloat) { check_all(cpu_targets()); }

// If the bound were infinite for nearly all inputs, the other tests would pass whatever the kernels compute.
TEST(Parity, ErrorAnalysisBoundsNearlyEveryInput) {
  for (std::size_t index = 0; index < cases().size(); ++index) {
    const CaseReport report = compare(index, {}, 2000);
    EXPECT_LE(report.without_bound, report.inputs / 50) << report.which->name;
    EXPECT_LE(report.typical_bound, 1e-3) << report.which->name;
  }
}

TEST(Parity, ShadersAgreeWithScalarFloatAndTheValidationLayerIsSilent) {
  const auto devices = vulkan::list_devices();
  if (devices.empty()) GTEST_SKIP() << "no Vulkan device here: install mesa-vulkan-drivers for a software one";
  for (const vulkan::DeviceInfo& info : devices) {
    SCOPED_TRACE(info.name);
    const auto device = std::make_shared<vulkan::Device>(vulkan::DeviceOptions{info.name, true});
    check_all({gpu_target(device, ShaderText::glsl), gpu_target(device, ShaderText::hlsl)});
    EXPECT_TRUE(device->validation_messages().empty())
        << device->validation_messages().size() << " messages, the first: " << device->validation_messages().front();
  }
}

// Compares exact derivatives with central differences at two steps. The difference of these bounds the truncation error of the finer step.
// The rounding of its values is the float bound of the same input, scaled from 24 bits to 53.
TEST(Parity, DerivativesOfEveryKernelAgreeWithCentralDifferences) {
  std::size_t checked = 0;
  for (std::size_t index = 0; index < cases().size(); ++index) {
    const Case& which = cases()[index];
    const std::vector<float> inputs = random_inputs(which, 100, 2);
    const BoundedResults bounded = run_bounded(index, inputs, Rounding::cpu);
    for (std::size_t n = 0; n < 100; ++n) {
      const std::vector<double> x(inputs.begin() + static_cast<std::ptrdiff_t>(n * kInputs),
                                  inputs.begin() + static_cast<std::ptrdiff_t>((n + 1) * kInputs));
      const auto derivatives = run_dual(index, x);
      for (std::size_t m = 0; m < kInputs; ++m) {
        if (!(std::fabs(x[m]) > 0)) continue;
        const double h = std::ldexp(1.0, std::ilogb(x[m]) - 17);  // makes x + h exact: x is a float
        const auto at = [&](double step) {
          std::vector<double> moved = x;
          moved[m] += step;
          return run_double_at(index, moved);
        };
        const auto near_up = at(h), near_down = at(-h), far_up = at(2 * h), far_down = at(-2 * h);
        for (std::size_t v = 0; v < kResults; ++v) {
          const double fine = (near_up[v] - near_down[v]) / (2 * h), coarse = (far_up[v] - far_down[v]) / (4 * h);
          const double rounding = 2 * bounded.bound[n * kResults + v] * 0x1p-29 / h;
          if (!std::isfinite(rounding)) continue;
          EXPECT_NEAR(derivatives[v][m], fine, std::fabs(fine - coarse) + rounding)
              << which.name << ", result " << v << " by input " << m << " = " << x[m] << ", sample " << n;
          ++checked;
        }
      }
    }
  }
  EXPECT_GE(checked, cases().size() * 100);
}

TEST(Parity, AMistakeInOnePreludeIsFound) {
  const auto devices = vulkan::list_devices();
  if (devices.empty()) GTEST_SKIP() << "no Vulkan device here: install mesa-vulkan-drivers for a software one";
  const Target broken = gpu_target(std::make_shared<vulkan::Device>(), ShaderText::broken_glsl);
  std::size_t found = 0;
  for (std::size_t index = 0; index < cases().size(); ++index) found += compare(index, {broken}, 1000).targets[0].beyond > 0;
  EXPECT_GE(found, cases().size() / 4) << "a select with its sides exchanged shows in " << found << " cases";
}

}  // namespace steradian::parity
