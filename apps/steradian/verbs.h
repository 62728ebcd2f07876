// The program's verbs, one file each. add_x describes the verb's options to the command line and says what to run.
#pragma once

#include <CLI/CLI.hpp>

#include "steradian/limits.h"

namespace steradian::app {

// What main returns: 0 done, 1 the work failed or a comparison did not hold, 2 wrong use.
struct Exit {
  int code = 0;
};

// --max-memory and --max-work: what a file may take.
void add_limits(CLI::App& verb, Limits& limits);

void add_eval(CLI::App& app, Exit& exit);
void add_bench(CLI::App& app, Exit& exit);
void add_diff(CLI::App& app, Exit& exit);
void add_render(CLI::App& app, Exit& exit);
void add_compare(CLI::App& app, Exit& exit);
void add_fit(CLI::App& app, Exit& exit);
void add_info(CLI::App& app, Exit& exit);
void add_view(CLI::App& app, Exit& exit);

}  // namespace steradian::app
