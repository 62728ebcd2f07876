#include "completions.h"
#include "row_texts.h"

namespace steradian::app {
namespace {

std::string fish_quoted(const std::string& text) { return "'" + escaped(text, "'\\", "\\") + "'"; }

// -f: no names of files; -r: a value, which may be one; -x: a value that is none.
std::string line_of(const std::string& command, const OptionRow& option) {
  std::string line = command;
  for (const std::string& name : option.names) line += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
  const bool free = option.words.empty() && !is_number(option);
  if (!option.value.empty() && !option.names.empty()) line += free ? " -r" : " -x";
  if (option.names.empty()) line += " -f";
  if (!option.words.empty()) line += " -a " + fish_quoted(joined(option.words, " "));
  return line + " -d " + fish_quoted(option.help) + "\n";
}

}  // namespace

std::string fish_completion(const ProgramRow& program) {
  const std::string command = "complete -c " + program.name, before = command + " -n __fish_use_subcommand";
  std::string text = "# Completion of " + program.name + " for fish: `" + program.name + " completion fish` prints it.\n";
  for (const OptionRow& option : program.options) text += line_of(before, option);
  for (const VerbRow& verb : program.verbs) text += before + " -f -a " + verb.name + " -d " + fish_quoted(verb.help) + "\n";
  for (const VerbRow& verb : program.verbs)
    for (const OptionRow& option : verb.options)
      if (!option.names.empty() || !option.words.empty())
        text += line_of(command + " -n '__fish_seen_subcommand_from " + verb.name + "'", option);
  return text;
}

}  // namespace steradian::app
