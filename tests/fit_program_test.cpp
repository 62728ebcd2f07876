// `steradian fit` in parts, and going on after a kill, as processes.
#include <sys/wait.h>

#include <chrono>
#include <csignal>
#include <thread>
#include <tuple>

#include "program.h"

namespace steradian::fit_program_test {
namespace {

using Words = std::vector<std::string>;

Words with(Words words, const Words& more) {
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

TEST_F(Program, PartsOfAFitAreTheFit) {
  std::ofstream(folder / "wall.txt") << "0 0 0 0.3183\n0 90 0 0.3183\n90 0 0 0.3183\n90 90 0 0.3183\n";
  const struct {
    Words options;
    std::string ending;
  } kinds[] = {{{"--size", "5"}, ".json"},
               {{"--lobe", "charlie", "--size", "4", "--normalisation", "last"}, ".h"},
               {{"--lobe", "disney-diffuse", "--size", "4", "--layout", "compact"}, ".glsl"},
               {{"--samples", folder / "wall.txt", "--size", "4"}, ".json"}};
  for (const auto& kind : kinds) {
    const std::string whole = folder / ("whole" + kind.ending), merged = folder / ("merged" + kind.ending);
    const Outcome one = run(with({"fit", "-o", whole}, kind.options));
    ASSERT_EQ(one.status, 0) << one.err;
    Words merge = {"merge"};
    for (const std::string k : {"3", "1", "2"}) {
      merge.push_back(folder / (k + ".json"));
      const Outcome part = run(with({"fit", "-o", merge.back(), "--part", k + "/3"}, kind.options));
      ASSERT_EQ(part.status, 0) << part.err;
    }
    const Outcome joined = run(with(merge, {"-o", merged}));
    ASSERT_EQ(joined.status, 0) << joined.err;
    EXPECT_TRUE(contents(whole) == contents(merged)) << kind.options[1] << kind.ending;
  }
  // The parts are now those of the samples.
  const auto refused = [&](const Words& command, const std::string& why) {
    const Outcome r = run(command);
    EXPECT_NE(r.status, 0);
    EXPECT_NE(r.err.find(why), std::string::npos) << r.err;
    EXPECT_FALSE(fs::exists(folder / "none.json"));
  };
  const std::string none = folder / "none.json", first = folder / "1.json", second = folder / "2.json";
  refused({"merge", first, second, "-o", none}, "part 3 is missing");
  refused({"merge", first, first, "-o", none}, "once more");
  refused({"merge", folder / "whole.json", "-o", none}, "no part of a fit");
  refused({"merge", first, second, "-o", none, "--drop", "1"}, "--drop");
  ASSERT_EQ(run({"fit", "-o", second, "--part", "2/3", "--size", "4"}).status, 0);
  refused({"merge", first, second, "-o", none}, "other settings");
  const std::string text = contents(first);
  for (std::size_t cut : {text.size() / 2, text.size() - 3}) {
    std::ofstream(first) << text.substr(0, cut);
    refused({"merge", first, "-o", none}, "no part of a fit");
  }
  for (const auto& [from, to, why] : {std::tuple{"\"samples\"", "\"x; int y\"", "other characters"},
                                      {"\"classic\"", "\"flat\"", "layout"},
                                      {"\"size\":4", "\"size\":1", "size"},
                                      {"\"part\":\"1/3\"", "\"part\":\"4/3\"", "damaged"}}) {
    std::string changed = text;
    ASSERT_NE(changed.find(from), std::string::npos) << from;
    changed.replace(changed.find(from), std::string(from).size(), to);
    std::ofstream(first) << changed;
    refused({"merge", first, "-o", none}, why);
  }
  std::string damaged = text;
  damaged.replace(damaged.find("[["), 2, "[[\"x\",");
  std::ofstream(first) << damaged;
  refused({"merge", first, "-o", none}, "damaged");
  refused({"fit", "--part", "1/2", "-o", folder / "none.h"}, ".json");
  refused({"fit", "--part", "1/2", "-o", none, "--report"}, "--report");
  refused({"fit", "--part", "1/2", "-o", none, "--fresnel-lobe"}, "--fresnel-lobe");
}

TEST_F(Program, FitGoesOnAfterAKill) {
  const std::string whole = folder / "whole.json", killed = folder / "killed.json", kept = killed + ".part";
  const Words options = {"--size", "24", "--threads", "1"};
  ASSERT_EQ(run(with({"fit", "-o", whole}, options)).status, 0);
  const auto size = [&] { return fs::exists(kept) ? fs::file_size(kept) : 0; };
  std::uintmax_t before = 100;
  int kills = 0;
  for (; kills < 3; ++kills) {
    const Child child = start(with({"fit", "-o", killed, "--resume"}, options), [] {});
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(100);
    while (size() <= before && waitpid(child.pid, nullptr, WNOHANG) == 0 && std::chrono::steady_clock::now() < end)
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    kill(child.pid, SIGKILL);
    finish(child);
    if (!fs::exists(kept)) break;
    EXPECT_GT(size(), before) << "finished columns were lost";
    before = size();
    EXPECT_FALSE(fs::exists(killed));
  }
  ASSERT_EQ(kills, 3) << "the fit is too short for this machine";
  // Columns of another lobe are not taken up.
  const std::string columns = contents(kept), other = folder / "other.json";
  const Outcome again = run(with({"fit", "-o", killed, "--resume"}, options));
  ASSERT_EQ(again.status, 0) << again.err;
  EXPECT_TRUE(contents(killed) == contents(whole));
  EXPECT_FALSE(fs::exists(kept));
  std::ofstream(kept, std::ios::binary) << columns;
  const Words sheen = {"--lobe", "charlie", "--size", "6"};
  ASSERT_EQ(run(with({"fit", "-o", killed, "--resume"}, sheen)).status, 0);
  ASSERT_EQ(run(with({"fit", "-o", other}, sheen)).status, 0);
  EXPECT_TRUE(contents(killed) == contents(other));
}

}  // namespace
}  // namespace steradian::fit_program_test
