// The program as a process: streams, exit codes, help.
#include <algorithm>
#include <chrono>
#include <csignal>
#include <nlohmann/json.hpp>
#include <regex>
#include <sstream>
#include <thread>

#include "program.h"

namespace steradian::program_test {
namespace {

using nlohmann::json;

std::string query(int i) {
  return R"({"light":{"type":"rect","center":[0,2,0],"x":[1,0,0],"y":[0,0,1],"radiance":)" + std::to_string(i) +
         R"(},"position":[0,0,0],"normal":[0,1,0],"material":{"brdf":"lambert"}})";
}

TEST_F(Program, EvalKeepsTheOrderSkipsBlankLinesAndExitsOneAfterAWrongLine) {
  const Outcome good = run({"eval"}, query(1) + "\n\n" + query(2) + "\r\n  \t\n" + query(3));
  EXPECT_EQ(good.status, 0) << good.err;
  std::istringstream lines(good.out);
  std::string line;
  int n = 0;
  double first = 0;
  while (std::getline(lines, line)) {
    const double x = json::parse(line)["radiance"][0];
    if (++n == 1) first = x;
    EXPECT_NEAR(x, n * first, 1e-15 * n);
  }
  EXPECT_EQ(n, 3);

  const Outcome mixed = run({"eval"}, query(1) + "\nnonsense\n" + query(2) + "\n");
  EXPECT_EQ(mixed.status, 1);
  EXPECT_NE(mixed.out.find("}\n{\"error\":\"not JSON"), std::string::npos) << mixed.out;
  EXPECT_EQ(std::count(mixed.out.begin(), mixed.out.end(), '\n'), 3);
}

TEST_F(Program, EvalReadsAndWritesFilesAndAnEmptyStream) {
  std::ofstream(folder / "queries") << query(1) << "\n";
  const std::string answers = folder / "answers";
  const Outcome files = run({"eval", folder / "queries", "-o", answers});
  EXPECT_EQ(files.status, 0) << files.err;
  EXPECT_EQ(files.out, "");
  EXPECT_TRUE(json::parse(contents(answers)).contains("radiance"));
  const Outcome empty = run({"eval", "-"});
  EXPECT_EQ(empty.status, 0);
  EXPECT_EQ(empty.out, "");
}

TEST_F(Program, EvalSaysWhatItCannotReadOrWrite) {
  const Outcome missing = run({"eval", "/no/such/file"});
  EXPECT_EQ(missing.status, 1);
  EXPECT_NE(missing.err.find("/no/such/file"), std::string::npos) << missing.err;
  const Outcome full = run({"eval", "-o", "/dev/full"}, query(1));
  EXPECT_EQ(full.status, 1);
  EXPECT_NE(full.err.find("disk is full"), std::string::npos) << full.err;
  const Outcome folder_missing = run({"eval", "-o", "/no/such/folder/file"}, query(1));
  EXPECT_EQ(folder_missing.status, 1);
  EXPECT_NE(folder_missing.err.find("folder does not exist"), std::string::npos) << folder_missing.err;
}

TEST_F(Program, EvalStreamsInConstantMemory) {
  // 300,000 lines are 50 MB in and 25 MB out.
  {
    std::ofstream in(folder / "in", std::ios::binary);
    for (int i = 0; i < 300000; ++i) in << query(1 + i % 1000) << '\n';
  }
  const Outcome r = run({"eval"});
  EXPECT_EQ(r.status, 0) << r.err;
  EXPECT_EQ(std::count(r.out.begin(), r.out.end(), '\n'), 300000);
#if !defined(__SANITIZE_ADDRESS__)  // a sanitizer keeps freed memory
  EXPECT_LT(r.peak_kib, 64 * 1024);
#endif
}

TEST_F(Program, EvalTakesLongLinesAndRefusesThoseOverTheLimit) {
  std::string spaces = query(1);
  spaces.insert(spaces.size() - 1, 3'000'000, ' ');
  const Outcome r = run({"eval"}, spaces + "\n" + std::string(66u << 20, ' ') + "x\n" + query(2) + "\n");
  EXPECT_EQ(r.status, 1);
  std::istringstream lines(r.out);
  std::string a, b, c;
  std::getline(lines, a);
  std::getline(lines, b);
  std::getline(lines, c);
  EXPECT_NE(a.find("radiance"), std::string::npos) << a;
  EXPECT_NE(b.find("longer than 64 MiB"), std::string::npos) << b;
  EXPECT_NE(c.find("radiance"), std::string::npos) << c;
}

TEST_F(Program, HelpVersionAndWrongUse) {
  const Outcome help = run({"eval", "--help"});
  EXPECT_EQ(help.status, 0);
  for (const char* text : {"--spp", "[256]", "--seed", "Input and output"})
    EXPECT_NE(help.out.find(text), std::string::npos) << text << "\n" << help.out;
  const Outcome version = run({"--version"});
  EXPECT_EQ(version.status, 0);
  EXPECT_EQ(version.out.rfind("steradian ", 0), 0u) << version.out;
  EXPECT_EQ(run({}).status, 2);
  EXPECT_EQ(run({"frobnicate"}).status, 2);
  EXPECT_EQ(run({"eval", "--spp", "0"}).status, 2);
  EXPECT_EQ(run({"eval", "--method", "magic"}).status, 2);
}

// One line an option, of at most 100 characters. Rare options are those of --help-all alone.
TEST_F(Program, HelpHasALineAnOption) {
  for (const char* verb : {"render", "bake", "view", "compare", "diff", "eval", "methods", "solve", "fit", "viewfactor", "merge", "info",
                           "bench", "completion", "man"})
    for (const char* flag : {"--help", "--help-all"}) {
      const Outcome help = run({verb, flag});
      EXPECT_EQ(help.status, 0) << verb;
      std::istringstream lines(help.out);
      for (std::string line; std::getline(lines, line);) {
        EXPECT_LE(line.size(), 100u) << verb << ": " << line;
        const std::size_t dash = line.find_first_not_of(' ');
        const bool is_option = dash != std::string::npos && line[dash] == '-' && line.compare(dash, 11, "--help-all ") != 0;
        EXPECT_TRUE(!is_option || line.find("  ", dash) != std::string::npos) << verb << ": " << line;
      }
    }
  const std::string few = run({"render", "--help"}).out, all = run({"render", "--help-all"}).out;
  for (const char* rare : {"--vpls", "--indirect-clamp", "--max-work"}) {
    EXPECT_EQ(few.find(rare), std::string::npos) << rare;
    EXPECT_NE(all.find(rare), std::string::npos) << rare;
  }
  EXPECT_NE(few.find("--help-all prints"), std::string::npos);
  EXPECT_NE(few.find("--occluders"), std::string::npos) << "the makers of drawings need it";
}

TEST_F(Program, MethodsListsTheTableOfMethods) {
  const json list = json::parse(run({"methods", "--json"}).out);
  const std::string table = run({"methods"}).out;
  EXPECT_GE(list.size(), 16u);
  for (const json& row : list) {
    EXPECT_NE(table.find(row["name"].get<std::string>()), std::string::npos);
    EXPECT_FALSE(row["error"].get<std::string>().empty());
  }
}

TEST_F(Program, InfoAndBenchSpeakJson) {
  const json info = json::parse(run({"info", "--json"}).out);
  for (const char* key : {"version", "compiler", "instruction_sets", "simd", "threads", "libraries"})
    EXPECT_TRUE(info.contains(key)) << key;
  const Outcome r = run({"bench", "--json", "--filter", "kernel/l", "--min-time", "0.01"});
  ASSERT_EQ(r.status, 0) << r.err;
  bool lambert = false;
  for (const json& one : json::parse(r.out)) {
    lambert |= one["name"] == "kernel/lambert/quad";
    for (const char* key : {"items", "ns_per_item", "median_ms", "runs"}) EXPECT_GT(one[key].get<double>(), 0) << one;
  }
  EXPECT_TRUE(lambert);
  // A scalar form comes first, so that the rows after it tell their ratio to it.
  const std::string rows = run({"bench", "--filter", "kernel/lambert/quad", "--min-time", "0.01"}).out;
  EXPECT_LT(rows.find("kernel/lambert/quad/scalar "), rows.find("x scalar"));
  EXPECT_LT(rows.find("kernel/lambert/quad/scalar "), rows.find("kernel/lambert/quad "));
  EXPECT_EQ(run({"bench", "--filter", "nothing"}).status, 1);

  const Outcome listed = run({"bench", "--list", "--filter", "kernel/l"});
  EXPECT_NE(listed.out.find("kernel/lambert"), std::string::npos) << listed.err;
  EXPECT_EQ(listed.out.find(' '), std::string::npos) << listed.out;
  // The answer to a misspelt name lists the nearest names, one per line, not all of them.
  const Outcome misspelt = run({"bench", "--filter", "kernal/lamber"});
  EXPECT_EQ(misspelt.status, 1);
  EXPECT_NE(misspelt.err.find("the nearest are\n  kernel/lambert"), std::string::npos) << misspelt.err;
  EXPECT_NE(misspelt.err.find("more: steradian bench --list"), std::string::npos) << misspelt.err;
  EXPECT_EQ(std::count(misspelt.err.begin(), misspelt.err.end(), '\n'), 14) << misspelt.err;
  std::istringstream lines(misspelt.err);
  for (std::string line; std::getline(lines, line);) EXPECT_LT(line.size(), 120u) << line;
  // Compared with itself nothing is a thousand times slower. Compared with a thousandth of its time everything is above 100.
  const std::string base = folder / "base.json";
  std::ofstream(base) << r.out;
  const std::vector<std::string> again = {"bench", "--filter", "kernel/l", "--min-time", "0.01", "--compare", base, "--fail-above"};
  const auto with = [&](const char* limit) {
    std::vector<std::string> arguments = again;
    arguments.push_back(limit);
    return run(arguments);
  };
  EXPECT_EQ(with("1000").status, 0);
  EXPECT_NE(with("1000").out.find("geometric mean"), std::string::npos);
  json faster = json::parse(r.out);
  for (json& one : faster) one["ns_per_item"] = one["ns_per_item"].get<double>() / 1000;
  std::ofstream(base) << faster;
  EXPECT_EQ(with("100").status, 1);
  std::ofstream(base) << "[]";
  EXPECT_EQ(with("100").status, 1);
}

// Standard error is a file here. Lines come a second apart at the least, and none repeats a percentage; so a bound from the time is halved.
TEST_F(Program, ProgressIsALineASecondWithoutATerminal) {
  const std::string scene = test::kSourceDir + "/scenes/glossy_floor.glb";
  const std::vector<std::pair<std::string, std::vector<std::string>>> long_work = {
      {"fit ggx", {"fit", "--size", "24", "--threads", "1", "-o", folder / "x.json"}},
      {"compare: [a-z, ]+",  // a line may fall into any of its pictures
       {"compare", scene, "--methods", "ltc", "--size", "192x108", "--target-error", "0.03", "--threads", "1", "-o", folder / "report"}},
      {"bench", {"bench", "--filter", "kernel/lambert", "--min-time", "0.4"}}};
  for (const auto& [label, arguments] : long_work) {
    const auto begin = std::chrono::steady_clock::now();
    const Outcome r = run(arguments);
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    EXPECT_EQ(r.status, 0) << r.err;
    const std::regex form(label + " +[0-9]+\\.[0-9] %  [0-9]+ s, [0-9]+ s left");
    std::istringstream lines(r.err);
    int count = 0;
    for (std::string line; std::getline(lines, line); ++count) EXPECT_TRUE(std::regex_match(line, form)) << line;
    EXPECT_LE(count, seconds) << label;
    EXPECT_GE(count, (std::min(seconds, r.cpu_seconds) - 2) / 2) << label;
  }
}

// A method that takes minutes is left out. The other rows are those of a comparison without it, but for their times.
TEST_F(Program, CompareNamesWhatDoesNotFitIntoItsTime) {
  const auto compare = [&](const std::string& scene, const std::string& methods, const std::vector<std::string>& more) {
    std::vector<std::string> arguments = {"compare", test::kSourceDir + "/scenes/" + scene, "-o", folder / "report", "--methods", methods};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run(arguments);
  };
  const auto rows = [&] {
    json report = json::parse(contents(folder / "report" / "report.json"));
    for (json& row : report["methods"]) row.erase("ms"), row.erase("passes");
    return std::pair{report["methods"], report["did_not_fit"]};
  };
  const std::vector<std::string> small = {"--size", "96x54", "--target-error", "0.1", "--spp", "1000000"};
  std::vector<std::string> limited = small, late = small, never = small;
  limited.insert(limited.end(), {"--time-limit", "8"});
  late.insert(late.end(), {"--target-error", "0.00001", "--time-limit", "1"});
  late.erase(late.begin() + 2, late.begin() + 4);
  never.insert(never.end(), {"--time-limit", "0.5"});

  EXPECT_EQ(compare("glossy_floor.glb", "ltc,closed-form", small).status, 0);
  const auto [whole, none] = rows();
  EXPECT_TRUE(none.empty());
  const Outcome r = compare("glossy_floor.glb", "sampled,ltc,closed-form", limited);
  EXPECT_EQ(r.status, 0) << r.err;
  EXPECT_NE(r.out.find("\ndid not fit into 8 s: sampled\n"), std::string::npos) << r.out;
  EXPECT_EQ(rows(), (std::pair{whole, json({"sampled"})}));
  EXPECT_FALSE(fs::exists(folder / "report" / "sampled.exr"));

  const Outcome no_reference = compare("glossy_floor.glb", "ltc", late);
  EXPECT_EQ(no_reference.status, 1);
  EXPECT_NE(no_reference.err.find("the reference does not fit into 1 s"), std::string::npos) << no_reference.err;
  const Outcome no_method = compare("glossy_floor.glb", "sampled", never);
  EXPECT_EQ(no_method.status, 1);
  EXPECT_NE(no_method.err.find("no method fits into half of 0.5 s"), std::string::npos) << no_method.err;
  EXPECT_EQ(compare("glossy_floor.glb", "ltc", {"--time-limit", "-1"}).status, 2);

  const Outcome plane = compare("plane/room.svg", "sampled,exact", {"--size", "64x64", "--spp", "65536", "--time-limit", "6"});
  EXPECT_NE(plane.out.find("\ndid not fit into 6 s: sampled\n"), std::string::npos) << plane.out << plane.err;
}

TEST_F(Program, BenchFlushesEachLine) {
  const Child child = start({"bench", "--filter", "kernel/lambert", "--min-time", "2"}, [] {});
  const auto first_row = [&] { return contents(folder / "out").find("kernel/lambert/quad/scalar ") != std::string::npos; };
  for (int i = 0; i < 600 && !first_row(); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(50));
  const bool came = first_row();
  EXPECT_EQ(kill(child.pid, SIGTERM), 0);
  EXPECT_EQ(finish(child).status, 128 + SIGTERM);  // it had not come to its end
  EXPECT_TRUE(came);
}

TEST_F(Program, SaysThatThereAreNoCaustics) {
  for (const bool glass : {false, true}) {
    const std::string scene = test::kSourceDir + (glass ? "/scenes/glass.glb" : "/scenes/gallery.glb");
    const json facts = json::parse(run({"info", scene, "--json"}).out);
    EXPECT_EQ(facts["not_computed"], glass ? json({"caustics of glass"}) : json::array());
    const Outcome r = run({"render", scene, "-o", folder / "a.exr", "--size", "16x9"});
    EXPECT_EQ(r.status, 0) << r.err;
    EXPECT_EQ(r.err.find("no caustics") != std::string::npos, glass) << r.err;
  }
}

}  // namespace
}  // namespace steradian::program_test
