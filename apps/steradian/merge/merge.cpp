// steradian merge PARTS -o FILE
#include <memory>

#include "core/budget.h"
#include "exchange/files/matrix_files.h"
#include "merge/merge_fits.h"
#include "merge/merge_maps.h"
#include "merge/merge_pictures.h"
#include "steradian/error.h"
#include "steradian/view_factors.h"
#include "verbs.h"
#include "viewfactor/finish.h"
#include "viewfactor/report.h"

namespace steradian::app {
namespace {

using namespace exchange;

struct MergeArguments {
  std::vector<std::string> parts;
  std::string output, report;
  double drop = 0;
  bool close = false;
  Limits limits;
};

void merge_factors(const MergeArguments& arguments) {
  check_factors_name(arguments.output);
  Budget budget(arguments.limits);
  StoredRun all;
  std::vector<ViewFactors> parts;
  for (const std::string& path : arguments.parts) {
    StoredRun part = read_factors_npz(path, budget);
    if (parts.empty()) {
      all.run = part.run;
      all.faces = part.faces;
      all.obstacles = part.obstacles;
      all.grouping = part.grouping;
    }
    if (part.run.version != all.run.version)
      throw Error(path, "was made by another version than " + arguments.parts[0], "compute the parts with one program");
    if (part.run.eps != all.run.eps || part.run.obstruction != all.run.obstruction || part.run.parts != all.run.parts ||
        part.grouping.groups != all.grouping.groups || part.grouping.names != all.grouping.names)
      throw Error(path, "has other settings than " + arguments.parts[0], "merge the parts of one run");
    parts.push_back(std::move(part.factors));
  }
  all.factors = merge_view_factors(std::move(parts));
  all.run.part = all.run.parts = 1;
  const std::vector<std::string> doubts = finish_factors(arguments.output, all, {arguments.close, arguments.drop});
  write_factors(arguments.output, all);
  if (!arguments.report.empty()) write_report(arguments.report, arguments.output, all, doubts, 0);
  print_summary(all, 0);
}

void merge(const Verb& verb, const MergeArguments& arguments) {
  const std::string& first = arguments.parts[0];
  if (first.ends_with(".exr") || first.ends_with(".json")) verb.refuse({"--drop", "--close", "--report"}, "parts of viewfactor");
  if (first.ends_with(".json")) return merge_fits(arguments.parts, arguments.output, arguments.limits);
  if (first.ends_with(".exr")) {
    return arguments.output.ends_with(".exr") || arguments.output.ends_with(".png")
               ? merge_pictures(arguments.parts, arguments.output, arguments.limits)
               : merge_maps(arguments.parts, arguments.output, arguments.limits);
  }
  merge_factors(arguments);
}

}  // namespace

void add_merge(CommandLine& line) {
  auto a = std::make_shared<MergeArguments>();
  Verb verb = line.verb("merge", "Join the parts of a run of viewfactor, bake, render or fit with --part");
  verb.group("View factors");
  verb.add("PARTS", a->parts, "all parts: .npz of viewfactor, .exr of bake or render, .json of fit").required();
  verb.add("-o,--output", a->output, "view factors; .glb or .gltf; .exr or .png; a table").required().writes(Writes::file);
  verb.add("--drop", a->drop, "leave out entries below this times the run's --eps").range(0.0, 1e12);
  verb.add_flag("--close", a->close, "correct a closed enclosure: rows add up to 1");
  verb.add("--report", a->report, "report of rows, errors and guarantees (.json), or a page (.html)").writes(Writes::file);
  verb.add_limits(a->limits);
  verb.callback([a, verb] { merge(verb, *a); });
}

}  // namespace steradian::app
