// Limits: bounds on memory and work for reading and preparing a file. A file that exceeds them is refused before anything is allocated. The
// message says what is too large, where, and which option raises the limit.
#pragma once

#include <cstdint>

namespace steradian {

struct Limits {
  std::uint64_t memory = 4'000'000'000;  // bytes that the contents of a file may take (--max-memory)
  std::uint64_t work = 2'000'000'000;    // elementary steps of about a nanosecond before the first pixel (--max-work)
};

}  // namespace steradian
