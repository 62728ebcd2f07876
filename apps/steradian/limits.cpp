// The options that raise what a file may take.
#include "verbs.h"

namespace steradian::app {

void add_limits(CLI::App& verb, Limits& limits) {
  verb.add_option("--max-memory", limits.memory, "bytes that a file's contents may take: 4GB, 500MB")
      ->transform(CLI::AsSizeValue(true))
      ->group("Limits");
  verb.add_option("--max-work", limits.work, "steps of about a nanosecond that preparing a file may take")
      ->check(CLI::Range(std::uint64_t{1}, std::uint64_t{1} << 62))
      ->group("Limits");
}

}  // namespace steradian::app
