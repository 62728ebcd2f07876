#include "verb.h"

#include <CLI/CLI.hpp>
#include <csignal>
#include <cstdio>
#include <exception>
#include <new>

#include "steradian/error.h"
#include "wrong_use.h"

namespace steradian::app {

namespace {

template <class T>
CLI::Range range_of(T low, T high, const std::string& text) {
  CLI::Range range(low, high);
  if (!text.empty()) range.description(text);
  return range;
}

}  // namespace

VerbOption& VerbOption::group(const std::string& name) { return option_->group(name), *this; }
VerbOption& VerbOption::required() { return option_->required(), *this; }
VerbOption& VerbOption::needs(const std::string& other) { return option_->needs(verb_->get_option(other)), *this; }
VerbOption& VerbOption::excludes(const std::string& other) { return option_->excludes(verb_->get_option(other)), *this; }
VerbOption& VerbOption::separator(char c) { return option_->delimiter(c), *this; }
VerbOption& VerbOption::default_text(const std::string& text) { return option_->default_str(text), *this; }
VerbOption& VerbOption::words(const std::vector<std::string>& allowed) { return option_->check(CLI::IsMember(allowed)), *this; }
VerbOption& VerbOption::range(int low, int high, const std::string& text) { return option_->check(range_of(low, high, text)), *this; }
VerbOption& VerbOption::range(double low, double high, const std::string& text) { return option_->check(range_of(low, high, text)), *this; }
VerbOption& VerbOption::range(std::uint64_t low, std::uint64_t high) { return option_->check(range_of(low, high, {})), *this; }
VerbOption& VerbOption::bytes() { return option_->transform(CLI::AsSizeValue(true)), *this; }
VerbOption& VerbOption::existing_file() { return option_->check(CLI::ExistingFile), *this; }
VerbOption& VerbOption::existing_folder() { return option_->check(CLI::ExistingDirectory), *this; }
VerbOption& VerbOption::check(const std::function<std::string(const std::string&)>& problem, const std::string& text) {
  option_->check(CLI::Validator([problem](std::string& argument) { return problem(argument); }, text));
  return *this;
}

void Verb::group(const std::string& name) { app_->group(name); }
void Verb::footer(const std::string& text) { app_->footer(text); }
VerbOption Verb::add(const std::string& name, std::string& value, const std::string& help) {
  return VerbOption(app_, app_->add_option(name, value, help));
}
VerbOption Verb::add(const std::string& name, std::vector<std::string>& values, const std::string& help) {
  return VerbOption(app_, app_->add_option(name, values, help));
}
VerbOption Verb::add(const std::string& name, int& value, const std::string& help) {
  return VerbOption(app_, app_->add_option(name, value, help));
}
VerbOption Verb::add(const std::string& name, std::optional<int>& value, const std::string& help) {
  return VerbOption(app_, app_->add_option(name, value, help));
}
VerbOption Verb::add(const std::string& name, std::uint64_t& value, const std::string& help) {
  return VerbOption(app_, app_->add_option(name, value, help));
}
VerbOption Verb::add(const std::string& name, double& value, const std::string& help) {
  return VerbOption(app_, app_->add_option(name, value, help));
}
VerbOption Verb::add_flag(const std::string& name, bool& value, const std::string& help) {
  return VerbOption(app_, app_->add_flag(name, value, help));
}

void Verb::add_limits(Limits& limits) {
  add("--max-memory", limits.memory, "bytes that a file's contents may take: 4GB, 500MB").bytes().group("Limits");
  add("--max-work", limits.work, "steps of about a nanosecond that preparing a file may take")
      .range(std::uint64_t{1}, std::uint64_t{1} << 62)
      .group("Limits");
}

void Verb::pass_on(std::vector<std::string>& arguments) {
  app_->set_help_flag();
  app_->prefix_command();
  app_->parse_complete_callback([this_app = app_, &arguments] { arguments = this_app->remaining(); });
}

bool Verb::given(const std::string& name) const { return app_->get_option(name)->count() > 0; }

void Verb::refuse_without_effect(std::initializer_list<ConditionalOption> options) const {
  for (const ConditionalOption& option : options)
    if (!option.has_effect && given(option.name))
      throw WrongOption(option.name, std::string("changes nothing here: it needs ") + option.needs);
}

void Verb::callback(std::function<void()> run) {
  app_->callback([run = std::move(run)] {
    try {
      run();
    } catch (const WrongOption& e) {
      throw CLI::ValidationError(e.option(), e.what());
    }
  });
}

struct CommandLine::Parser {
  CLI::App app;
  bool has_verbs = false;
};

CommandLine::CommandLine(const std::string& description, const std::string& version) : parser_(new Parser{CLI::App(description)}) {
  parser_->app.set_version_flag("--version", version);
  parser_->app.option_defaults()->always_capture_default();
  parser_->app.get_formatter()->column_width(36);
}

CommandLine::~CommandLine() { delete parser_; }

Verb CommandLine::verb(const std::string& name, const std::string& help) {
  if (!parser_->has_verbs) parser_->app.require_subcommand(1);
  parser_->has_verbs = true;
  return Verb(parser_->app.add_subcommand(name, help));
}

Verb CommandLine::all() { return Verb(&parser_->app); }

int CommandLine::run(int argc, char** argv) {
  CLI::App& app = parser_->app;
  // Exceeding a limit on file sizes is then an error of the write, with the file's name, and does not end the process.
  std::signal(SIGXFSZ, SIG_IGN);
  if (parser_->has_verbs && argc >= 2 && argv[1][0] != '-' && argv[1][0] != '\0') {
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
    return app.exit(e) == 0 ? 0 : 2;
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
