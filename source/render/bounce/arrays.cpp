#include "render/bounce/arrays.h"

#include <sys/mman.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <map>
#include <mutex>

namespace steradian::indirect {
namespace {

constexpr std::size_t kPage = std::size_t{1} << 21;
constexpr std::size_t kLarge = kPage / 2;  // large pages pay from this size on
constexpr std::size_t kKept = std::size_t{768} << 20;

// Returned memory, by size. Clearing memory at hand costs less per frame than letting the system map and clear pages. A picture of
// 1920 x 1080 uses planes of some 600 MB; half of them reuse the memory of others that have done their work.
class Pool {
 public:
  void* take(std::size_t bytes) {
    const std::lock_guard lock(mutex_);
    const auto found = free_.find(bytes);
    if (found == free_.end()) return nullptr;
    void* p = found->second;
    free_.erase(found);
    kept_ -= bytes;
    return p;
  }
  // Returns false if enough memory is cached.
  bool give(void* p, std::size_t bytes) {
    const std::lock_guard lock(mutex_);
    if (kept_ + bytes > kKept) return false;
    free_.emplace(bytes, p);
    kept_ += bytes;
    return true;
  }

 private:
  std::mutex mutex_;
  std::multimap<std::size_t, void*> free_;
  std::size_t kept_ = 0;
};

Pool& pool() {
  static Pool* const p = new Pool;  // arrays may outlive static objects
  return *p;
}

std::size_t in_pages(std::size_t bytes) { return (bytes + kPage - 1) / kPage * kPage; }

void clear(void* p, std::size_t bytes) {
  constexpr std::size_t kPart = std::size_t{1} << 20;
  tbb::parallel_for(std::size_t{0}, (bytes + kPart - 1) / kPart,
                    [=](std::size_t i) { std::memset(static_cast<char*>(p) + i * kPart, 0, std::min(kPart, bytes - i * kPart)); });
}

}  // namespace

void* take_zeroed(std::size_t bytes) {
  void* p = nullptr;
  if (bytes < kLarge) {
    p = std::calloc(bytes, 1);
  } else if ((p = pool().take(in_pages(bytes))) != nullptr) {
    clear(p, bytes);
  } else {
    p = mmap(nullptr, in_pages(bytes), PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (p == MAP_FAILED) p = nullptr;
    if (p != nullptr) madvise(p, in_pages(bytes), MADV_HUGEPAGE);
  }
  if (p == nullptr && bytes > 0) throw std::bad_alloc();
  return p;
}

void give_back(void* p, std::size_t bytes) {
  if (bytes < kLarge)
    std::free(p);
  else if (!pool().give(p, in_pages(bytes)))
    munmap(p, in_pages(bytes));
}

}  // namespace steradian::indirect
