#include "core/cache_file.h"

#include <gtest/gtest.h>

#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <optional>

#include "core/budget.h"
#include "core/files.h"

namespace steradian::cache_file_test {

// Sets environment variables, and restores them at its end.
class EnvironmentVariable {
 public:
  EnvironmentVariable(const char* name, const char* value) : name_(name) {
    if (const char* before = std::getenv(name)) before_ = before;
    value != nullptr ? setenv(name, value, 1) : unsetenv(name);
  }
  ~EnvironmentVariable() { before_ ? setenv(name_, before_->c_str(), 1) : unsetenv(name_); }
  EnvironmentVariable(const EnvironmentVariable&) = delete;
  EnvironmentVariable& operator=(const EnvironmentVariable&) = delete;

 private:
  const char* name_;
  std::optional<std::string> before_;
};

std::string stored(const std::string& file) {
  Budget budget;
  const Bytes bytes = read_file(file, file, budget);
  return {bytes.begin(), bytes.end()};
}

class CacheFile : public testing::Test {
 protected:
  const std::string folder_ = testing::TempDir() + "cache-" + std::to_string(getpid());
  const std::string file_ = folder_ + "/deeper/key";
  const std::vector<char> bytes_ = {'a', 'b', '\0', 'c', 'd', 'e', 'f', 'g', 'h'};
  void TearDown() override { std::filesystem::remove_all(folder_); }
};

TEST_F(CacheFile, ReturnsWhatWasStoredWithItsKey) {
  EXPECT_TRUE(read_cache_file(file_, "key").empty()) << "there is no file yet";
  write_cache_file(file_, "key", bytes_);
  EXPECT_EQ(read_cache_file(file_, "key"), bytes_);
  EXPECT_TRUE(read_cache_file(file_, "another").empty()) << "the bytes of another key";
}

TEST_F(CacheFile, IgnoresDamagedAndForeignFiles) {
  write_cache_file(file_, "key", bytes_);
  const std::string good = stored(file_);
  for (std::size_t i = 0; i < good.size(); ++i) {
    std::string bad = good;
    bad[i] = static_cast<char>(bad[i] ^ 1);
    write_file(file_, bad);
    EXPECT_TRUE(read_cache_file(file_, "key").empty()) << "byte " << i << " is another";
    write_file(file_, good.substr(0, i));
    EXPECT_TRUE(read_cache_file(file_, "key").empty()) << "ends after " << i << " bytes";
  }
  write_file(file_, good + "x");
  EXPECT_TRUE(read_cache_file(file_, "key").empty()) << "a byte more";
  write_file(file_, good);
  EXPECT_EQ(read_cache_file(file_, "key"), bytes_) << "the test damages a good file";
}

TEST_F(CacheFile, AFolderThatCannotBeMadeIsNoError) {
  write_cache_file("/dev/null/steradian/key", "key", bytes_);
  EXPECT_TRUE(read_cache_file("/dev/null/steradian/key", "key").empty());
}

TEST_F(CacheFile, IsInTheUsersFolderUnlessAVariableSaysAnother) {
  const EnvironmentVariable home("HOME", "/home/somebody");
  {
    const EnvironmentVariable off("STERADIAN_TEST_CACHE", "");
    EXPECT_EQ(cache_file("STERADIAN_TEST_CACHE", "key"), "");
  }
  {
    const EnvironmentVariable given("STERADIAN_TEST_CACHE", "/given");
    EXPECT_EQ(cache_file("STERADIAN_TEST_CACHE", "key"), "/given/key");
  }
  const EnvironmentVariable none("STERADIAN_TEST_CACHE", nullptr);
  {
    const EnvironmentVariable caches("XDG_CACHE_HOME", "/caches");
    EXPECT_EQ(cache_file("STERADIAN_TEST_CACHE", "key"), "/caches/steradian/key");
  }
  const EnvironmentVariable unset("XDG_CACHE_HOME", nullptr);
  EXPECT_EQ(cache_file("STERADIAN_TEST_CACHE", "key"), "/home/somebody/.cache/steradian/key");
  const EnvironmentVariable homeless("HOME", nullptr);
  EXPECT_EQ(cache_file("STERADIAN_TEST_CACHE", "key"), "");
}

}  // namespace steradian::cache_file_test
