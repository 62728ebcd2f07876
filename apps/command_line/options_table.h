// The options of a program as plain data, for its manual page and the completions of shells.
#pragma once

#include <string>
#include <vector>

namespace steradian::app {

struct OptionRow {
  std::vector<std::string> names;  // "-o", "--output"; empty: an argument without a name, such as SCENE
  std::string value;               // "FILE", "TEXT", "INT", or the argument's own name; empty: a flag
  std::string help;
  std::string default_text;
  std::string group;
  bool rare = false;  // only --help-all prints it
  bool required = false;
  std::vector<std::string> words;  // values to choose from
};

struct VerbRow {
  std::string name, help, footer;
  std::vector<OptionRow> options;
};

struct ProgramRow {
  std::string name, help, version;
  std::vector<OptionRow> options;  // before a verb
  std::vector<VerbRow> verbs;
};

}  // namespace steradian::app
