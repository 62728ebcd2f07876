// Progress: a counter that long work advances and that is displayed on standard error.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>

namespace steradian {

// On a terminal a line is written over the last one. In a pipe or a file every line stays.
enum class ProgressForm { none, over_the_last, lines };

// Destination of progress. Counters that share it take turns: their lines have the same distance in time as those of one.
struct ProgressOutput {
  ProgressForm form = ProgressForm::none;
  std::function<void(std::string_view)> write;
  std::function<double()> seconds;                                                          // any steady clock
  std::shared_ptr<std::atomic<double>> next = std::make_shared<std::atomic<double>>(-1.0);  // time of the next line; negative: none was
};
ProgressOutput progress_on_stderr();

// Takes the fraction of a work that is done, from 0 to 1. Any thread may call it. Null: nobody asks.
using WorkFraction = std::function<void(double)>;

// The fractions of a part of a work, which takes from `first` to `last` of the whole. The shares are estimates of its time.
WorkFraction part_of(const WorkFraction& whole, double first, double last);

// Counts the steps of a work, or of a part of it. Any number of threads may advance it.
class WorkSteps {
 public:
  WorkSteps(WorkFraction report, std::uint64_t total) : report_(std::move(report)), total_(total) {}

  void advance(std::uint64_t steps = 1);

 private:
  const WorkFraction report_;
  const std::uint64_t total_;
  std::atomic<std::uint64_t> done_{0};
};

// Shows nothing in the first second. On a terminal it then shows at most ten lines a second, and wipes the last at the end. Elsewhere it
// shows at most one line a second, and none that tells the same percentage again. Any number of threads may advance it.
class Progress {
 public:
  // total 0: unknown; the line then counts without a fraction, and only on a terminal.
  Progress(std::string label, std::uint64_t total, ProgressOutput output = progress_on_stderr());
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void add(std::uint64_t steps = 1);
  // Raises the count to a fraction of the total. A smaller fraction than before changes nothing.
  void reach(double fraction);
  void wipe();  // before other text on the terminal
  std::uint64_t count() const { return count_.load(std::memory_order_relaxed); }

 private:
  void show_if_due();
  void show(double now);

  const std::string label_;
  const std::uint64_t total_;
  const ProgressOutput output_;
  const double start_;
  std::atomic<std::uint64_t> count_{0};
  std::mutex mutex_;
  std::string shown_;  // the percentage of the last line; empty: the terminal shows none
};

}  // namespace steradian
