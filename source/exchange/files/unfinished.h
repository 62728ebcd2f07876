// UnfinishedFactors: a file beside the output that holds the finished blocks of a run, so that the run can go on after it was killed.
#pragma once

#include <map>
#include <mutex>
#include <string>

#include "core/fingerprint.h"
#include "exchange/files/matrix_files.h"

namespace steradian::exchange {

class UnfinishedFactors {
 public:
  // Reads the blocks that are there, up to the first damaged one. Blocks of other faces, settings or versions are left out and overwritten.
  UnfinishedFactors(const std::string& path, const StoredRun& run);
  ~UnfinishedFactors();
  UnfinishedFactors(const UnfinishedFactors&) = delete;
  UnfinishedFactors& operator=(const UnfinishedFactors&) = delete;

  // Fills the block that begins at its first_row; false if it is not there.
  bool find(ExchangeBlock& block) const;
  // Appends a block. Any thread may call it.
  void add(const ExchangeBlock& block);
  // The run is done: removes the file.
  void remove();

 private:
  std::string path_;
  int descriptor_ = -1;
  std::mutex mutex_;
  std::map<std::size_t, ExchangeBlock> known_;
};

}  // namespace steradian::exchange
