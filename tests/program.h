// Program: runs the program as a process, in a separate folder.
#pragma once

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "paths.h"

namespace steradian {

namespace fs = std::filesystem;

struct Outcome {
  int status = -1;
  long peak_kib = 0;
  double cpu_seconds = 0;  // sum over all its threads
  std::string out, err;
};

inline std::string contents(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

class Program : public testing::Test {
 protected:
  void SetUp() override {
    std::string name = (fs::temp_directory_path() / "steradian-XXXXXX").string();
    ASSERT_NE(mkdtemp(name.data()), nullptr);
    folder = name;
  }
  void TearDown() override { fs::remove_all(folder); }

  // Runs the program on the file `in` of the folder (written from `input`), with out and err to files.
  Outcome run(std::vector<std::string> arguments, const std::string& input = {}) {
    return run_limited(
        std::move(arguments), [] {}, input);
  }

  // The same after calling `limit` in the new process: for setrlimit, chdir and the like.
  template <class Limit>
  Outcome run_limited(std::vector<std::string> arguments, Limit limit, const std::string& input = {}) {
    return finish(start(std::move(arguments), limit, input));
  }

  // The same in two steps, for tests that act while the program runs. `name` distinguishes the streams of several programs.
  struct Child {
    pid_t pid;
    std::string name;
  };
  template <class Limit>
  Child start(std::vector<std::string> arguments, Limit limit, const std::string& input = {}, const std::string& name = {}) {
    if (!input.empty() || !fs::exists(folder / "in")) std::ofstream(folder / "in", std::ios::binary) << input;
    arguments.insert(arguments.begin(), test::kProgram);
    std::vector<char*> argv;
    for (std::string& a : arguments) argv.push_back(a.data());
    argv.push_back(nullptr);
    const std::string in = folder / "in", out = folder / ("out" + name), err = folder / ("err" + name);
    const pid_t child = fork();
    if (child == 0) {
      dup2(open(in.c_str(), O_RDONLY), 0);
      dup2(open(out.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600), 1);
      dup2(open(err.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600), 2);
      limit();
      execv(argv[0], argv.data());
      _exit(127);
    }
    return {child, name};
  }

  Outcome finish(const Child& child) {
    const std::string out = folder / ("out" + child.name), err = folder / ("err" + child.name);
    Outcome r;
    int status = 0;
    rusage usage{};
    wait4(child.pid, &status, 0, &usage);
    r.status = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    r.peak_kib = usage.ru_maxrss;
    const auto seconds = [](const timeval& t) { return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec); };
    r.cpu_seconds = seconds(usage.ru_utime) + seconds(usage.ru_stime);
    r.out = contents(out);
    r.err = contents(err);
    return r;
  }

  fs::path folder;
};

}  // namespace steradian
