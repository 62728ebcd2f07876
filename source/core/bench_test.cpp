#include "core/bench.h"

#include <gtest/gtest.h>
#include <sched.h>

#include <chrono>
#include <thread>

namespace steradian {

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
  EXPECT_GE(r.median_ms, 2.0);  // a sleep is never shorter than asked
  EXPECT_LE(r.fastest_ms, r.median_ms);
  EXPECT_DOUBLE_EQ(r.ns_per_item, 1e6 * r.median_ms / 10);
}

}  // namespace steradian
