#include "bench/run.h"

#include <sched.h>
#include <tbb/info.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <mutex>
#include <thread>

namespace steradian {
namespace {

double seconds() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

// Pins this thread to its core until the end of the scope.
class PinnedToOneCore {
 public:
  PinnedToOneCore() {
    CPU_ZERO(&before_);
    pinned_ = sched_getaffinity(0, sizeof before_, &before_) == 0;
    cpu_set_t one;
    CPU_ZERO(&one);
    const int core = sched_getcpu();
    if (core < 0) return;
    CPU_SET(static_cast<std::size_t>(core), &one);
    sched_setaffinity(0, sizeof one, &one);
  }
  ~PinnedToOneCore() {
    if (pinned_) sched_setaffinity(0, sizeof before_, &before_);
  }
  PinnedToOneCore(const PinnedToOneCore&) = delete;
  PinnedToOneCore& operator=(const PinnedToOneCore&) = delete;

 private:
  cpu_set_t before_;
  bool pinned_ = false;
};

// A run is so long that the clock's resolution does not matter: 1 ms is 20,000 times its step.
constexpr double kShortestRun = 1e-3;
constexpr double kWarmUp = 0.05;

BenchResult measure(const Bench& bench, const BenchOptions& options) {
  std::size_t calls = 0;
  const double warm_up_begin = seconds();
  double warm_up = bench.once ? kShortestRun : 0;
  while (!bench.once) {
    bench.body();
    ++calls;
    warm_up = seconds() - warm_up_begin;
    if (!(warm_up < std::min(kWarmUp, options.min_time))) break;
  }
  const double one_call = bench.once ? kShortestRun : warm_up / static_cast<double>(calls);
  const std::size_t calls_per_run = std::max<std::size_t>(1, static_cast<std::size_t>(kShortestRun / one_call));

  std::vector<double> times;
  double total = 0;
  while (times.empty() || (!bench.once && (total < options.min_time || static_cast<int>(times.size()) < options.min_runs))) {
    const double begin = seconds();
    for (std::size_t i = 0; i < calls_per_run; ++i) bench.body();
    const double time = seconds() - begin;
    total += time;
    times.push_back(time / static_cast<double>(calls_per_run));
  }
  std::sort(times.begin(), times.end());
  const std::size_t middle = times.size() / 2;
  const double median = times.size() % 2 == 1 ? times[middle] : 0.5 * (times[middle - 1] + times[middle]);
  BenchResult result;
  result.name = bench.name;
  result.items = bench.items;
  result.ns_per_item = 1e9 * median / static_cast<double>(bench.items);
  result.median_ms = 1e3 * median;
  result.fastest_ms = 1e3 * times.front();
  result.runs = static_cast<int>(times.size());
  result.simd = bench.simd;
  if (bench.passes) result.passes = bench.passes();
  return result;
}

// The library's worker threads permanently inherit the cores on which their starter may run. So they start before any thread is pinned.
void start_workers() {
  const int workers = tbb::info::default_concurrency();
  std::atomic<int> arrived{0};
  const double begin = seconds();
  tbb::parallel_for(
      0, workers,
      [&](int) {
        ++arrived;
        while (arrived < workers && seconds() - begin < 0.1) std::this_thread::yield();
      },
      tbb::simple_partitioner());
}

}  // namespace

BenchResult run_bench(const Bench& bench, const BenchOptions& options) {
  static std::once_flag once;
  std::call_once(once, start_workers);
  if (!bench.one_core) return measure(bench, options);
  const PinnedToOneCore pinned;
  return measure(bench, options);
}

}  // namespace steradian
