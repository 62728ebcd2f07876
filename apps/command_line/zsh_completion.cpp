#include "completions.h"
#include "row_texts.h"

namespace steradian::app {
namespace {

std::string zsh_quoted(const std::string& text) {
  std::string result = "'";
  for (const char c : text) result += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return result + "'";
}

// The part of _arguments about a value: ":FILE:_files", ":WORD:(a b)".
std::string value_of(const OptionRow& option) {
  if (option.value.empty()) return {};
  const std::string action = !option.words.empty() ? "(" + joined(option.words, " ") + ")" : is_number(option) ? " " : "_files";
  return ":" + escaped(option.value, ":", "\\") + ":" + action;
}

std::string spec(const OptionRow& option) {
  if (option.names.empty()) return zsh_quoted(value_of(option));
  const std::string help = "[" + escaped(option.help, "[]\\", "\\") + "]" + value_of(option);
  if (option.names.size() == 1) return zsh_quoted(option.names[0] + help);
  return zsh_quoted("(" + joined(option.names, " ") + ")") + "{" + joined(option.names, ",") + "}" + zsh_quoted(help);
}

}  // namespace

std::string zsh_completion(const ProgramRow& program) {
  std::string verbs, cases;
  for (const VerbRow& verb : program.verbs) {
    verbs += "    " + zsh_quoted(verb.name + ":" + escaped(verb.help, ":\\", "\\")) + "\n";
    cases += "    " + verb.name + ")\n      _arguments";
    for (const OptionRow& option : verb.options) cases += " \\\n        " + spec(option);
    cases += "\n      ;;\n";
  }
  std::string options;
  for (const OptionRow& option : program.options) options += " \\\n      " + spec(option);
  return "#compdef " + program.name + "\n# Completion of " + program.name + " for zsh: `" + program.name +
         " completion zsh` prints it.\n_" + program.name + "() {\n  local verb=$words[2]\n  local -a verbs=(\n" + verbs +
         "  )\n"
         "  if (( CURRENT == 2 )); then\n"
         "    _describe verb verbs\n"
         "    _arguments" +
         options +
         "\n    return\n"
         "  fi\n"
         "  shift words\n"
         "  (( CURRENT-- ))\n"
         "  case $verb in\n" +
         cases +
         "  esac\n"
         "}\n"
         "_" +
         program.name + " \"$@\"\n";
}

}  // namespace steradian::app
