// steradian-bench: measures the times of the integrals on this machine. `steradian bench` starts it.
#include "bench/run.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>

#include "bench/benches.h"
#include "bench/phong_on_device.h"
#include "bench/studies/cie171.h"
#include "bench/studies/plane_methods.h"
#include "bench/studies/table2.h"
#include "bench_options.h"
#include "core/files.h"
#include "core/progress.h"
#include "fit/textured_error.h"
#include "pipeline_facts.h"
#include "steradian/error.h"
#include "steradian/version.h"
#include "verb.h"
#include "wrong_use.h"

namespace steradian::app {
namespace {

using namespace fit;

using Options = BenchArguments;

// Repeats the published comparison of Phong area lights.
void print_table2(const Options& options) {
  moment::Table2Options table;
  table.min_time = options.min_time < 0.5 ? options.min_time : 0.05;
  fmt::print("{}", moment::table2_text(moment::measure_table2(table), table));
  if (options.figures.empty()) return;
  for (const std::string& file : moment::write_table2_figures(options.figures, table.simd)) fmt::print(stderr, "wrote {}\n", file);
}

BenchList benches_of(const Options& options) { return bench::all_benches({options.backend, options.device}); }

std::vector<const BenchList::Entry*> chosen_of(const BenchList& list, const Options& options) {
  std::vector<const BenchList::Entry*> chosen;
  for (const auto& entry : list.entries())
    if (options.filter.ends_with('$') ? entry.name + "$" == options.filter : entry.name.starts_with(options.filter))
      chosen.push_back(&entry);
  if (!chosen.empty()) return chosen;
  constexpr std::size_t kMost = 12;
  std::vector<std::string> names;
  for (const auto& entry : list.entries()) names.push_back(entry.name);
  const std::size_t all = names.size();
  const bool whole = options.filter.ends_with('$');
  std::string hint = "the nearest are";
  const auto nearest = nearest_beginnings(options.filter.substr(0, options.filter.size() - (whole ? 1 : 0)), std::move(names), kMost);
  for (const std::string& name : nearest) hint += "\n  " + name;
  hint += fmt::format("\nand {} more: steradian bench --list{}", all - nearest.size(),
                      options.backend == Backend::vulkan ? " --backend vulkan" : "; those of devices: --backend vulkan");
  throw Error("--filter", whole ? "no bench has the name " + options.filter : "no bench begins with " + options.filter, hint);
}

// True for "kernel/x/scalar" as `scalar`, and kernel/x or kernel/x/sse2.
bool is_scalar_form(const std::string& scalar, const std::string& name) {
  constexpr std::string_view kScalar = "/scalar";
  if (!scalar.ends_with(kScalar) || scalar == name) return false;
  const std::string base = scalar.substr(0, scalar.size() - kScalar.size());
  return name == base || name.starts_with(base + "/");
}

// The benches in the order in which they run: a scalar form comes before those that are compared with it.
std::vector<const BenchList::Entry*> scalar_first(const std::vector<const BenchList::Entry*>& chosen) {
  std::vector<const BenchList::Entry*> order;
  const auto add = [&](const BenchList::Entry* entry) {
    if (std::find(order.begin(), order.end(), entry) == order.end()) order.push_back(entry);
  };
  for (const auto* entry : chosen) {
    for (const auto* other : chosen)
      if (is_scalar_form(other->name, entry->name)) add(other);
    add(entry);
  }
  return order;
}

// measured: is called after each bench with the results so far.
std::vector<BenchResult> run(const Options& options, const std::function<void(const std::vector<BenchResult>&)>& measured) {
  BenchOptions bench_options;
  bench_options.min_time = options.min_time;
  const BenchList list = benches_of(options);
  const std::vector<const BenchList::Entry*> order = scalar_first(chosen_of(list, options));
  std::vector<BenchResult> results;
  Progress progress("bench", order.size());
  for (const auto* entry : order) {
    results.push_back(run_bench(entry->make(bench_options), bench_options));
    progress.wipe();
    measured(results);
    std::fflush(stdout);
    progress.add();
  }
  return results;
}

// The speed-up over the scalar form of the same bench, if that ran before: "8.3 x scalar".
std::string against_scalar(const std::vector<BenchResult>& results, const BenchResult& r) {
  for (const BenchResult& other : results)
    if (is_scalar_form(other.name, r.name)) return fmt::format("{:.1f} x scalar", other.ns_per_item / r.ns_per_item);
  return {};
}

void print_head() { fmt::print("{:<40} {:>10} {:>12} {:>10} {:>6}  {:<8}\n", "bench", "items", "ns/item", "median ms", "runs", "simd"); }

// Prints the last result.
void print_row(const std::vector<BenchResult>& results) {
  const BenchResult& r = results.back();
  fmt::print("{:<40} {:>10} {:>12.2f} {:>10.4f} {:>6}  {:<8} {}\n", r.name, r.items, r.ns_per_item, r.median_ms, r.runs, r.simd,
             against_scalar(results, r));
  for (const BenchPass& pass : r.passes) fmt::print("  {:<61} {:>13.4f}\n", pass.name, pass.ms);
}

// Reads an earlier output of `bench --json`: the median of a call by name.
std::map<std::string, double> read_base(const std::string& path) {
  Budget budget{Limits{}};
  const Bytes bytes = read_file(path, path, budget);
  const nlohmann::json all = nlohmann::json::parse(bytes.begin(), bytes.end(), nullptr, false);
  std::map<std::string, double> base;
  if (all.is_array())
    for (const nlohmann::json& one : all)
      if (one.is_object() && one.contains("name") && one["name"].is_string() && one.contains("ns_per_item") &&
          one["ns_per_item"].is_number())
        base[one["name"]] = one["ns_per_item"];
  if (base.empty()) throw Error(path, "holds no benches", "write it by `steradian bench --json > FILE`");
  return base;
}

// The results beside an earlier run, name by name, with the geometric mean of the ratios last.
class RatioTable {
 public:
  RatioTable(std::map<std::string, double> base, double limit) : base_(std::move(base)), limit_(limit) {}

  void print_head() const { fmt::print("{:<40} {:>12} {:>12} {:>8}\n", "bench", "ns/item", "before", "ratio"); }

  void print_row(const BenchResult& r) {
    const auto before = base_.find(r.name);
    if (before == base_.end()) {
      fmt::print("{:<40} {:>12.2f} {:>12} {:>8}\n", r.name, r.ns_per_item, "-", "new");
      return;
    }
    const double ratio = r.ns_per_item / before->second;
    const bool slower = limit_ > 0 && ratio > limit_;
    fmt::print("{:<40} {:>12.2f} {:>12.2f} {:>8.3f}{}\n", r.name, r.ns_per_item, before->second, ratio, slower ? "  slower" : "");
    logs_ += std::log(ratio);
    ++count_;
    holds_ &= !slower;
  }

  // False if a ratio is above the limit.
  bool end() const {
    if (count_ > 0) fmt::print("{:<40} {:>12} {:>12} {:>8.3f}\n", "geometric mean", "", "", std::exp(logs_ / count_));
    return holds_;
  }

 private:
  std::map<std::string, double> base_;
  double limit_;
  double logs_ = 0;
  int count_ = 0;
  bool holds_ = true;
};

void print_json(const std::vector<BenchResult>& results) {
  nlohmann::ordered_json all = nlohmann::ordered_json::array();
  for (const BenchResult& r : results) {
    nlohmann::ordered_json one = {{"name", r.name},           {"items", r.items}, {"ns_per_item", r.ns_per_item},
                                  {"median_ms", r.median_ms}, {"runs", r.runs},   {"fastest_ms", r.fastest_ms}};
    if (!r.simd.empty()) one["simd"] = r.simd;
    for (const BenchPass& pass : r.passes) one["passes"][pass.name] = pass.ms;
    all.push_back(std::move(one));
  }
  fmt::print("{}\n", all.dump(1));
}

void add_bench(CommandLine& line) {
  Verb verb = line.all();
  auto options = std::make_shared<Options>();
  add_bench_options(verb, *options);
  verb.callback([options, &exit = line.exit()] {
    if (!options->simd.empty()) setenv("STERADIAN_SIMD", options->simd.c_str(), 1);
    if (options->table2) return print_table2(*options);
    if (options->plane) return fmt::print("{}", plane::plane_methods_text(plane::measure_plane_methods({})));
    if (options->cie171) return fmt::print("{}", cie171::cie171_page(cie171::compare_with_cie171()));
    if (options->textured) return fmt::print("{}", textured_error_text(measure_textured_error({})));
    if (options->pipelines) {
      const nlohmann::ordered_json facts = facts_of(bench::compile_phong(options->device));
      return fmt::print("{}", options->json ? facts.dump(1) + "\n" : pipeline_text(facts));
    }
    if (options->list) {
      const BenchList list = benches_of(*options);
      for (const BenchList::Entry* entry : chosen_of(list, *options)) fmt::print("{}\n", entry->name);
      return;
    }
    if (!options->base.empty()) {
      RatioTable table(read_base(options->base), options->slower);
      table.print_head();
      run(*options, [&](const std::vector<BenchResult>& results) { table.print_row(results.back()); });
      if (!table.end()) exit.code = 1;
      return;
    }
    if (options->json) return print_json(run(*options, [](const std::vector<BenchResult>&) {}));
    print_head();
    run(*options, print_row);
  });
}

}  // namespace
}  // namespace steradian::app

int main(int argc, char** argv) {
  steradian::app::CommandLine line("Times of the integrals on this machine, and the literature's tables.",
                                   std::string("steradian-bench ") + steradian::version());
  steradian::app::add_bench(line);
  return line.run(argc, argv);
}
