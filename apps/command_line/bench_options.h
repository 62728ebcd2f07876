// The options of steradian-bench. The program `steradian` has them too, for its verb `bench`.
#pragma once

#include <string>

#include "steradian/render.h"
#include "verb.h"

namespace steradian::app {

struct BenchArguments {
  std::string filter, simd, device;
  Backend backend = Backend::cpu;
  double min_time = 0.5;
  bool json = false, list = false, pipelines = false;
  bool table2 = false, textured = false, plane = false, cie171 = false;
  std::string figures, base;
  double slower = 0;
};

void add_bench_options(Verb& verb, BenchArguments& arguments);

}  // namespace steradian::app
