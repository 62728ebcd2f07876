// UnfinishedFile: a file beside an output that holds the finished pieces of a run, so that the run can go on after it was killed.
#pragma once

#include <cstdint>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>

#include "core/fingerprint.h"

namespace steradian {

class UnfinishedFile {
 public:
  // identity: all on which a piece depends. Reads the pieces that are there, up to the first damaged one. Pieces of another identity are
  // left out and overwritten.
  UnfinishedFile(const std::string& path, std::string_view identity);
  ~UnfinishedFile();
  UnfinishedFile(const UnfinishedFile&) = delete;
  UnfinishedFile& operator=(const UnfinishedFile&) = delete;

  // The bytes of a piece; none if it is not there.
  std::optional<std::string_view> find(std::uint64_t number) const;
  // Appends a piece. Any thread may call it.
  void add(std::uint64_t number, std::string_view bytes);
  // The run is done: removes the file.
  void remove();

 private:
  std::string path_;
  int descriptor_ = -1;
  std::mutex mutex_;
  std::map<std::uint64_t, std::string> known_;
};

}  // namespace steradian
