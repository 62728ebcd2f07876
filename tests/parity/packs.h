// The parity cases on packs: one table per instruction set, fast and strict (cmake/instruction_sets.cmake).
#pragma once

#include <cstddef>

#include "core/simd.h"

namespace steradian {
namespace parity {

struct PackTable {
  // inputs: count times sixteen floats, results: count times four; count is a multiple of 16.
  void (*run)(std::size_t index, const float* inputs, float* results, std::size_t count);
};

}  // namespace parity

STERADIAN_DECLARE_PACK_TABLE_IN(_parity, parity::PackTable, parity_table)
STERADIAN_DECLARE_PACK_TABLE_IN(_strict, parity::PackTable, parity_table)

}  // namespace steradian
