// The program's verbs, one file each. add_x describes the verb's options to the command line, with the function that runs it.
#pragma once

#include "verb.h"

namespace steradian::app {

void add_eval(CommandLine& line);
void add_bench(CommandLine& line);
void add_diff(CommandLine& line);
void add_render(CommandLine& line);
void add_bake(CommandLine& line);
void add_compare(CommandLine& line);
void add_fit(CommandLine& line);
void add_solve(CommandLine& line);
void add_methods(CommandLine& line);
void add_info(CommandLine& line);
void add_viewfactor(CommandLine& line);
void add_merge(CommandLine& line);
void add_view(CommandLine& line);
void add_completion(CommandLine& line);
void add_man(CommandLine& line);

}  // namespace steradian::app
