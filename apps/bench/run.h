// Benches: a body runs repeatedly on one core, and the median of the runs counts.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "core/simd.h"

namespace steradian {

struct BenchOptions {
  double min_time = 0.5;  // seconds of runs per bench
  int min_runs = 9;
  Simd simd = active_simd();  // for benches that follow the active set
};

// A part of a call.
struct BenchPass {
  std::string name;
  double ms = 0;
};

// A measurable workload. The closure holds the prepared data; a call does the work on all items once.
struct Bench {
  std::string name;   // "kernel/lambert/quad"
  std::size_t items;  // items per call
  std::string simd;   // the instruction set that runs, "scalar", or empty if none is chosen
  std::function<void()> body;
  bool one_core = true;                                 // pinned to one core; false for frames on all threads
  std::function<std::vector<BenchPass>()> passes = {};  // medians of the calls so far; none: a call has no parts
  bool once = false;                                    // takes seconds: one call without warm-up or repetition
};

// The benches that `steradian bench` can run. A bench's data is prepared only when its name is chosen.
class BenchList {
 public:
  using Make = std::function<Bench(const BenchOptions&)>;
  void add(std::string name, Make make) { entries_.push_back({std::move(name), std::move(make)}); }

  struct Entry {
    std::string name;
    Make make;
  };
  const std::vector<Entry>& entries() const { return entries_; }

 private:
  std::vector<Entry> entries_;
};

struct BenchResult {
  std::string name;
  std::size_t items = 0;
  double ns_per_item = 0;  // median
  double median_ms = 0;    // median time of one call
  double fastest_ms = 0;
  int runs = 0;
  std::string simd;
  std::vector<BenchPass> passes;
};

// Warms up, pins the thread to its current core, and runs for at least min_time and min_runs. Unpins the thread afterwards.
BenchResult run_bench(const Bench& bench, const BenchOptions& options);

// Prevents the compiler from removing work whose result is not read.
template <class T>
void keep(const T& value) {
  asm volatile("" : : "g"(&value) : "memory");
}

}  // namespace steradian
