// Budget: the remainder of a job's Limits, and the Error that refuses more.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "steradian/error.h"
#include "steradian/limits.h"

namespace steradian {

// Code that builds something of a size that a file chose takes its bytes or steps from the budget first. Not thread-safe.
class Budget {
 public:
  explicit Budget(const Limits& limits = {}) : limits_(limits) {}

  const Limits& limits() const { return limits_; }

  // Throws Error at `place` if the bytes exceed the rest of the budget. what: "the pixels of the picture".
  void take_memory(const std::string& place, std::string_view what, std::uint64_t bytes);
  // Returns bytes that were taken and are free again.
  void give_back_memory(std::uint64_t bytes) { memory_ -= bytes < memory_ ? bytes : memory_; }
  std::uint64_t memory_taken() const { return memory_; }

  // The same for steps of work. what: "the crossings of its curves".
  void take_work(const std::string& place, std::string_view what, std::uint64_t steps);

  // Error to throw if the machine ran out of memory although the budget had not. It names what was taken last.
  Error out_of_memory() const;

 private:
  Limits limits_;
  std::uint64_t memory_ = 0, work_ = 0;
  std::string last_place_, last_what_;
  std::uint64_t last_bytes_ = 0;
};

// Formats bytes like "1.5 GB": three digits, in powers of 1000.
std::string readable_bytes(std::uint64_t bytes);

}  // namespace steradian
