#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <exception>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

// The parts of oneTBB that the project uses, implemented by std::thread, for the preset tsan alone. Debian's library is built without
// ThreadSanitizer, which then reports every hand-over of work between its threads as a race. A loop starts its threads and joins them. It
// relies only on TBB's guarantee: all before the loop is visible inside, and all inside is visible after it.
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.
namespace tbb {

namespace info {
inline int default_concurrency() { return std::max(2, static_cast<int>(std::thread::hardware_concurrency())); }
}  // namespace info

namespace threads {
inline thread_local int width = 0;  // width of this thread's arena; 0: no arena
inline thread_local bool at_work = false;
}  // namespace threads

class task_arena {
 public:
  static constexpr int automatic = -1;
  explicit task_arena(int width = automatic) : width_(width > 0 ? width : info::default_concurrency()) {}
  int max_concurrency() const { return width_; }

  template <typename Work>
  decltype(auto) execute(const Work& work) const {
    struct Within {
      int before = threads::width;
      ~Within() { threads::width = before; }
    } within;
    threads::width = width_;
    return work();
  }

 private:
  int width_;
};

// Only starting and joining order the threads: the next index is taken without ordering (relaxed). A nested loop runs on its thread.
template <typename Index, typename Work, typename... Partitioner>
void parallel_for(Index begin, Index end, const Work& work, const Partitioner&...) {
  if (begin >= end) return;
  std::atomic<Index> next{begin};
  std::exception_ptr error;
  std::mutex mutex;
  const auto take = [&] {
    const bool before = std::exchange(threads::at_work, true);
    try {
      for (Index i; (i = next.fetch_add(1, std::memory_order_relaxed)) < end;) work(i);
    } catch (...) {
      next.store(end, std::memory_order_relaxed);
      const std::lock_guard lock(mutex);
      if (!error) error = std::current_exception();
    }
    threads::at_work = before;
  };
  const int width = threads::at_work ? 1 : threads::width > 0 ? threads::width : info::default_concurrency();
  const auto count = static_cast<std::size_t>(end - begin);
  std::vector<std::thread> others;
  for (std::size_t i = 1; i < std::min(count, static_cast<std::size_t>(width)); ++i) others.emplace_back(take);
  take();
  for (std::thread& t : others) t.join();
  if (error) std::rethrow_exception(error);
}

struct simple_partitioner {};

template <typename T>
class enumerable_thread_specific {
 public:
  enumerable_thread_specific() : make_([] { return T(); }) {}
  template <typename Make>
  explicit enumerable_thread_specific(Make make) : make_(std::move(make)) {}

  // A thread gets its own element without a lock, because a lock would order the loops' accesses.
  T& local() {
    thread_local std::map<int, T*> own;
    T*& mine = own[number_];
    if (!mine) {
      const std::lock_guard lock(mutex_);
      mine = all_.emplace_back(std::make_unique<T>(make_())).get();
    }
    return *mine;
  }

  struct Iterator {
    typename std::vector<std::unique_ptr<T>>::const_iterator at;
    T& operator*() const { return **at; }
    Iterator& operator++() { return ++at, *this; }
    bool operator!=(const Iterator& other) const { return at != other.at; }
  };
  Iterator begin() const { return {all_.begin()}; }
  Iterator end() const { return {all_.end()}; }

 private:
  static inline std::atomic<int> numbers{0};
  const int number_ = numbers.fetch_add(1, std::memory_order_relaxed);
  std::function<T()> make_;
  std::mutex mutex_;
  std::vector<std::unique_ptr<T>> all_;
};

class global_control {
 public:
  enum parameter { max_allowed_parallelism };
  global_control(parameter, std::size_t) {}
};

}  // namespace tbb
