#include "ranks/shared_run.h"

#include <algorithm>
#include <optional>

#include "exchange/files/matrix_files.h"
#include "fit/fitted_table.h"
#include "image/picture_name.h"
#include "merge/merge_maps.h"
#include "render/frame_range.h"
#include "steradian/error.h"

namespace steradian::app {
namespace {

// A verb with --part.
struct SharedVerb {
  std::string name, ending;
  int most_parts;
  bool resumes;                       // its parts keep what they have finished, with --resume
  std::vector<std::string> merged;    // options with a value that steradian merge takes instead
  std::vector<std::string> switches;  // the same without a value
  std::vector<std::string> refused;   // options of one process
  void (*check_output)(const SharedRun& run);
};

// Takes an option with a value from the arguments: -o X, -oX, --output X or --output=X.
std::optional<std::string> take_value(std::vector<std::string>& arguments, const std::string& name) {
  const bool letter = name.size() == 2;
  for (auto at = arguments.begin(); at != arguments.end(); ++at) {
    std::string value;
    if (*at == name) {
      if (at + 1 == arguments.end()) throw UsageError(name, "has no value");
      value = *(at + 1);
      arguments.erase(at, at + 2);
    } else if (letter ? at->starts_with(name) : at->starts_with(name + "=")) {
      value = at->substr(name.size() + (letter ? 0 : 1));
      arguments.erase(at);
    } else {
      continue;
    }
    return value;
  }
  return std::nullopt;
}

void check_table(const SharedRun& run) {
  std::vector<std::string> arguments = run.arguments;
  TableForm form;
  form.layout = take_value(arguments, "--layout").value_or(form.layout);
  check_table_name(run.output, form);
}

const std::vector<SharedVerb>& shared_verbs() {
  static const std::vector<SharedVerb> verbs = {
      {"viewfactor",
       ".npz",
       256,
       true,
       {"--drop", "--report"},
       {"--close"},
       {},
       [](const SharedRun& run) { exchange::check_factors_name(run.output); }},
      {"render", ".exr", 1'000'000, false, {}, {}, {"--stats"}, [](const SharedRun& run) { image::check_picture_name(run.output); }},
      {"bake", ".exr", 1'000'000, true, {}, {}, {"--stats"}, [](const SharedRun& run) { check_baked_name(run.output); }},
      {"fit", ".json", 1024, true, {}, {}, {}, check_table},
  };
  return verbs;
}

bool take_switch(std::vector<std::string>& arguments, const std::string& name) {
  const auto at = std::find(arguments.begin(), arguments.end(), name);
  if (at == arguments.end()) return false;
  arguments.erase(at);
  return true;
}

}  // namespace

SharedRun shared_run(std::vector<std::string> arguments) {
  const std::string word = arguments.empty() ? std::string() : arguments[0];
  const auto verb = std::find_if(shared_verbs().begin(), shared_verbs().end(), [&](const SharedVerb& v) { return v.name == word; });
  const bool asks = verb != shared_verbs().end() && word == "viewfactor" && arguments.size() > 1 &&
                    (arguments[1] == "points" || arguments[1] == "verify");
  if (verb == shared_verbs().end() || asks)
    throw UsageError(asks ? word + " " + arguments[1] : word, "does not share its work between ranks",
                     "viewfactor, render, bake and fit do; start this command without mpirun");
  SharedRun run;
  run.verb = word;
  run.arguments.assign(arguments.begin() + 1, arguments.end());
  for (const std::string& option : verb->refused)
    if (take_value(run.arguments, option)) throw UsageError(option, "is about one process", "leave it out, or start without mpirun");
  if (take_value(run.arguments, "--part")) throw UsageError("--part", "the ranks share the parts", "leave it out, or start without mpirun");
  for (const char* name : {"-o", "--output"})
    if (const auto value = take_value(run.arguments, name)) run.output = *value;
  if (run.output.empty()) throw UsageError("-o", "is required");

  std::vector<std::string> copy = run.arguments;
  if (const auto frames = take_value(copy, "--frames")) {
    const FrameRange range = frame_range(*frames);
    numbered(run.output, 0);  // throws if there is no #
    run.most_parts = range.last - range.first + 1;
    return run;
  }
  verb->check_output(run);
  run.ending = verb->ending;
  run.most_parts = verb->most_parts;
  run.resume = take_switch(run.arguments, "--resume");
  for (const std::string& option : verb->merged)
    if (const auto value = take_value(run.arguments, option)) run.joining.insert(run.joining.end(), {option, *value});
  for (const std::string& option : verb->switches)
    if (take_switch(run.arguments, option)) run.joining.push_back(option);
  for (const char* limit : {"--max-memory", "--max-work"}) {
    copy = run.arguments;
    if (const auto value = take_value(copy, limit)) run.joining.insert(run.joining.end(), {limit, *value});
  }
  if (verb->resumes) run.arguments.push_back("--resume");
  return run;
}

std::string SharedRun::part_file(int number, const std::string& folder) const { return folder + "/" + std::to_string(number) + ending; }

std::vector<std::string> SharedRun::part(int number, int count, const std::string& folder) const {
  std::vector<std::string> command = {verb};
  command.insert(command.end(), arguments.begin(), arguments.end());
  const std::string part = std::to_string(number) + "/" + std::to_string(count);
  command.insert(command.end(), {"-o", joins() ? part_file(number, folder) : output, "--part", part});
  return command;
}

std::vector<std::string> SharedRun::join(int count, const std::string& folder) const {
  std::vector<std::string> command = {"merge"};
  for (int k = 1; k <= count; ++k) command.push_back(part_file(k, folder));
  command.insert(command.end(), {"-o", output});
  command.insert(command.end(), joining.begin(), joining.end());
  return command;
}

}  // namespace steradian::app
