// steradian methods: the table of methods
#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "integrals/methods.h"
#include "verbs.h"

namespace steradian::app {
namespace {

constexpr const char* kLine = "{:<20}  {:<40}  {:<20}  {}\n";

void print_table() {
  fmt::print(kLine, "method", "error", "time", "lobes");
  for (const methods::Row& row : methods::all()) fmt::print(kLine, row.name, row.error, row.time, row.lobes);
  fmt::print(
      "\nauto takes the first method that serves the lobe; with --quality draft it takes ltc-compact for ggx.\n"
      "Errors: of the full lobe, or in % of the reflected light; points: under lights without extent, of the lobe's rms.\n"
      "docs/measured/accuracy.md has the measurements.\n"
      "Plane scenes (.svg) have the methods {}.\n",
      words::choices<PlaneMethod>(", "));
}

void print_json() {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const methods::Row& row : methods::all())
    list.push_back({{"name", row.name}, {"lobes", row.lobes}, {"qualities", row.qualities}, {"error", row.error}, {"time", row.time}});
  fmt::print("{}\n", list.dump(1));
}

}  // namespace

void add_methods(CommandLine& line) {
  Verb verb = line.verb("methods", "List the methods: lobes, error, time");
  verb.group("Light");
  const auto json = std::make_shared<bool>(false);
  verb.add_flag("--json", *json, "print JSON");
  verb.callback([json] { *json ? print_json() : print_table(); });
}

}  // namespace steradian::app
