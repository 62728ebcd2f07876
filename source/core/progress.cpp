#include "core/progress.h"

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>

namespace steradian {
namespace {

constexpr double kQuietSeconds = 1.0;  // shorter work shows nothing
constexpr double kTerminalInterval = 0.1, kLinesInterval = 1.0;

}  // namespace

ProgressOutput progress_on_stderr() {
  ProgressOutput output;
  output.form = isatty(STDERR_FILENO) == 1 ? ProgressForm::over_the_last : ProgressForm::lines;
  // A program that runs others shows its own progress.
  if (const char* wish = std::getenv("STERADIAN_PROGRESS"); wish != nullptr && std::string_view(wish) == "none")
    output.form = ProgressForm::none;
  output.write = [](std::string_view text) {
    std::fwrite(text.data(), 1, text.size(), stderr);
    std::fflush(stderr);
  };
  output.seconds = [] { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); };
  return output;
}

WorkFraction part_of(const WorkFraction& whole, double first, double last) {
  if (!whole) return {};
  return [whole, first, last](double fraction) { whole(first + (last - first) * fraction); };
}

void WorkSteps::advance(std::uint64_t steps) {
  const std::uint64_t done = done_.fetch_add(steps, std::memory_order_relaxed) + steps;
  if (report_ && total_ > 0) report_(std::min(1.0, static_cast<double>(done) / static_cast<double>(total_)));
}

Progress::Progress(std::string label, std::uint64_t total, ProgressOutput output)
    : label_(std::move(label)),
      total_(total),
      output_(total == 0 && output.form == ProgressForm::lines ? ProgressOutput{} : std::move(output)),
      start_(output_.form == ProgressForm::none ? 0.0 : output_.seconds()) {
  double none = -1;
  output_.next->compare_exchange_strong(none, start_ + kQuietSeconds);
}

Progress::~Progress() { wipe(); }

void Progress::wipe() {
  const std::lock_guard lock(mutex_);
  if (output_.form == ProgressForm::over_the_last && !shown_.empty()) output_.write("\r\x1b[K");
  if (output_.form == ProgressForm::over_the_last) shown_.clear();
}

void Progress::add(std::uint64_t steps) {
  count_.fetch_add(steps, std::memory_order_relaxed);
  show_if_due();
}

void Progress::reach(double fraction) {
  const auto wanted = static_cast<std::uint64_t>(std::clamp(fraction, 0.0, 1.0) * static_cast<double>(total_));
  std::uint64_t before = count();
  while (before < wanted && !count_.compare_exchange_weak(before, wanted, std::memory_order_relaxed)) {
  }
  show_if_due();
}

void Progress::show_if_due() {
  if (output_.form == ProgressForm::none) return;
  const double now = output_.seconds();
  if (now < output_.next->load(std::memory_order_relaxed)) return;
  const std::unique_lock lock(mutex_, std::try_to_lock);
  if (lock.owns_lock() && now >= output_.next->load(std::memory_order_relaxed)) show(now);
}

void Progress::show(double now) {
  const std::uint64_t done = count();
  const double elapsed = now - start_;
  char figure[32], times[64];
  if (total_ > 0) {
    const double share = std::min(1.0, static_cast<double>(done) / static_cast<double>(total_));
    const double left = share > 0 ? elapsed * (1 - share) / share : 0.0;
    std::snprintf(figure, sizeof figure, "%5.1f %%", 100 * share);
    std::snprintf(times, sizeof times, "%.0f s, %.0f s left", elapsed, left);
  } else {
    std::snprintf(figure, sizeof figure, "%llu", static_cast<unsigned long long>(done));
    std::snprintf(times, sizeof times, "%.0f s", elapsed);
  }
  const bool lines = output_.form == ProgressForm::lines;
  if (lines && shown_ == figure) return;
  output_.next->store(now + (lines ? kLinesInterval : kTerminalInterval), std::memory_order_relaxed);
  shown_ = figure;
  const std::string line = label_.substr(0, 80) + "  " + figure + "  " + times;
  output_.write(lines ? line + "\n" : "\r" + line + "\x1b[K");
}

}  // namespace steradian
