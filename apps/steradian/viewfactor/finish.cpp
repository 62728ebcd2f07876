#include "viewfactor/finish.h"

#include <fmt/format.h>

#include <algorithm>

#include "steradian/view_factors.h"
#include "verb.h"
#include "viewfactor/in_file.h"
#include "viewfactor/report.h"

namespace steradian::app {

using namespace exchange;

namespace {

// Errors of rows above this and above ten times --eps come from parts of faces that could not be decided.
constexpr double kDoubtfulError = 0.01;

// Sentences about rows that a user should look at, with the name of the worst one.
std::vector<std::string> doubts_about(const StoredRun& stored) {
  const ViewFactors& f = stored.factors;
  std::vector<std::string> doubts;
  // The number of rows whose number is positive, and the row with the largest one.
  const auto doubt = [&](auto number_of, const char* problem, const char* hint) {
    std::size_t count = 0, worst = 0;
    for (std::size_t i = 0; i < f.size(); ++i) {
      if (!(number_of(i) > 0)) continue;
      ++count;
      if (count == 1 || number_of(i) > number_of(worst)) worst = i;
    }
    if (count > 0)
      doubts.push_back(fmt::format("{} rows {}, most of all {}: {:.6g} with an error of {:.2g} ({})", count, problem, f.names[worst],
                                   f.row_sums[worst], f.row_errors[worst], hint));
  };
  doubt([&](std::size_t i) { return f.row_sums[i] - 1 - f.row_errors[i] - kRowRounding; }, "add up to more than 1",
        stored.run.obstruction ? "these faces overlap or cross others: repair the scene"
                               : "faces hide each other: leave out --no-obstruction");
  doubt([&](std::size_t i) { return f.row_errors[i] - std::max(kDoubtfulError, 10 * stored.run.eps); }, "have a large error",
        "faces that cross or nearly coincide: repair the scene");
  return doubts;
}

}  // namespace

double smallest_kept(double drop, double eps) {
  if (!(drop * eps < 1)) throw WrongOption("--drop", "times --eps must be below 1");
  return drop * eps;
}

void warn(const std::string& path, const std::vector<std::string>& warnings) {
  for (const std::string& w : warnings) fmt::print(stderr, "warning: {}: {}\n", path, w);
}

std::vector<std::string> finish_factors(const std::string& path, StoredRun& stored, const FinishOptions& options) {
  const std::vector<std::string> doubts = doubts_about(stored);
  warn(path, doubts);
  if (options.close) stored.factors = in_file(path, [&] { return closed_view_factors(stored.factors); });
  if (const Grouping grouping = std::move(stored.grouping); !grouping.groups.empty()) {
    stored.grouping = {};
    stored.run.groups = grouping.groups;
    stored.factors = grouped_view_factors(stored.factors, grouping.groups, grouping.names);
    if (!grouping.masks.empty()) stored.factors = with_masks(stored.factors, grouping.masks);
  }
  if (options.drop > 0) {
    stored.run.smallest = smallest_kept(options.drop, stored.run.eps);
    stored.factors = without_small_factors(stored.factors, stored.run.smallest);
  }
  return doubts;
}

void print_summary(const StoredRun& stored, double seconds) {
  const GuaranteeCounts g = guarantees_of(stored);
  fmt::print("faces            {}\n", stored.faces.size());
  if (!stored.run.groups.empty()) fmt::print("groups           {}\n", stored.factors.size());
  fmt::print("entries          {}\n", stored.factors.entries());
  fmt::print("row sums         {:.9g} to {:.9g}\n", g.smallest_sum, g.largest_sum);
  fmt::print("worst row error  {:.3g}\n", g.worst_error);
  fmt::print("guarantees       {}\n", g.outside + g.overfull == 0 ? "hold" : "broken: see --report");
  fmt::print("time             {:.2f} s\n", seconds);
}

}  // namespace steradian::app
