#include "cases.h"
#include "run_case.h"
#include "steradian/dual.h"

namespace steradian::parity {

std::vector<std::vector<double>> run_dual(std::size_t index, const std::vector<double>& input) {
  constexpr std::size_t kDirections = 8;
  using S = Dual<kDirections>;
  std::vector<std::vector<double>> derivatives(kResults);
  for (std::size_t begin = 0; begin < kInputs; begin += kDirections) {
    std::size_t n = 0;
    const auto r = run_case<S>(index, input.data(), [&](double x) {
      Real<S> seeded(x);
      if (n >= begin && n < begin + kDirections && n < kInputs) seeded.v.d[n - begin] = 1.0;
      ++n;
      return seeded;
    });
    const S results[] = {r.x.v, r.y.v, r.z.v, r.w.v};
    for (std::size_t v = 0; v < kResults; ++v) derivatives[v].insert(derivatives[v].end(), results[v].d.begin(), results[v].d.end());
  }
  return derivatives;
}

}  // namespace steradian::parity
