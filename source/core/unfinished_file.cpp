#include "core/unfinished_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "core/files.h"
#include "steradian/error.h"

namespace steradian {
namespace {

constexpr std::string_view kUnfinished = "steradpt";  // the file begins with it and the fingerprint of the identity

#if defined(_WIN32)
constexpr int kAppend = O_WRONLY | O_CREAT | O_BINARY | O_NOINHERIT;
#else
constexpr int kAppend = O_WRONLY | O_CREAT | O_CLOEXEC;
#endif

struct PieceHead {
  std::uint64_t number, bytes;
  Fingerprint contents;
};

template <class T>
std::string_view bytes_in(const T& value) {
  return {reinterpret_cast<const char*>(&value), sizeof value};
}

// A piece under another number is another one.
Fingerprint fingerprint_of_piece(std::uint64_t number, std::string_view bytes) {
  return fingerprint(&number, sizeof number) ^ fingerprint(bytes.data(), bytes.size());
}

}  // namespace

UnfinishedFile::UnfinishedFile(const std::string& path, std::string_view identity) : path_(path) {
  const Fingerprint mine = fingerprint(identity.data(), identity.size());
  std::uint64_t good = 0;
  {
    std::ifstream file(path, std::ios::binary);
    char start[kUnfinished.size()] = {};
    Fingerprint theirs = 0;
    file.read(start, sizeof start);
    file.read(reinterpret_cast<char*>(&theirs), sizeof theirs);
    if (file && std::string_view(start, sizeof start) == kUnfinished && theirs == mine) {
      good = sizeof start + sizeof theirs;
      std::error_code unknown;
      const std::uint64_t size = std::filesystem::file_size(path, unknown);
      PieceHead head{};
      while (file.read(reinterpret_cast<char*>(&head), sizeof head)) {
        // A piece that was cut off, or damaged, ends the list.
        if (head.bytes > size - good - sizeof head) break;
        std::string contents(head.bytes, '\0');
        if (!file.read(contents.data(), static_cast<std::streamsize>(head.bytes)) ||
            fingerprint_of_piece(head.number, contents) != head.contents)
          break;
        good += sizeof head + head.bytes;
        known_[head.number] = std::move(contents);
      }
    }
  }
  descriptor_ = open(path.c_str(), kAppend, 0644);
  if (descriptor_ < 0 || ftruncate(descriptor_, static_cast<off_t>(good)) != 0 || lseek(descriptor_, 0, SEEK_END) < 0)
    throw Error(path, std::string("cannot keep what is finished: ") + std::strerror(errno), "choose another folder, or leave out --resume");
  if (good == 0) write_all(descriptor_, std::string(kUnfinished) + std::string(bytes_in(mine)), path_);
}

UnfinishedFile::~UnfinishedFile() {
  if (descriptor_ >= 0) close(descriptor_);
}

std::optional<std::string_view> UnfinishedFile::find(std::uint64_t number) const {
  const auto found = known_.find(number);
  if (found == known_.end()) return std::nullopt;
  return found->second;
}

void UnfinishedFile::add(std::uint64_t number, std::string_view bytes) {
  const PieceHead head{number, bytes.size(), fingerprint_of_piece(number, bytes)};
  std::string all(bytes_in(head));
  all += bytes;
  const std::lock_guard lock(mutex_);
  write_all(descriptor_, all, path_);
}

void UnfinishedFile::remove() {
  close(descriptor_);
  descriptor_ = -1;
  unlink(path_.c_str());
}

}  // namespace steradian
