// Random: uniform numbers that are the same on every platform, unlike the standard library's distributions.
#pragma once

#include <cstdint>

namespace steradian::reference {

// PCG32 (XSH-RR): 64 bits of state, 32 out.
// Source: O'Neill, "PCG: a family of simple fast space-efficient statistically good algorithms", 2014.
class Random {
 public:
  // Different streams of one seed are independent.
  explicit Random(std::uint64_t seed, std::uint64_t stream = 0) : increment_(2 * stream + 1) {
    bits();
    state_ += mixed(seed);
    bits();
  }

  std::uint32_t bits() {
    const std::uint64_t old = state_;
    state_ = old * 6364136223846793005u + increment_;
    const auto shifted = static_cast<std::uint32_t>(((old >> 18) ^ old) >> 27);
    const auto turn = static_cast<std::uint32_t>(old >> 59);
    return (shifted >> turn) | (shifted << ((32 - turn) & 31));
  }

  // Uniform number in [0, 1), a multiple of 2^-53.
  double uniform() {
    const std::uint64_t high = bits() >> 5, low = bits() >> 6;
    return static_cast<double>((high << 26) | low) * 0x1p-53;
  }
  double uniform(double low, double high) { return low + (high - low) * uniform(); }

 private:
  // Maps neighbouring seeds to states that are far apart. Source: Steele, Lea, Flood, "Fast splittable pseudorandom number generators",
  // 2014 (the finaliser of SplitMix64).
  static std::uint64_t mixed(std::uint64_t x) {
    x += 0x9e3779b97f4a7c15u;
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
    return x ^ (x >> 31);
  }

  std::uint64_t state_ = 0;
  std::uint64_t increment_;
};

}  // namespace steradian::reference
