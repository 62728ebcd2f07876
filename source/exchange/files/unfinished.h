// UnfinishedFactors: the finished blocks of rows of an unfinished run.
#pragma once

#include <string>

#include "core/unfinished_run.h"
#include "exchange/files/matrix_files.h"

namespace steradian::exchange {

class UnfinishedFactors {
 public:
  // Rows of other faces, settings or versions are left out and overwritten.
  UnfinishedFactors(const std::string& path, const StoredRun& run);

  // Fills the block that begins at its first_row; false if it is not there.
  bool find(ExchangeBlock& block) const;
  // Appends a block. Any thread may call it.
  void add(const ExchangeBlock& block);
  // The run is done: removes the file.
  void remove() { run_.remove(); }

 private:
  UnfinishedRun run_;
};

}  // namespace steradian::exchange
