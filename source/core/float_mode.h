// FlushDenormals: sets flush-to-zero and denormals-are-zero for a scope, and restores the thread's mode after it.
//
// High powers of a cosine run into denormals, which cost a hundred cycles each.
#pragma once

#if defined(__aarch64__)
#include <cstdint>
#else
#include <immintrin.h>
#endif

namespace steradian {

class FlushDenormals {
 public:
  FlushDenormals() : saved_(mode()) { set(saved_ | kFlush); }
  ~FlushDenormals() { set(saved_); }
  FlushDenormals(const FlushDenormals&) = delete;
  FlushDenormals& operator=(const FlushDenormals&) = delete;

 private:
#if defined(__aarch64__)
  using Mode = std::uint64_t;
  static constexpr Mode kFlush = Mode{1} << 24;  // one bit of FPCR for inputs and results
  static Mode mode() {
    Mode mode;
    asm volatile("mrs %0, fpcr" : "=r"(mode));
    return mode;
  }
  static void set(Mode mode) { asm volatile("msr fpcr, %0" : : "r"(mode)); }
#else
  using Mode = unsigned;
  static constexpr Mode kFlush = 0x8040;  // FTZ is bit 15, DAZ bit 6
  static Mode mode() { return _mm_getcsr(); }
  static void set(Mode mode) { _mm_setcsr(mode); }
#endif
  Mode saved_;
};

}  // namespace steradian
