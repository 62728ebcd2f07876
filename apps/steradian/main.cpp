// steradian VERB [--option VALUE] INPUT -o OUTPUT
#include <vector>

#include "ranks/command_process.h"
#include "ranks/ranks.h"
#include "steradian/version.h"
#include "verbs.h"

int main(int argc, char** argv) {
  if (!steradian::app::follow_parent() && steradian::app::is_rank())
    return steradian::app::run_with_ranks(argc, argv, std::vector<std::string>(argv + 1, argv + argc));
  steradian::app::CommandLine line("Light computed without sampling: area light integrals in closed form.",
                                   std::string("steradian ") + steradian::version());
  steradian::app::add_render(line);
  steradian::app::add_bake(line);
  steradian::app::add_view(line);
  steradian::app::add_compare(line);
  steradian::app::add_diff(line);
  steradian::app::add_eval(line);
  steradian::app::add_methods(line);
  steradian::app::add_solve(line);
  steradian::app::add_fit(line);
  steradian::app::add_viewfactor(line);
  steradian::app::add_merge(line);
  steradian::app::add_info(line);
  steradian::app::add_bench(line);
  steradian::app::add_completion(line);
  steradian::app::add_man(line);
  return line.run(argc, argv);
}
