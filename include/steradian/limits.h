// Limits: what reading and preparing a file may take of the machine. A file that asks for more is refused before anything
// is taken, with a sentence that says what is too large, where, and which option raises the limit.
#pragma once

#include <cstdint>

namespace steradian {

struct Limits {
  std::uint64_t memory = 4'000'000'000;  // bytes that what a file holds may take (--max-memory)
  std::uint64_t work = 2'000'000'000;    // elementary steps of about a nanosecond before the first pixel (--max-work)
};

}  // namespace steradian
