#include "core/progress.h"

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>

namespace steradian {
namespace {

constexpr double kQuietSeconds = 1.0;  // shorter work shows nothing
constexpr double kInterval = 0.1;

}  // namespace

ProgressOutput progress_on_terminal() {
  ProgressOutput output;
  output.enabled = isatty(STDERR_FILENO) == 1;
  output.write = [](std::string_view text) {
    std::fwrite(text.data(), 1, text.size(), stderr);
    std::fflush(stderr);
  };
  output.seconds = [] { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); };
  return output;
}

Progress::Progress(std::string label, std::uint64_t total, ProgressOutput output)
    : label_(std::move(label)),
      total_(total),
      output_(std::move(output)),
      start_(output_.enabled ? output_.seconds() : 0.0),
      next_(start_ + kQuietSeconds) {}

Progress::~Progress() {
  if (shown_) output_.write("\r\x1b[K");
}

void Progress::add(std::uint64_t steps) {
  count_.fetch_add(steps, std::memory_order_relaxed);
  if (!output_.enabled) return;
  const double now = output_.seconds();
  if (now < next_.load(std::memory_order_relaxed)) return;
  const std::unique_lock lock(mutex_, std::try_to_lock);
  if (lock.owns_lock() && now >= next_.load(std::memory_order_relaxed)) show(now);
}

void Progress::show(double now) {
  next_.store(now + kInterval, std::memory_order_relaxed);
  shown_ = true;
  const std::uint64_t done = count();
  const double elapsed = now - start_;
  char line[160];
  if (total_ > 0) {
    const double share = std::min(1.0, static_cast<double>(done) / static_cast<double>(total_));
    const double left = share > 0 ? elapsed * (1 - share) / share : 0.0;
    std::snprintf(line, sizeof line, "\r%.80s  %5.1f %%  %.0f s, %.0f s left\x1b[K", label_.c_str(), 100 * share, elapsed, left);
  } else {
    std::snprintf(line, sizeof line, "\r%.80s  %llu  %.0f s\x1b[K", label_.c_str(), static_cast<unsigned long long>(done), elapsed);
  }
  output_.write(line);
}

}  // namespace steradian
