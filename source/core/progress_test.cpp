#include "core/progress.h"

#include <gtest/gtest.h>

#include <thread>
#include <vector>

namespace steradian::progress_test {
namespace {

struct Recorder {
  double now = 100;
  std::vector<std::string> lines;
  ProgressOutput output(ProgressForm form) {
    return {form, [this](std::string_view text) { lines.emplace_back(text); }, [this] { return now; }};
  }
};

TEST(Progress, IsSilentInTheFirstSecondAndWithoutAnOutput) {
  Recorder quick, blind;
  {
    Progress c("work", 100, quick.output(ProgressForm::lines));
    Progress a("work", 100, quick.output(ProgressForm::over_the_last)), b("work", 100, blind.output(ProgressForm::none));
    for (int i = 0; i < 99; ++i) {
      quick.now += 0.01;
      blind.now += 1;
      a.add();
      b.add();
      c.add();
    }
  }
  EXPECT_TRUE(quick.lines.empty()) << quick.lines.front();
  EXPECT_TRUE(blind.lines.empty()) << blind.lines.front();
}

TEST(Progress, ShowsTenLinesASecondAtMostAndWipesTheLast) {
  Recorder r;
  {
    Progress progress("work", 4000, r.output(ProgressForm::over_the_last));
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

TEST(Progress, WritesALineASecondAtMostIntoAPipe) {
  Recorder r;
  {
    Progress progress("work", 4000, r.output(ProgressForm::lines)), unknown("stream", 0, r.output(ProgressForm::lines));
    for (int i = 0; i < 3000; ++i) {
      r.now += 1.0 / 512;
      progress.add();
      unknown.add();
    }
  }
  ASSERT_EQ(r.lines.size(), 5u);  // of 5.9 seconds the first is silent
  EXPECT_EQ(r.lines[0], "work   12.8 %  1 s, 7 s left\n");
  for (const std::string& line : r.lines) EXPECT_TRUE(line.ends_with(" left\n") && line.find('\r') == std::string::npos) << line;
}

TEST(Progress, WritesNoPercentageTwiceIntoAPipe) {
  Recorder r;
  Progress progress("work", 100000, r.output(ProgressForm::lines));
  for (int i = 0; i < 1000; ++i) {
    r.now += 1.5;
    progress.add();
  }
  EXPECT_EQ(r.lines.size(), 11u);  // 0.0 to 1.0 %
}

// Each is shorter than a second; together they are not.
TEST(Progress, TakesTurnsWithOthersOfTheSameOutput) {
  Recorder r;
  const ProgressOutput output = r.output(ProgressForm::lines);
  for (int work = 0; work < 10; ++work) {
    Progress progress("work " + std::to_string(work), 10, output);
    for (int i = 0; i < 10; ++i) {
      r.now += 1.0 / 16;
      progress.add();
    }
  }
  ASSERT_EQ(r.lines.size(), 6u);
  EXPECT_TRUE(r.lines[0].starts_with("work 1   60.0 %")) << r.lines[0];
}

TEST(Progress, IsWipedBeforeOtherText) {
  Recorder r;
  Progress progress("work", 10, r.output(ProgressForm::over_the_last));
  r.now += 2;
  progress.add();
  progress.wipe();
  ASSERT_EQ(r.lines.size(), 2u);
  EXPECT_EQ(r.lines.back(), "\r\x1b[K");
  progress.wipe();
  EXPECT_EQ(r.lines.size(), 2u);  // there is nothing to wipe
}

TEST(Progress, NeverFalls) {
  Recorder r;
  Progress progress("work", 1000, r.output(ProgressForm::none));
  for (const double fraction : {0.1, 0.3, 0.2, -1.0}) progress.reach(fraction);
  EXPECT_EQ(progress.count(), 300u);
  progress.reach(7);
  EXPECT_EQ(progress.count(), 1000u);
}

// A part of a part of a work takes its share of the whole.
TEST(WorkSteps, FillTheirPartOfTheWork) {
  std::vector<double> told;
  const WorkFraction whole = [&](double fraction) { told.push_back(fraction); };
  WorkSteps steps(part_of(part_of(whole, 0.5, 1), 0, 0.5), 4);
  for (int i = 0; i < 3; ++i) steps.advance();
  steps.advance(2);  // more than expected
  EXPECT_EQ(told, (std::vector<double>{0.5625, 0.625, 0.6875, 0.75}));
  WorkSteps(part_of({}, 0, 1), 1).advance();
  WorkSteps(whole, 0).advance();
  EXPECT_EQ(told.size(), 4u);
}

TEST(Progress, CountsEveryStepOfEveryThread) {
  Recorder r;
  Progress progress("work", 0, r.output(ProgressForm::none));
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
