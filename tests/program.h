// Program: runs the program as a process, in a folder of its own.
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

  // Runs the program on the file `in` of the folder (made of `input`), out and err to files.
  Outcome run(std::vector<std::string> arguments, const std::string& input = {}) {
    if (!input.empty() || !fs::exists(folder / "in")) std::ofstream(folder / "in", std::ios::binary) << input;
    arguments.insert(arguments.begin(), test::kProgram);
    std::vector<char*> argv;
    for (std::string& a : arguments) argv.push_back(a.data());
    argv.push_back(nullptr);
    const std::string in = folder / "in", out = folder / "out", err = folder / "err";
    const pid_t child = fork();
    if (child == 0) {
      dup2(open(in.c_str(), O_RDONLY), 0);
      dup2(open(out.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600), 1);
      dup2(open(err.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600), 2);
      execv(argv[0], argv.data());
      _exit(127);
    }
    Outcome r;
    int status = 0;
    rusage usage{};
    wait4(child, &status, 0, &usage);
    r.status = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    r.peak_kib = usage.ru_maxrss;
    r.out = contents(out);
    r.err = contents(err);
    return r;
  }

  fs::path folder;
};

}  // namespace steradian
