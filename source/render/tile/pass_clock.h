// PassClock: thread time of a pass, summed over tiles.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <string>
#include <utility>

#include "steradian/render.h"

namespace steradian {

using Clock = std::chrono::steady_clock;

inline double ms_since(Clock::time_point start) { return std::chrono::duration<double, std::milli>(Clock::now() - start).count(); }

class PassClock {
 public:
  explicit PassClock(std::string name) : name_(std::move(name)) {}
  template <class Work>
  void run(Work work) {
    const auto start = Clock::now();
    work();
    nanoseconds_ += std::chrono::duration_cast<std::chrono::nanoseconds>(Clock::now() - start).count();
  }
  PassTime time(int threads) const { return {name_, static_cast<double>(nanoseconds_) * 1e-6 / threads}; }

 private:
  std::string name_;
  std::atomic<std::int64_t> nanoseconds_{0};
};

}  // namespace steradian
