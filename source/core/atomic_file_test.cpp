#include "core/files.h"

#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <iterator>
#include <sys/stat.h>

#include "steradian/error.h"

namespace steradian::atomic_file_test {
namespace {

namespace fs = std::filesystem;

std::string contents(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

class AtomicFiles : public testing::Test {
 protected:
  void SetUp() override {
    std::string name = (fs::temp_directory_path() / "steradian-XXXXXX").string();
    ASSERT_NE(mkdtemp(name.data()), nullptr);
    folder = name;
  }
  void TearDown() override { fs::remove_all(folder); }
  std::size_t count() const { return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder), fs::directory_iterator())); }
  fs::path folder;
};

// The message names the path and says what to do.
template <class F>
void expect_error(F action, const std::string& place, const std::string& hint) {
  try {
    action();
    ADD_FAILURE() << "no error for " << place;
  } catch (const Error& e) {
    EXPECT_EQ(e.place(), place);
    EXPECT_NE(e.hint().find(hint), std::string::npos) << e.what();
  }
}

TEST_F(AtomicFiles, AppearWhenCommittedAndReplaceTheOldOne) {
  const fs::path path = folder / "out.txt";
  std::ofstream(path) << "old";
  AtomicFile file(path.string());
  file.write("new ");
  file.write("text");
  EXPECT_EQ(contents(path), "old");
  file.commit();
  EXPECT_EQ(contents(path), "new text");
  EXPECT_EQ(count(), 1u);
}

TEST_F(AtomicFiles, LeaveNothingBehindWithoutACommit) {
  const fs::path path = folder / "out.txt";
  { AtomicFile(path.string()).write("half"); }
  EXPECT_EQ(count(), 0u);
}

TEST_F(AtomicFiles, FollowASymbolicLink) {
  std::ofstream(folder / "real.txt") << "old";
  fs::create_symlink("real.txt", folder / "link.txt");
  AtomicFile file((folder / "link.txt").string());
  file.write("new");
  file.commit();
  EXPECT_TRUE(fs::is_symlink(folder / "link.txt"));
  EXPECT_EQ(contents(folder / "real.txt"), "new");
}

// New files get the permissions that the umask allows; replaced files keep theirs. The process's umask is not changed.
TEST_F(AtomicFiles, HaveTheUsualPermissions) {
  const auto written = [&](const fs::path& path) {
    AtomicFile file(path.string());
    file.write("x");
    file.commit();
    return static_cast<unsigned>(fs::status(path).permissions());
  };
  const mode_t before = umask(027);
  EXPECT_EQ(written(folder / "new"), 0640u);
  fs::permissions(folder / "new", static_cast<fs::perms>(0604));
  EXPECT_EQ(written(folder / "new"), 0604u);
  EXPECT_EQ(umask(before), 027u);
  EXPECT_EQ(count(), 1u);
}

// Two files are written to one name at once: one of them wins, whole.
TEST_F(AtomicFiles, MayBeTwoOfOneName) {
  const fs::path path = folder / "out.txt";
  AtomicFile a(path.string()), b(path.string());
  a.write("aaaa");
  b.write("bbbb");
  a.commit();
  EXPECT_EQ(contents(path), "aaaa");
  b.commit();
  EXPECT_EQ(contents(path), "bbbb");
  EXPECT_EQ(count(), 1u);
}

// The folder shows nothing until the commit, so a killed program leaves nothing behind.
TEST_F(AtomicFiles, HaveNoNameUntilTheyAreWhole) {
  AtomicFile file((folder / "out.txt").string());
  file.write("half");
  EXPECT_EQ(count(), 0u);
}

TEST_F(AtomicFiles, SayWhatIsWrong) {
  const std::string missing = (folder / "no" / "out.txt").string();
  expect_error([&] { AtomicFile file(missing); }, missing, "folder does not exist");
  expect_error([&] { AtomicFile file(folder.string()); }, folder.string(), "name a file");
  expect_error(
      [] {
        AtomicFile file("/dev/full");
        file.write("x");
      },
      "/dev/full", "disk is full");
  EXPECT_TRUE(fs::is_character_file("/dev/full"));
}

TEST_F(AtomicFiles, AreJudgedWithoutATrace) {
  const std::string path = (folder / "out.txt").string(), missing = (folder / "no" / "out.txt").string();
  check_writable(path);
  check_writable("/dev/full");
  EXPECT_EQ(count(), 0u);
  write_file(path, "before");
  check_writable(path);
  EXPECT_EQ(contents(path), "before");
  expect_error([&] { check_writable(missing); }, missing, "folder does not exist");
  expect_error([&] { check_writable(folder.string()); }, folder.string(), "name a file");
}

}  // namespace
}  // namespace steradian::atomic_file_test
