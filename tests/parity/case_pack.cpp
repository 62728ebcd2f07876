#include "core/pack.h"
#include "packs.h"

STERADIAN_BEGIN_ISA
namespace {

// Compiled without flatten: the cases together are a lot of code, and their speed does not matter.
PackKernels::vec4 run_case(std::size_t index, const PackKernels::CaseInput& i) {
  PackKernels k;
  std::size_t n = 0;
#define PARITY_CASE(name, title, measure, values, arithmetic, bound, inputs) \
  if (index == n++) return k.case_##name(i);
#include "parity_cases.inc"
#undef PARITY_CASE
  return {PackReal(0.0), PackReal(0.0), PackReal(0.0), PackReal(0.0)};
}

void run(std::size_t index, const float* inputs, float* results, std::size_t count) {
  for (std::size_t n = 0; n < count; n += kLanes) {
    float lanes[16][kLanes];
    for (std::size_t m = 0; m < 16; ++m)
      for (std::size_t l = 0; l < kLanes; ++l) lanes[m][l] = inputs[(n + l) * 16 + m];
    PackKernels::CaseInput i;
    std::size_t m = 0;
    for (auto* member : {&i.a, &i.b, &i.c, &i.d}) {
      *member = {load(lanes[m]), load(lanes[m + 1]), load(lanes[m + 2]), load(lanes[m + 3])};
      m += 4;
    }
    const auto r = run_case(index, i);
    float out[4][kLanes];
    store(out[0], r.x);
    store(out[1], r.y);
    store(out[2], r.z);
    store(out[3], r.w);
    for (std::size_t l = 0; l < kLanes; ++l)
      for (std::size_t v = 0; v < 4; ++v) results[(n + l) * 4 + v] = out[v][l];
  }
}

}  // namespace

const parity::PackTable& parity_table() {
  static constexpr parity::PackTable table = {run};
  return table;
}

STERADIAN_END_ISA
