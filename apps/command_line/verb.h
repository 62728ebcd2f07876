// The command line: verbs, their options and usage errors. Only verb.cpp includes CLI11, because its single header costs every unit that
// includes it about fifteen seconds.
#pragma once

#include <cstdint>
#include <functional>
#include <initializer_list>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "core/words.h"
#include "options_table.h"
#include "output.h"
#include "steradian/limits.h"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace steradian::app {

// Wrong use of an option. The command line prints "OPTION: MESSAGE" and exits with 2.
class WrongOption : public std::runtime_error {
 public:
  WrongOption(std::string option, const std::string& message) : std::runtime_error(message), option_(std::move(option)) {}
  const std::string& option() const { return option_; }

 private:
  std::string option_;
};

struct VerbRecord;  // what CLI11 does not keep of a verb's options

// One option of a verb. Each function restricts the option or describes it, and returns it again.
class VerbOption {
 public:
  VerbOption(CLI::App* verb, CLI::Option* option, std::shared_ptr<VerbRecord> record)
      : verb_(verb), option_(option), record_(std::move(record)) {}

  VerbOption& group(const std::string& name);
  VerbOption& more(const std::string& group);  // only --help-all prints the group
  VerbOption& required();
  VerbOption& needs(const std::string& other);
  VerbOption& excludes(const std::string& other);
  VerbOption& separator(char c);                      // one argument holds several values
  VerbOption& default_text(const std::string& text);  // the default as --help shows it
  VerbOption& value_name(const std::string& name);    // the value as --help shows it
  // --help prints the words and the range behind the description.
  VerbOption& words(const std::vector<std::string>& allowed);
  VerbOption& suggests(const std::vector<std::string>& words);  // for completions; other values may be valid too
  VerbOption& range(int low, int high);
  VerbOption& range(double low, double high);
  VerbOption& range(std::uint64_t low, std::uint64_t high);
  VerbOption& bytes();  // accepts 500MB and 4GB
  VerbOption& existing_file();
  VerbOption& existing_folder();
  VerbOption& writes(Writes kind);  // a path that the verb writes; check_output judges it before the verb runs
  // `problem` returns an empty text for a valid argument, else the message.
  VerbOption& check(const std::function<std::string(const std::string&)>& problem);

 private:
  VerbOption& accepts(const std::string& what);  // adds to the description

  CLI::App* verb_;
  CLI::Option* option_;
  std::shared_ptr<VerbRecord> record_;
};

// An option that has an effect only under a condition.
struct ConditionalOption {
  const char* name;  // "--spp"
  bool has_effect;
  const char* needs;  // the condition as a user reads it: "--method sampled"
};

// One verb of the program: its options and the function that runs it. The values must outlive the command line.
class Verb {
 public:
  explicit Verb(CLI::App* app);

  void group(const std::string& name);
  void footer(const std::string& text);
  VerbOption add(const std::string& name, std::string& value, const std::string& help);
  VerbOption add(const std::string& name, std::vector<std::string>& values, const std::string& help);
  VerbOption add(const std::string& name, int& value, const std::string& help);
  VerbOption add(const std::string& name, std::optional<int>& value, const std::string& help);
  VerbOption add(const std::string& name, std::uint64_t& value, const std::string& help);
  VerbOption add(const std::string& name, double& value, const std::string& help);
  VerbOption add_flag(const std::string& name, bool& value, const std::string& help);
  // An option that takes one of the words of core/words.h.
  template <class Value>
  VerbOption add_word(const std::string& name, Value& value, const std::string& help) {
    const auto set = [&value](const std::string& word) { value = *words::find<Value>(word); };
    return add_function(name, set, help).words(words::names<Value>()).default_text(words::name_of(value));
  }
  void add_limits(Limits& limits);  // --max-memory and --max-work: the most that a file may use

  bool given(const std::string& name) const;
  // Throws WrongOption for the first option that the user gave and that has no effect.
  void refuse_without_effect(std::initializer_list<ConditionalOption> options) const;
  void refuse(std::initializer_list<const char*> names, const char* needs) const;  // these never have an effect here
  void callback(std::function<void()> run);
  std::shared_ptr<const VerbRecord> record() const;

 private:
  VerbOption add_function(const std::string& name, const std::function<void(const std::string&)>& set, const std::string& help);
  VerbOption kept(CLI::Option* option) const;

  CLI::App* app_;
  std::shared_ptr<VerbRecord> record_;
};

// The program's exit status: 0 done, 1 the work failed or a comparison did not hold, 2 wrong use.
struct Exit {
  int code = 0;
};

// The whole command line of a program.
class CommandLine {
 public:
  CommandLine(const std::string& description, const std::string& version);
  ~CommandLine();
  CommandLine(const CommandLine&) = delete;
  CommandLine& operator=(const CommandLine&) = delete;

  Verb verb(const std::string& name, const std::string& help);
  // The program itself, for a program without verbs.
  Verb all();
  // The words after the verb, as they were typed.
  const std::vector<std::string>& arguments() const { return arguments_; }
  ProgramRow table() const;
  Exit& exit() { return exit_; }
  // Reads the arguments, runs the verb and returns the exit status. Messages go to standard error.
  int run(int argc, char** argv);

 private:
  struct Parser;
  Parser* parser_;
  std::vector<std::string> arguments_;
  Exit exit_;
};

// The version of CLI11, the library used.
std::string command_line_library();

}  // namespace steradian::app
