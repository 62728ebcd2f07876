#include "core/unfinished_file.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>

#include "steradian/error.h"

namespace steradian::unfinished_file_test {
namespace {

std::string bytes_at(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

TEST(UnfinishedFile, KeepsWholePiecesOfTheSameRun) {
  const std::string path = testing::TempDir() + "/pieces.part";
  std::filesystem::remove(path);
  {
    UnfinishedFile first(path, "a run");
    first.add(7, "seven");
    first.add(3, "");
    first.add(9, "the last piece");
    EXPECT_FALSE(first.find(7)) << "a run knows its own pieces";
  }
  const std::string all = bytes_at(path);
  // Cut off or damaged at any byte, it holds the pieces before that byte and nothing else.
  for (std::size_t cut = 0; cut <= all.size(); ++cut)
    for (const bool flips : {false, true}) {
      if (flips && cut == all.size()) continue;
      std::string damaged = flips ? all : all.substr(0, cut);
      if (flips) damaged[cut] = static_cast<char>(damaged[cut] ^ 16);
      std::ofstream(path, std::ios::binary) << damaged;
      UnfinishedFile second(path, "a run");
      const std::size_t seven = 16 + 24 + 5, three = seven + 24;
      EXPECT_EQ(second.find(7).has_value(), cut >= seven) << cut << flips;
      EXPECT_EQ(second.find(3).has_value(), cut >= three) << cut << flips;
      EXPECT_EQ(second.find(9).has_value(), cut >= all.size()) << cut << flips;
      if (cut >= seven) {
        EXPECT_EQ(second.find(7), "seven");
      }
      second.add(11, "more");
      EXPECT_EQ(UnfinishedFile(path, "a run").find(11), "more") << cut << flips;
    }
  std::ofstream(path, std::ios::binary) << all;
  UnfinishedFile other(path, "another run");
  EXPECT_FALSE(other.find(7));
  other.remove();
  EXPECT_FALSE(std::filesystem::exists(path));
  EXPECT_THROW(UnfinishedFile("/no such folder/x.part", "a run"), Error);
}

}  // namespace
}  // namespace steradian::unfinished_file_test
