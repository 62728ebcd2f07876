#include "core/unfinished_run.h"

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

constexpr char kRunMagic[9] = "steradun";

struct BlockHead {
  std::uint64_t number, bytes;
  Fingerprint contents;
};

}  // namespace

UnfinishedRun::UnfinishedRun(const std::string& path, Fingerprint identity) : path_(path) {
  std::uint64_t good = 0;
  {
    std::ifstream file(path, std::ios::binary);
    char magic[8] = {};
    Fingerprint theirs = 0;
    file.read(magic, sizeof magic);
    file.read(reinterpret_cast<char*>(&theirs), sizeof theirs);
    if (file && std::memcmp(magic, kRunMagic, sizeof magic) == 0 && theirs == identity) {
      good = sizeof magic + sizeof theirs;
      std::error_code unknown;
      const std::uint64_t size = std::filesystem::file_size(path, unknown);
      BlockHead head{};
      while (file.read(reinterpret_cast<char*>(&head), sizeof head)) {
        // A block that was cut off, or damaged, ends the list.
        if (head.bytes > size - good - sizeof head) break;
        std::string bytes(head.bytes, '\0');
        if (!file.read(bytes.data(), static_cast<std::streamsize>(head.bytes)) || fingerprint(bytes.data(), head.bytes) != head.contents)
          break;
        known_[head.number] = std::move(bytes);
        good += sizeof head + head.bytes;
      }
    }
  }
  descriptor_ = open(path.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0644);
  if (descriptor_ < 0 || ftruncate(descriptor_, static_cast<off_t>(good)) != 0 || lseek(descriptor_, 0, SEEK_END) < 0)
    throw Error(path, std::string("cannot write what is finished: ") + std::strerror(errno),
                "choose another folder, or leave out --resume");
  if (good == 0) {
    std::string start(kRunMagic, 8);
    start.append(reinterpret_cast<const char*>(&identity), sizeof identity);
    write_all(descriptor_, start, path_);
  }
}

UnfinishedRun::~UnfinishedRun() {
  if (descriptor_ >= 0) close(descriptor_);
}

const std::string* UnfinishedRun::find(std::uint64_t number) const {
  const auto found = known_.find(number);
  return found == known_.end() ? nullptr : &found->second;
}

void UnfinishedRun::add(std::uint64_t number, std::string_view bytes) {
  const BlockHead head{number, bytes.size(), fingerprint(bytes.data(), bytes.size())};
  std::string all(reinterpret_cast<const char*>(&head), sizeof head);
  all += bytes;
  const std::lock_guard lock(mutex_);
  write_all(descriptor_, all, path_);
}

void UnfinishedRun::remove() {
  close(descriptor_);
  descriptor_ = -1;
  unlink(path_.c_str());
}

}  // namespace steradian
