// FlushDenormals: sets flush-to-zero and denormals-are-zero for a scope, and restores the thread's mode after it.
//
// High powers of a cosine run into denormals, which cost a hundred cycles each.
#pragma once

#include <immintrin.h>

namespace steradian {

class FlushDenormals {
 public:
  FlushDenormals() : saved_(_mm_getcsr()) { _mm_setcsr(saved_ | 0x8040); }  // FTZ is bit 15, DAZ bit 6
  ~FlushDenormals() { _mm_setcsr(saved_); }
  FlushDenormals(const FlushDenormals&) = delete;
  FlushDenormals& operator=(const FlushDenormals&) = delete;

 private:
  unsigned saved_;
};

}  // namespace steradian
