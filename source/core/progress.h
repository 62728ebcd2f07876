// Progress: a counter that long work advances and that is displayed on a terminal.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <mutex>
#include <string>
#include <string_view>

namespace steradian {

// Destination of progress. The default is standard error, and only if that is a terminal.
struct ProgressOutput {
  bool enabled = false;
  std::function<void(std::string_view)> write;
  std::function<double()> seconds;  // any steady clock
};
ProgressOutput progress_on_terminal();

// Shows nothing in the first second, then at most ten lines a second, each over the last. The line is erased at the end. Any number of
// threads may advance it.
class Progress {
 public:
  // total 0: unknown; the line then counts without a fraction.
  Progress(std::string label, std::uint64_t total, ProgressOutput output = progress_on_terminal());
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void add(std::uint64_t steps = 1);
  std::uint64_t count() const { return count_.load(std::memory_order_relaxed); }

 private:
  void show(double now);

  const std::string label_;
  const std::uint64_t total_;
  const ProgressOutput output_;
  const double start_;
  std::atomic<std::uint64_t> count_{0};
  std::atomic<double> next_;  // time of the next display
  std::mutex mutex_;
  bool shown_ = false;
};

}  // namespace steradian
