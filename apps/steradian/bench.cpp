// steradian bench: starts the program steradian-bench in the same folder.
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <memory>

#include "bench_options.h"
#include "steradian/error.h"
#include "verbs.h"

namespace steradian::app {
namespace {

// Returns only by an exception.
void start(const std::vector<std::string>& arguments) {
  std::error_code unknown;
  const std::filesystem::path self = std::filesystem::read_symlink("/proc/self/exe", unknown);
  const std::string program = (self.parent_path() / "steradian-bench").string();
  std::vector<char*> words = {const_cast<char*>("steradian-bench")};
  for (const std::string& argument : arguments) words.push_back(const_cast<char*>(argument.c_str()));
  words.push_back(nullptr);
  execv(program.c_str(), words.data());
  if (errno == ENOENT)
    throw Error("bench", "the program steradian-bench is not there: " + program, "build it with -DSTERADIAN_BENCH=ON, as ./dev build does");
  throw Error(program, std::strerror(errno));
}

}  // namespace

void add_bench(CommandLine& line) {
  Verb verb = line.verb("bench", "Time the integrals on this machine (the program steradian-bench)");
  verb.group("This machine");
  const auto options = std::make_shared<BenchArguments>();
  add_bench_options(verb, *options);  // judged here already; the program reads them again
  verb.callback([options, &line] { start(line.arguments()); });
}

}  // namespace steradian::app
