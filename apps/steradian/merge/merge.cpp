// steradian merge PARTS -o FILE
#include <memory>

#include "core/budget.h"
#include "exchange/files/matrix_files.h"
#include "merge/merge_maps.h"
#include "merge/merge_pictures.h"
#include "steradian/error.h"
#include "steradian/view_factors.h"
#include "verbs.h"
#include "viewfactor/finish.h"

namespace steradian::app {
namespace {

using namespace exchange;

struct MergeArguments {
  std::vector<std::string> parts;
  std::string output;
  double drop = 0;
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
    }
    if (part.run.version != all.run.version)
      throw Error(path, "was made by another version than " + arguments.parts[0], "compute the parts with one program");
    if (part.run.eps != all.run.eps || part.run.obstruction != all.run.obstruction || part.run.parts != all.run.parts)
      throw Error(path, "has other settings than " + arguments.parts[0], "merge the parts of one run");
    parts.push_back(std::move(part.factors));
  }
  all.factors = merge_view_factors(std::move(parts));
  all.run.part = all.run.parts = 1;
  warn(arguments.output, doubts_about(all));
  drop_small(all, arguments.drop);
  write_factors(arguments.output, all);
  print_summary(all, 0);
}

void merge(const MergeArguments& arguments) {
  if (arguments.parts[0].ends_with(".exr")) {
    if (arguments.drop > 0) throw WrongOption("--drop", "is for view factors; pictures have no entries");
    return arguments.output.ends_with(".exr") || arguments.output.ends_with(".png")
               ? merge_pictures(arguments.parts, arguments.output, arguments.limits)
               : merge_maps(arguments.parts, arguments.output, arguments.limits);
  }
  merge_factors(arguments);
}

}  // namespace

void add_merge(CommandLine& line) {
  auto a = std::make_shared<MergeArguments>();
  Verb verb = line.verb("merge", "Join the parts of a run of viewfactor, bake or render with --part");
  verb.group("View factors");
  verb.add("PARTS", a->parts, "files of all parts (.npz of viewfactor, .exr of bake or render)").required();
  verb.add("-o,--output", a->output, ".npz, .mtx or .vf; .glb or .gltf; .exr or .png").required().writes(Writes::file);
  verb.add("--drop", a->drop, "leave out entries below this times the run's --eps").range(0.0, 1e12);
  verb.add_limits(a->limits);
  verb.callback([a] { merge(*a); });
}

}  // namespace steradian::app
