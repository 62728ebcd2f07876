// The parity cases on packs: one table per instruction set, fast and strict (cmake/instruction_sets.cmake).
#pragma once

#include <cstddef>

namespace steradian {
namespace parity {

struct PackTable {
  // inputs: count times sixteen floats, results: count times four; count is a multiple of 16.
  void (*run)(std::size_t index, const float* inputs, float* results, std::size_t count);
};

}  // namespace parity

namespace isa_sse2_parity {
const parity::PackTable& parity_table();
}
namespace isa_avx2_parity {
const parity::PackTable& parity_table();
}
namespace isa_avx512_parity {
const parity::PackTable& parity_table();
}
namespace isa_sse2_strict {
const parity::PackTable& parity_table();
}
namespace isa_avx2_strict {
const parity::PackTable& parity_table();
}
namespace isa_avx512_strict {
const parity::PackTable& parity_table();
}

}  // namespace steradian
