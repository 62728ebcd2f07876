#include "indirect/arrays.h"

#include <sys/mman.h>

#include <cstdlib>

namespace steradian::indirect {
namespace {
constexpr std::size_t kLarge = std::size_t{1} << 20;  // half of a large page: from here on they pay
}

void* take_zeroed(std::size_t bytes) {
  void* p = nullptr;
  if (bytes < kLarge) {
    p = std::calloc(bytes, 1);
  } else {
    p = mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (p == MAP_FAILED) p = nullptr;
    if (p != nullptr) madvise(p, bytes, MADV_HUGEPAGE);
  }
  if (p == nullptr && bytes > 0) throw std::bad_alloc();
  return p;
}

void give_back(void* p, std::size_t bytes) {
  if (bytes < kLarge)
    std::free(p);
  else
    munmap(p, bytes);
}

}  // namespace steradian::indirect
