// steradian info: version and what this machine offers.
#include <fmt/format.h>

#include <thread>

#include "core/simd.h"
#include "steradian/version.h"
#include "verbs.h"

namespace steradian::app {

void add_info(CLI::App& app, Exit&) {
  CLI::App* verb = app.add_subcommand("info", "Print version, instruction sets and devices");
  verb->callback([] {
    fmt::print("version           {}\n", version());
    fmt::print("instruction sets ");
    for (Simd simd : available_simd()) fmt::print(" {}", name_of(simd));
    fmt::print("\nin use            {} ({} lanes)\n", name_of(active_simd()), lanes_of(active_simd()));
    fmt::print("threads           {}\n", std::thread::hardware_concurrency());
  });
}

}  // namespace steradian::app
