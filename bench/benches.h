// Every bench of `steradian bench`: one file a topic, one line here.
#pragma once

#include "bench/run.h"

namespace steradian::bench {

void add_lambert(BenchList& list);
void add_ltc(BenchList& list);
void add_eval(BenchList& list);
void add_derivatives(BenchList& list);
void add_phong(BenchList& list);
void add_ggx(BenchList& list);
void add_plane(BenchList& list);
void add_frame(BenchList& list);
void add_scaling(BenchList& list);
void add_indirect(BenchList& list);
void add_shadow(BenchList& list);

inline BenchList all_benches() {
  BenchList list;
  add_lambert(list);
  add_ltc(list);
  add_eval(list);
  add_derivatives(list);
  add_phong(list);
  add_ggx(list);
  add_plane(list);
  add_frame(list);
  add_scaling(list);
  add_indirect(list);
  add_shadow(list);
  return list;
}

}  // namespace steradian::bench
