// steradian VERB [--option VALUE] INPUT -o OUTPUT
#include <csignal>
#include <cstdio>
#include <exception>
#include <new>

#include "steradian/error.h"
#include "steradian/version.h"
#include "verbs.h"
#include "wrong_use.h"

int main(int argc, char** argv) {
  CLI::App app("Light computed without sampling: area light integrals in closed form.");
  app.set_version_flag("--version", std::string("steradian ") + steradian::version());
  app.require_subcommand(1);
  app.option_defaults()->always_capture_default();
  app.get_formatter()->column_width(36);

  steradian::app::Exit exit;
  steradian::app::add_eval(app, exit);
  steradian::app::add_bench(app, exit);
  steradian::app::add_diff(app, exit);
  steradian::app::add_render(app, exit);
  steradian::app::add_compare(app, exit);
  steradian::app::add_fit(app, exit);
  steradian::app::add_info(app, exit);
  steradian::app::add_view(app, exit);

  // A limit on file sizes is then an error of the write, with the file's name, and not the end of the process.
  std::signal(SIGXFSZ, SIG_IGN);
  if (const std::string message = steradian::app::unknown_verb(app, argc, argv); !message.empty()) {
    std::fprintf(stderr, "steradian: %s\nsteradian --help lists them\n", message.c_str());
    return 2;
  }
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    return app.exit(e) == 0 ? 0 : 2;
  } catch (const steradian::UsageError& e) {
    std::fprintf(stderr, "steradian: %s\n", e.what());
    return 2;
  } catch (const std::bad_alloc&) {
    std::fprintf(stderr, "steradian: %s: the machine ran out of memory (free some memory, or ask for less)\n", argv[1]);
    return 1;
  } catch (const std::exception& e) {
    std::fprintf(stderr, "steradian: %s\n", e.what());
    return 1;
  }
  return exit.code;
}
