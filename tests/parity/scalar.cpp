#include <array>
#include <cmath>

#include "cases.h"
#include "rounded.h"
#include "run_case.h"
#include "shaken.h"

namespace steradian::parity {
namespace {

template <class S>
std::vector<S> run_scalar(std::size_t index, const std::vector<float>& inputs) {
  std::vector<S> results;
  for (std::size_t n = 0; n < inputs.size(); n += kInputs) {
    const auto r = run_case<S>(index, &inputs[n], [](float x) { return Real<S>::of(static_cast<S>(x)); });
    results.insert(results.end(), {r.x.v, r.y.v, r.z.v, r.w.v});
  }
  return results;
}

template <class Model>
BoundedResults run_rounded(std::size_t index, const std::vector<float>& inputs) {
  using S = Rounded<Model>;
  BoundedResults results;
  for (std::size_t n = 0; n < inputs.size(); n += kInputs) {
    const auto r = run_case<S>(index, &inputs[n], [](float x) { return Real<S>::of(S{static_cast<double>(x), 0.0}); });
    for (const S& s : {r.x.v, r.y.v, r.z.v, r.w.v}) {
      results.value.push_back(s.v);
      results.bound.push_back(s.e);
    }
  }
  return results;
}

// Sixteen evaluations with different roundings. For roughly normal errors, Student's t at 15 degrees of freedom exceeds 11.5 deviations
// once in 10^8 times. A table of the affected cases makes some 10^6 comparisons.
template <class Model>
BoundedResults run_shaken(std::size_t index, const std::vector<float>& inputs) {
  using S = Shaken<Model>;
  constexpr std::uint64_t kEvaluations = 16;
  constexpr double kDeviations = 11.5;
  BoundedResults results;
  const auto evaluate = [index](const float* input) {
    const auto r = run_case<S>(index, input, [](float x) { return Real<S>::of(S{static_cast<double>(x)}); });
    return std::array<double, kResults>{r.x.v.v, r.y.v.v, r.z.v.v, r.w.v.v};
  };
  for (std::size_t n = 0; n < inputs.size(); n += kInputs) {
    shaking().restart(0, 0.0);
    const auto value = evaluate(&inputs[n]);
    std::array<double, kResults> squares{};
    for (std::uint64_t seed = 1; seed <= kEvaluations; ++seed) {
      shaking().restart(seed, 1.0);
      const auto shaken = evaluate(&inputs[n]);
      for (std::size_t v = 0; v < kResults; ++v) squares[v] += (shaken[v] - value[v]) * (shaken[v] - value[v]);
    }
    for (std::size_t v = 0; v < kResults; ++v) {
      results.value.push_back(value[v]);
      results.bound.push_back(kDeviations * std::sqrt(squares[v] / (kEvaluations - 1)));
    }
  }
  return results;
}

template <class Model>
BoundedResults run_bounded(std::size_t index, const std::vector<float>& inputs) {
  return cases()[index].bound == Bound::running ? run_rounded<Model>(index, inputs) : run_shaken<Model>(index, inputs);
}

}  // namespace

std::vector<double> run_double(std::size_t index, const std::vector<float>& inputs) { return run_scalar<double>(index, inputs); }

std::vector<double> run_double_at(std::size_t index, const std::vector<double>& input) {
  const auto r = run_case<double>(index, input.data(), [](double x) { return Real<double>(x); });
  return {r.x.v, r.y.v, r.z.v, r.w.v};
}

std::vector<float> run_float(std::size_t index, const std::vector<float>& inputs) { return run_scalar<float>(index, inputs); }

BoundedResults run_bounded(std::size_t index, const std::vector<float>& inputs, Rounding rounding) {
  return rounding == Rounding::cpu ? run_bounded<CpuModel>(index, inputs) : run_bounded<GpuModel>(index, inputs);
}

}  // namespace steradian::parity
