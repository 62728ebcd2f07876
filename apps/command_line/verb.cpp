#include "verb.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <exception>
#include <filesystem>
#include <map>
#include <memory>
#include <new>

#include "steradian/error.h"
#include "wrong_use.h"

namespace steradian::app {

struct VerbRecord {
  std::map<const CLI::Option*, std::vector<std::string>> words;  // values to choose from
  std::vector<std::function<void()>> outputs;                    // checks that run before the verb
};

namespace {

constexpr const char* kMore = " (more)";  // ends the names of groups that only --help-all prints

bool is_more(const std::string& group) { return group.ends_with(kMore); }

// Help with one line an option: name and kind of value, description, words or range, default.
class OneLineHelp : public CLI::Formatter {
 public:
  OneLineHelp() { column_width(30); }

  std::string make_option_opts(const CLI::Option* option) const override {
    return option->get_type_size() == 0 ? std::string() : " " + option->get_type_name();
  }

  std::string make_option_desc(const CLI::Option* option) const override {
    std::string text = option->get_description();
    if (option->get_required() && option->nonpositional()) text += " (required)";
    const std::string value = option->get_type_size() == 0 ? std::string() : option->get_default_str();
    return value.empty() || value == "[]" ? text : text + " [" + value + "]";
  }

  std::string make_help(const CLI::App* app, std::string name, CLI::AppFormatMode mode) const override {
    all_ = mode == CLI::AppFormatMode::All;
    std::string text = CLI::Formatter::make_help(app, std::move(name), mode);
    for (std::size_t at; (at = text.find("\n\n\n")) != std::string::npos;) text.erase(at, 1);
    return text;
  }

  std::string make_group(std::string group, bool is_positional, std::vector<const CLI::Option*> options) const override {
    if (!is_more(group)) return CLI::Formatter::make_group(group, is_positional, options);
    return all_ ? CLI::Formatter::make_group(group.substr(0, group.size() - std::strlen(kMore)), is_positional, options) : std::string();
  }

  std::string make_footer(const CLI::App* app) const override {
    const std::size_t more = app->get_options([](const CLI::Option* o) { return is_more(o->get_group()); }).size();
    const std::string hint = all_ || more == 0 ? std::string() : "\n--help-all prints " + std::to_string(more) + " more options.\n";
    return hint + CLI::Formatter::make_footer(app);
  }

  // --help-all of the program lists the verbs, as --help does.
  std::string make_subcommands(const CLI::App* app, CLI::AppFormatMode) const override {
    return CLI::Formatter::make_subcommands(app, CLI::AppFormatMode::Normal);
  }

 private:
  mutable bool all_ = false;  // the help being made is that of --help-all
};

// A range as --help prints it.
std::string shown(double low, double high) {
  char text[64];
  std::snprintf(text, sizeof text, "%.12g to %.12g", low, high);
  return text;
}

// The names of an option as they are typed; none of a positional argument.
std::vector<std::string> typed_names(const CLI::Option* option) {
  std::vector<std::string> names;
  for (const std::string& letter : option->get_snames()) names.push_back("-" + letter);
  for (const std::string& word : option->get_lnames()) names.push_back("--" + word);
  return names;
}

std::vector<OptionRow> rows_of(const CLI::App& app, const std::map<const CLI::Option*, std::vector<std::string>>& words) {
  std::vector<OptionRow> rows;
  for (const CLI::Option* option : app.get_options()) {
    OptionRow row;
    row.names = typed_names(option);
    if (option->get_type_size() != 0) row.value = row.names.empty() ? option->get_name(true) : option->get_type_name();
    row.help = option->get_description();
    row.default_text = row.value.empty() || option->get_default_str() == "[]" ? std::string() : option->get_default_str();
    row.rare = is_more(option->get_group());
    row.group = row.rare ? option->get_group().substr(0, option->get_group().size() - std::strlen(kMore)) : option->get_group();
    row.required = option->get_required();
    if (const auto known = words.find(option); known != words.end()) row.words = known->second;
    rows.push_back(std::move(row));
  }
  return rows;
}

// The message for the first option that the user gave and that the program or its verb does not have; empty if there is none.
std::string message_of_unknown_option(const CLI::App& app, const std::string& program) {
  const std::vector<std::string> rest = app.remaining(true);
  const auto given = std::find_if(rest.begin(), rest.end(), [](const std::string& word) { return word.size() > 1 && word[0] == '-'; });
  if (given == rest.end()) return {};
  const std::vector<CLI::App*> verbs = app.get_subcommands();
  const CLI::App& of = verbs.empty() ? app : *verbs.front();
  const std::string command = verbs.empty() ? program : program + " " + of.get_name();
  std::vector<std::string> options;
  for (const CLI::Option* option : of.get_options())
    for (std::string& name : typed_names(option)) options.push_back(std::move(name));
  return command + ": " + unknown_option(*given, options) + "\n" + command + " --help-all lists the options";
}

CLI::Validator without_description(CLI::Validator validator) {
  validator.description("");
  return validator;
}

}  // namespace

VerbOption& VerbOption::group(const std::string& name) { return option_->group(name), *this; }
VerbOption& VerbOption::more(const std::string& group) { return option_->group(group + kMore), *this; }
VerbOption& VerbOption::required() { return option_->required(), *this; }
VerbOption& VerbOption::needs(const std::string& other) { return option_->needs(verb_->get_option(other)), *this; }
VerbOption& VerbOption::excludes(const std::string& other) { return option_->excludes(verb_->get_option(other)), *this; }
VerbOption& VerbOption::separator(char c) { return option_->delimiter(c), *this; }
VerbOption& VerbOption::default_text(const std::string& text) { return option_->default_str(text), *this; }
VerbOption& VerbOption::value_name(const std::string& name) { return option_->type_name(name), *this; }
VerbOption& VerbOption::accepts(const std::string& what) {
  option_->description(option_->get_description() + ": " + what);
  return *this;
}
VerbOption& VerbOption::words(const std::vector<std::string>& allowed) {
  std::string list;
  for (const std::string& word : allowed) list += (list.empty() ? "" : ", ") + word;
  option_->check(without_description(CLI::IsMember(allowed)));
  suggests(allowed);
  return accepts(list);
}
VerbOption& VerbOption::suggests(const std::vector<std::string>& words) { return record_->words[option_] = words, *this; }
VerbOption& VerbOption::range(int low, int high) {
  option_->check(without_description(CLI::Range(low, high)));
  return accepts(shown(low, high));
}
VerbOption& VerbOption::range(double low, double high) {
  option_->check(without_description(CLI::Range(low, high)));
  return accepts(shown(low, high));
}
VerbOption& VerbOption::range(std::uint64_t low, std::uint64_t high) {
  option_->check(without_description(CLI::Range(low, high)));
  return *this;
}
VerbOption& VerbOption::bytes() {
  option_->transform(without_description(CLI::AsSizeValue(true)))->type_name("SIZE");
  return *this;
}
VerbOption& VerbOption::existing_file() {
  option_->check(without_description(CLI::ExistingFile))->type_name("FILE");
  return *this;
}
VerbOption& VerbOption::existing_folder() {
  option_->check(without_description(CLI::ExistingDirectory))->type_name("FOLDER");
  return *this;
}
VerbOption& VerbOption::writes(Writes kind) {
  option_->type_name(kind == Writes::folder ? "FOLDER" : "FILE");
  record_->outputs.push_back([option = option_, kind] {
    if (option->count() > 0) check_output(option->as<std::string>(), kind);
  });
  return *this;
}
VerbOption& VerbOption::check(const std::function<std::string(const std::string&)>& problem) {
  option_->check(CLI::Validator([problem](std::string& argument) { return problem(argument); }, ""));
  return *this;
}

Verb::Verb(CLI::App* app) : app_(app), record_(std::make_shared<VerbRecord>()) {}
std::shared_ptr<const VerbRecord> Verb::record() const { return record_; }
VerbOption Verb::kept(CLI::Option* option) const { return VerbOption(app_, option, record_); }
void Verb::group(const std::string& name) { app_->group(name); }
void Verb::footer(const std::string& text) { app_->footer(text); }
VerbOption Verb::add(const std::string& name, std::string& value, const std::string& help) {
  return kept(app_->add_option(name, value, help));
}
VerbOption Verb::add(const std::string& name, std::vector<std::string>& values, const std::string& help) {
  return kept(app_->add_option(name, values, help));
}
VerbOption Verb::add(const std::string& name, int& value, const std::string& help) { return kept(app_->add_option(name, value, help)); }
VerbOption Verb::add(const std::string& name, std::optional<int>& value, const std::string& help) {
  return kept(app_->add_option(name, value, help));
}
VerbOption Verb::add(const std::string& name, std::uint64_t& value, const std::string& help) {
  return kept(app_->add_option(name, value, help));
}
VerbOption Verb::add(const std::string& name, double& value, const std::string& help) { return kept(app_->add_option(name, value, help)); }
VerbOption Verb::add_flag(const std::string& name, bool& value, const std::string& help) { return kept(app_->add_flag(name, value, help)); }
VerbOption Verb::add_function(const std::string& name, const std::function<void(const std::string&)>& set, const std::string& help) {
  return kept(app_->add_option_function<std::string>(name, set, help));
}

void Verb::add_limits(Limits& limits) {
  add("--max-memory", limits.memory, "memory for a file's contents: 500MB, 4GB").bytes().more("Limits");
  add("--max-work", limits.work, "work to prepare a file, in steps of about 1 ns")
      .range(std::uint64_t{1}, std::uint64_t{1} << 62)
      .more("Limits");
}

bool Verb::given(const std::string& name) const { return app_->get_option(name)->count() > 0; }

void Verb::refuse_without_effect(std::initializer_list<ConditionalOption> options) const {
  for (const ConditionalOption& option : options)
    if (!option.has_effect && given(option.name))
      throw WrongOption(option.name, std::string("changes nothing here: it needs ") + option.needs);
}

void Verb::refuse(std::initializer_list<const char*> names, const char* needs) const {
  for (const char* name : names) refuse_without_effect({{name, false, needs}});
}

void Verb::callback(std::function<void()> run) {
  app_->callback([run = std::move(run), record = record_] {
    try {
      for (const std::function<void()>& check : record->outputs) check();
      run();
    } catch (const WrongOption& e) {
      throw CLI::ValidationError(e.option(), e.what());
    }
  });
}

struct CommandLine::Parser {
  CLI::App app;
  std::string version;
  std::vector<std::pair<const CLI::App*, std::shared_ptr<const VerbRecord>>> verbs;
};

CommandLine::CommandLine(const std::string& description, const std::string& version)
    : parser_(new Parser{CLI::App(description), version, {}}) {
  parser_->app.set_version_flag("--version", version);
  parser_->app.set_help_flag("-h,--help", "Print this help");
  parser_->app.set_help_all_flag("--help-all", "Print all options, also the rare ones");
  parser_->app.option_defaults()->always_capture_default();
  parser_->app.formatter(std::make_shared<OneLineHelp>());
}

CommandLine::~CommandLine() { delete parser_; }

Verb CommandLine::verb(const std::string& name, const std::string& help) {
  parser_->app.require_subcommand(1);
  CLI::App* app = parser_->app.add_subcommand(name, help);
  const Verb verb(app);
  parser_->verbs.emplace_back(app, verb.record());
  return verb;
}

ProgramRow CommandLine::table() const {
  const CLI::App& app = parser_->app;
  ProgramRow program{"steradian", app.get_description(), parser_->version, rows_of(app, {}), {}};
  for (const auto& [verb, record] : parser_->verbs)
    program.verbs.push_back({verb->get_name(), verb->get_description(), verb->get_footer(), rows_of(*verb, record->words)});
  return program;
}

Verb CommandLine::all() { return Verb(&parser_->app); }

int CommandLine::run(int argc, char** argv) {
  CLI::App& app = parser_->app;
  arguments_.assign(argv + std::min(argc, 2), argv + argc);
  // Exceeding a limit on file sizes is then an error of the write, with the file's name, and does not end the process.
  std::signal(SIGXFSZ, SIG_IGN);
  if (!parser_->verbs.empty() && argc >= 2 && argv[1][0] != '-' && argv[1][0] != '\0') {
    std::vector<std::string> verbs;
    for (const CLI::App* verb : app.get_subcommands({})) verbs.push_back(verb->get_name());
    if (const std::string message = unknown_verb(argv[1], verbs); !message.empty()) {
      std::fprintf(stderr, "steradian: %s\nsteradian --help lists them\n", message.c_str());
      return 2;
    }
  }
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    const bool asked = e.get_exit_code() == static_cast<int>(CLI::ExitCodes::Success);  // for help or the version
    const std::string unknown = asked ? std::string() : message_of_unknown_option(app, std::filesystem::path(argv[0]).filename().string());
    if (unknown.empty()) return app.exit(e) == 0 ? 0 : 2;
    std::fprintf(stderr, "%s\n", unknown.c_str());
    return 2;
  } catch (const UsageError& e) {
    std::fprintf(stderr, "steradian: %s\n", e.what());
    return 2;
  } catch (const std::bad_alloc&) {
    std::fprintf(stderr, "steradian: %s: the machine ran out of memory (free some memory, or ask for less)\n", argc > 1 ? argv[1] : "");
    return 1;
  } catch (const std::exception& e) {
    std::fprintf(stderr, "steradian: %s\n", e.what());
    return 1;
  }
  return exit_.code;
}

std::string command_line_library() { return CLI11_VERSION; }

}  // namespace steradian::app
