// oneTBB's task_arena for a machine of one thread.
#pragma once

namespace tbb {

class task_arena {
 public:
  static constexpr int automatic = -1;
  explicit task_arena(int = automatic) {}
  template <class Job>
  auto execute(Job&& job) {
    return job();
  }
  int max_concurrency() const { return 1; }
};

}  // namespace tbb
