#include "bench/run.h"

#include <gtest/gtest.h>
#include <sched.h>
#include <tbb/info.h>
#include <tbb/parallel_for.h>

#include <atomic>
#include <chrono>
#include <thread>

namespace steradian::run_test {

TEST(Bench, MeasuresASleepAndPinsAndUnpinsTheThread) {
  cpu_set_t before, during, after;
  sched_getaffinity(0, sizeof before, &before);
  Bench bench{"sleep", 10, "", [&] {
                sched_getaffinity(0, sizeof during, &during);
                std::this_thread::sleep_for(std::chrono::milliseconds(2));
              }};
  BenchOptions options;
  options.min_time = 0.01;
  const BenchResult r = run_bench(bench, options);
  sched_getaffinity(0, sizeof after, &after);
  EXPECT_EQ(CPU_COUNT(&during), 1);
  EXPECT_TRUE(CPU_EQUAL(&before, &after));
  EXPECT_GE(r.runs, options.min_runs);
  EXPECT_GE(r.median_ms, 2.0);  // a sleep is never shorter than requested
  EXPECT_LE(r.fastest_ms, r.median_ms);
  EXPECT_DOUBLE_EQ(r.ns_per_item, 1e6 * r.median_ms / 10);
}

// A pinned bench may be the first to use all cores. It must not leave the workers on one core.
TEST(Bench, LeavesTheWorkersTheirCores) {
  const auto narrowest = [] {
    std::atomic<int> least{1 << 30};
    tbb::parallel_for(0, 256, [&](int) {
      cpu_set_t mine;
      CPU_ZERO(&mine);
      sched_getaffinity(0, sizeof mine, &mine);
      for (int now = least, count = CPU_COUNT(&mine); count < now && !least.compare_exchange_weak(now, count);) {
      }
      std::this_thread::sleep_for(std::chrono::microseconds(100));
    });
    return least.load();
  };
  Bench bench;
  bench.one_core = true;
  bench.items = 1;
  bench.body = [&] { narrowest(); };
  run_bench(bench, {.min_time = 0.01});
  EXPECT_EQ(narrowest(), tbb::info::default_concurrency());
}

}  // namespace steradian::run_test
