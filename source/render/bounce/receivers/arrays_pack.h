// Arrays of vectors, read and written a pack at a time.
#pragma once

#include "core/pack.h"
#include "render/bounce/arrays.h"

STERADIAN_BEGIN_ISA

STERADIAN_INLINE PackVec3 load_at(const indirect::VectorArray& a, std::size_t i) {
  return {load(a.x.data() + i), load(a.y.data() + i), load(a.z.data() + i)};
}
STERADIAN_INLINE void store_at(indirect::VectorArray& a, std::size_t i, const PackVec3& v) {
  store(a.x.data() + i, v.x);
  store(a.y.data() + i, v.y);
  store(a.z.data() + i, v.z);
}

STERADIAN_END_ISA
