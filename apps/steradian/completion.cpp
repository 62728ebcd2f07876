// steradian completion SHELL and steradian man: texts for shells and for man, made of the table of options.
#include "completions.h"

#include <fmt/format.h>

#include <memory>

#include "verbs.h"

namespace steradian::app {

void add_completion(CommandLine& line) {
  Verb verb = line.verb("completion", "Print the completion of this program for a shell");
  verb.group("This machine");
  verb.footer(
      "`cmake --install` puts it where the shell looks for it. For this session alone:\n"
      "source <(steradian completion bash)");
  const auto shell = std::make_shared<std::string>();
  verb.add("SHELL", *shell, "the shell").words({"bash", "zsh", "fish"}).required();
  verb.callback([shell, &line] {
    const ProgramRow table = line.table();
    fmt::print("{}", *shell == "bash" ? bash_completion(table) : *shell == "zsh" ? zsh_completion(table) : fish_completion(table));
  });
}

void add_man(CommandLine& line) {
  Verb verb = line.verb("man", "Print the manual page of this program, for man");
  verb.group("This machine");
  verb.footer("To read it: steradian man | man -l -");
  verb.callback([&line] { fmt::print("{}", manual_page(line.table())); });
}

}  // namespace steradian::app
