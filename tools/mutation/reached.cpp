// Writes for each running test its name, its time in milliseconds, and the mutants' sites that it reaches. They go into the file that the
// environment's STERADIAN_REACHED names.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <iterator>

namespace {

class Listener : public testing::EmptyTestEventListener {
  void OnTestStart(const testing::TestInfo&) override { std::fill(std::begin(mutated::reached), std::end(mutated::reached), false); }
  void OnTestEnd(const testing::TestInfo& test) override {
    std::FILE* file = std::fopen(std::getenv("STERADIAN_REACHED"), "a");
    if (file == nullptr) std::abort();
    std::fprintf(file, "%s.%s %d %lld", test.test_suite_name(), test.name(), test.result()->Passed() ? 1 : 0,
                 static_cast<long long>(test.result()->elapsed_time()));
    for (int site = 0; site < STERADIAN_MUTANTS; ++site)
      if (mutated::reached[site]) std::fprintf(file, " %d", site);
    std::fprintf(file, "\n");
    std::fclose(file);
  }
};

const bool listens = [] {
  if (std::getenv("STERADIAN_REACHED") != nullptr) testing::UnitTest::GetInstance()->listeners().Append(new Listener);
  return true;
}();

}  // namespace
