// UnfinishedRun: a file beside the output that holds the finished blocks of a run, so that the run can go on after it was killed.
#pragma once

#include <cstdint>
#include <map>
#include <mutex>
#include <string>
#include <string_view>

#include "core/fingerprint.h"

namespace steradian {

class UnfinishedRun {
 public:
  // Reads the blocks that are there, up to the first damaged one. Blocks of a run with another identity are left out and overwritten.
  //
  //   identity  fingerprint of everything on which the blocks depend
  UnfinishedRun(const std::string& path, Fingerprint identity);
  ~UnfinishedRun();
  UnfinishedRun(const UnfinishedRun&) = delete;
  UnfinishedRun& operator=(const UnfinishedRun&) = delete;

  // The bytes of a block that an earlier run has finished; null: none.
  const std::string* find(std::uint64_t number) const;
  // Appends a block. Any thread may call it.
  void add(std::uint64_t number, std::string_view bytes);
  // The run is done: removes the file.
  void remove();

 private:
  const std::string path_;
  int descriptor_ = -1;
  std::mutex mutex_;
  std::map<std::uint64_t, std::string> known_;
};

}  // namespace steradian
