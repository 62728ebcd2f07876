// Flat arrays of vectors, which every pass of the indirect light reads and writes.
#pragma once

#include <cstddef>
#include <new>
#include <utility>
#include <vector>

#include "steradian/vector.h"

namespace steradian::indirect {

// Throws std::bad_alloc.
void* take_zeroed(std::size_t bytes);
void give_back(void* p, std::size_t bytes);

// Allocator of zeroed memory. Planes of a picture come in large pages straight from the system. Their first access is in the pass that
// fills them, on the threads that do so.
template <class T>
struct ZeroedPages {
  using value_type = T;

  ZeroedPages() = default;
  template <class U>
  ZeroedPages(const ZeroedPages<U>&) {}
  T* allocate(std::size_t n) { return static_cast<T*>(take_zeroed(n * sizeof(T))); }
  void deallocate(T* p, std::size_t n) { give_back(p, n * sizeof(T)); }
  template <class U>
  void construct(U*) {}  // already zero
  template <class U, class... Arguments>
  void construct(U* p, Arguments&&... arguments) {
    ::new (static_cast<void*>(p)) U(std::forward<Arguments>(arguments)...);
  }
  friend bool operator==(const ZeroedPages&, const ZeroedPages&) { return true; }
};
using FloatArray = std::vector<float, ZeroedPages<float>>;

struct VectorArray {
  FloatArray x, y, z;

  VectorArray() = default;
  explicit VectorArray(std::size_t size) : x(size), y(size), z(size) {}
  std::size_t size() const { return x.size(); }
  void resize(std::size_t size) {
    x.resize(size);
    y.resize(size);
    z.resize(size);
  }
  Vec3f operator[](std::size_t i) const { return {x[i], y[i], z[i]}; }
  void put(std::size_t i, Vec3f v) {
    x[i] = v.x;
    y[i] = v.y;
    z[i] = v.z;
  }
};

inline float largest(Vec3f v) { return v.x > v.y ? (v.x > v.z ? v.x : v.z) : (v.y > v.z ? v.y : v.z); }

}  // namespace steradian::indirect
