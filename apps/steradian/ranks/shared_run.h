// SharedRun: a command whose work several ranks share, as the commands of its parts and the command that joins them.
#pragma once

#include <string>
#include <vector>

namespace steradian::app {

struct SharedRun {
  std::string verb, output;
  std::string ending;                  // ending of the parts' files; empty: the parts write the output's own files, such as frames
  std::vector<std::string> arguments;  // arguments of every part, without -o and --part
  std::vector<std::string> joining;    // options of steradian merge
  int most_parts = 1;                  // more parts are empty
  bool resume = false;                 // takes up finished parts of an earlier run

  bool joins() const { return !ending.empty(); }
  // The command of part k of n, and the file that it writes in the folder of parts.
  std::vector<std::string> part(int number, int count, const std::string& folder) const;
  std::string part_file(int number, const std::string& folder) const;
  std::vector<std::string> join(int count, const std::string& folder) const;
};

// arguments: the verb and all that follows it. Throws UsageError for verbs that do not share their work, and for options that need one
// process.
SharedRun shared_run(std::vector<std::string> arguments);

}  // namespace steradian::app
