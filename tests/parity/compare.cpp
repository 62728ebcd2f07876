#include "compare.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace steradian::parity {
namespace {

bool same(float a, float b) { return a == b || (std::isnan(a) && std::isnan(b)); }

// Results below the smallest normal float may round to zero. So relative errors are relative to at least that float.
double error(Measure measure, double x, double truth) {
  const double difference = std::fabs(x - truth);
  return measure == Measure::absolute ? difference : difference / std::fmax(std::fabs(truth), 0x1p-126);
}

std::string describe(const std::vector<float>& inputs, std::size_t n, double got, double value, double bound) {
  std::ostringstream out;
  out.precision(9);
  out << "inputs";
  for (std::size_t m = 0; m < kInputs; ++m) out << ' ' << inputs[n * kInputs + m];
  out << ": got " << got << ", float without roundings is " << value << ", bound " << bound;
  return out.str();
}

Difference compare_target(const Case& which, const std::vector<float>& inputs, const std::vector<float>& got,
                          const std::vector<float>& scalar, const BoundedResults& bounded) {
  Difference d;
  for (std::size_t n = 0; n < inputs.size() / kInputs; ++n) {
    bool equal = true, beyond = false;
    for (std::size_t v = 0; v < kResults; ++v) {
      const std::size_t r = n * kResults + v;
      const double x = got[r], bound = bounded.bound[r], off = std::fabs(x - bounded.value[r]);
      equal = equal && same(got[r], scalar[r]);
      d.largest = std::fmax(d.largest, error(which.measure, x, scalar[r]));
      if (off > 0 && std::isfinite(bound)) d.share = std::fmax(d.share, off / bound);
      if (std::isfinite(x) && (off <= bound || !std::isfinite(bound))) continue;
      if (d.first_beyond.empty()) d.first_beyond = describe(inputs, n, x, bounded.value[r], bound);
      beyond = true;
    }
    d.unequal += !equal;
    d.beyond += beyond;
  }
  return d;
}

}  // namespace

std::vector<Target> cpu_targets() {
  std::vector<Target> targets = {{"float", Rounding::cpu, true, run_float}};
  for (PackKind kind : {PackKind::strict, PackKind::fast})
    for (Simd simd : available_simd()) {
      const bool strict = kind == PackKind::strict;
      targets.push_back(
          {std::string(name_of(simd)) + (strict ? " strict" : ""), Rounding::cpu, strict,
           [simd, kind](std::size_t index, const std::vector<float>& inputs) { return run_packs(index, inputs, simd, kind); }});
    }
  return targets;
}

CaseReport compare(std::size_t index, const std::vector<Target>& targets, std::size_t count, std::uint64_t seed) {
  CaseReport report;
  const Case& which = cases()[index];
  report.which = &which;
  report.inputs = count;
  const std::vector<float> inputs = random_inputs(which, count, seed);
  const std::vector<double> truth = run_double(index, inputs);
  const std::vector<float> scalar = run_float(index, inputs);
  const BoundedResults cpu = run_bounded(index, inputs, Rounding::cpu);
  const bool on_gpu = std::any_of(targets.begin(), targets.end(), [](const Target& t) { return t.rounding == Rounding::gpu; });
  const BoundedResults gpu = on_gpu ? run_bounded(index, inputs, Rounding::gpu) : BoundedResults{};

  double squares = 0, largest_value = 0;
  std::vector<double> bounds;
  for (std::size_t n = 0; n < count; ++n) {
    bool bounded = true;
    for (std::size_t v = 0; v < static_cast<std::size_t>(which.values); ++v) {
      const std::size_t r = n * kResults + v;
      const double e = error(which.measure, scalar[r], truth[r]);
      report.largest = std::fmax(report.largest, e);
      squares += e * e;
      largest_value = std::fmax(largest_value, std::fabs(truth[r]));
      bounded = bounded && std::isfinite(cpu.bound[r]);
      if (which.measure == Measure::absolute || truth[r] < 0 || truth[r] > 0)
        bounds.push_back(which.measure == Measure::absolute ? cpu.bound[r] : cpu.bound[r] / std::fabs(truth[r]));
    }
    report.without_bound += !bounded;
  }
  report.rms = std::sqrt(squares / static_cast<double>(count * static_cast<std::size_t>(which.values)));
  std::nth_element(bounds.begin(), bounds.begin() + static_cast<std::ptrdiff_t>(bounds.size() / 2), bounds.end());
  report.typical_bound = bounds[bounds.size() / 2] / (which.measure == Measure::absolute ? largest_value : 1.0);

  for (const Target& target : targets)
    report.targets.push_back(
        compare_target(which, inputs, target.run(index, inputs), scalar, target.rounding == Rounding::cpu ? cpu : gpu));
  return report;
}

}  // namespace steradian::parity
