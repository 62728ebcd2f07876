#include "cases.h"
#include "rounded.h"
#include "run_case.h"

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
    const auto r = run_case<S>(index, &inputs[n],
                               [](float x) { return Real<S>::of(S{static_cast<double>(x), 0.0}); });
    for (const S& s : {r.x.v, r.y.v, r.z.v, r.w.v}) {
      results.value.push_back(s.v);
      results.bound.push_back(s.e);
    }
  }
  return results;
}

}  // namespace

std::vector<double> run_double(std::size_t index, const std::vector<float>& inputs) {
  return run_scalar<double>(index, inputs);
}

std::vector<double> run_double_at(std::size_t index, const std::vector<double>& input) {
  const auto r = run_case<double>(index, input.data(), [](double x) { return Real<double>(x); });
  return {r.x.v, r.y.v, r.z.v, r.w.v};
}

std::vector<float> run_float(std::size_t index, const std::vector<float>& inputs) {
  return run_scalar<float>(index, inputs);
}

BoundedResults run_bounded(std::size_t index, const std::vector<float>& inputs, Rounding rounding) {
  return rounding == Rounding::cpu ? run_rounded<CpuModel>(index, inputs) : run_rounded<GpuModel>(index, inputs);
}

}  // namespace steradian::parity
