// Repeats the findings of fuzzers and their seeds: tests/fuzz/corpus/TARGET/*.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <vector>

#include "paths.h"
#include "targets.h"

namespace steradian::corpus_test {
namespace {

void run_all(const char* target, void (*run)(fuzz::Input)) {
  std::size_t files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(std::filesystem::path(test::kSourceDir) / "tests/fuzz/corpus" / target)) {
    std::ifstream file(entry.path(), std::ios::binary);
    const std::vector<char> bytes{std::istreambuf_iterator<char>(file), {}};
    SCOPED_TRACE(entry.path());
    EXPECT_NO_THROW(run({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()})) << entry.path();
    ++files;
  }
  EXPECT_GT(files, 0u) << "no corpus for " << target;
}

TEST(FuzzCorpus, Gltf) { run_all("gltf", fuzz::gltf); }
TEST(FuzzCorpus, Svg) { run_all("svg", fuzz::svg); }
TEST(FuzzCorpus, SvgFrame) { run_all("svg_frame", fuzz::svg_frame); }
TEST(FuzzCorpus, Eval) { run_all("eval", fuzz::eval); }
TEST(FuzzCorpus, Picture) { run_all("picture", fuzz::picture); }
TEST(FuzzCorpus, Texture) { run_all("texture", fuzz::texture); }
TEST(FuzzCorpus, Table) { run_all("table", fuzz::table); }
TEST(FuzzCorpus, Samples) { run_all("samples", fuzz::samples); }
TEST(FuzzCorpus, Factors) { run_all("factors", fuzz::factors); }
TEST(FuzzCorpus, Solve) { run_all("solve", fuzz::solve); }
TEST(FuzzCorpus, Profile) { run_all("profile", fuzz::profile); }

}  // namespace
}  // namespace steradian::corpus_test
