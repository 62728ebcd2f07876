#include <sstream>

#include "completions.h"
#include "row_texts.h"

namespace steradian::app {
namespace {

// A line of text for roff, which gives a meaning to backslashes, hyphens, and to dots and quotes that begin a line.
std::string plain(const std::string& text) {
  std::string line;
  for (const char c : text) line += c == '\\' ? std::string("\\e") : c == '-' ? std::string("\\-") : std::string(1, c);
  return (line.starts_with('.') || line.starts_with('\'') ? "\\&" : "") + line;
}

std::string entry(const OptionRow& option) {
  std::string names;
  for (const std::string& name : option.names) names += (names.empty() ? "\\fB" : "\\fR, \\fB") + plain(name);
  const std::string value = option.value.empty() ? std::string() : "\\fI" + plain(option.value) + "\\fR";
  std::string help = option.help + (option.required && !option.names.empty() ? " (required)" : "");
  if (!option.default_text.empty()) help += " [" + option.default_text + "]";
  return ".TP\n" + (names.empty() ? value : names + "\\fR" + (value.empty() ? "" : " ") + value) + "\n" + plain(help) + "\n";
}

std::string verbatim(const std::string& text) {
  std::string result = ".PP\n.nf\n";
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) result += plain(line) + "\n";
  return result + ".fi\n";
}

std::string section(const ProgramRow& program, const VerbRow& verb) {
  std::string text = ".SS " + plain(verb.name) + "\n" + plain(verb.help) + ".\n.PP\n\\fB" + plain(program.name + " " + verb.name) + "\\fR";
  for (const OptionRow& option : verb.options)
    if (option.names.empty()) text += option.required ? " \\fI" + plain(option.value) + "\\fR" : " [\\fI" + plain(option.value) + "\\fR]";
  text += " [options]\n";
  for (const OptionRow& option : verb.options) text += entry(option);
  return verb.footer.empty() ? text : text + verbatim(verb.footer);
}

}  // namespace

std::string manual_page(const ProgramRow& program) {
  std::string text = ".TH STERADIAN 1 \"\" \"" + plain(program.version) + "\" \"User Commands\"\n.SH NAME\n" + plain(program.name) +
                     " \\- " + plain(program.help) + "\n.SH SYNOPSIS\n\\fB" + plain(program.name) +
                     "\\fR \\fIVERB\\fR [options]\n.SH OPTIONS\n";
  for (const OptionRow& option : program.options) text += entry(option);
  text += ".SH VERBS\n";
  for (const VerbRow& verb : program.verbs) text += section(program, verb);
  return text +
         ".SH \"EXIT STATUS\"\n"
         ".TP\n0\nthe work is done\n"
         ".TP\n1\nthe work failed, or a comparison did not hold\n"
         ".TP\n2\nwrong use\n";
}

}  // namespace steradian::app
