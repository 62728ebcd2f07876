#include "core/progress.h"

#include <gtest/gtest.h>

#include <thread>
#include <vector>

namespace steradian::progress_test {
namespace {

struct Recorder {
  double now = 100;
  std::vector<std::string> lines;
  ProgressOutput output(bool enabled) {
    return {enabled, [this](std::string_view text) { lines.emplace_back(text); }, [this] { return now; }};
  }
};

TEST(Progress, IsSilentInTheFirstSecondAndWhereThereIsNoTerminal) {
  Recorder quick, blind;
  {
    Progress a("work", 100, quick.output(true)), b("work", 100, blind.output(false));
    for (int i = 0; i < 99; ++i) {
      quick.now += 0.01;
      blind.now += 1;
      a.add();
      b.add();
    }
  }
  EXPECT_TRUE(quick.lines.empty()) << quick.lines.front();
  EXPECT_TRUE(blind.lines.empty()) << blind.lines.front();
}

TEST(Progress, ShowsTenLinesASecondAtMostAndWipesTheLast) {
  Recorder r;
  {
    Progress progress("work", 4000, r.output(true));
    for (int i = 0; i < 3000; ++i) {
      r.now += 0.001;
      progress.add();
    }
  }
  // Progress is visible for two of three seconds.
  EXPECT_GE(r.lines.size(), 18u);
  EXPECT_LE(r.lines.size(), 22u);
  EXPECT_NE(r.lines[0].find("25.0 %"), std::string::npos) << r.lines[0];
  EXPECT_EQ(r.lines.back(), "\r\x1b[K");
}

TEST(Progress, CountsEveryStepOfEveryThread) {
  Recorder r;
  Progress progress("work", 0, r.output(false));
  std::vector<std::thread> threads;
  for (int t = 0; t < 4; ++t)
    threads.emplace_back([&] {
      for (int i = 0; i < 10000; ++i) progress.add();
    });
  for (std::thread& t : threads) t.join();
  EXPECT_EQ(progress.count(), 40000u);
}

}  // namespace
}  // namespace steradian::progress_test
