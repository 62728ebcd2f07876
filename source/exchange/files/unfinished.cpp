#include "exchange/files/unfinished.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string_view>

#include "core/files.h"
#include "exchange/files/npz.h"
#include "steradian/error.h"

namespace steradian::exchange {
namespace {

constexpr char kMagic[9] = "steradvf";

// Everything on which an entry depends.
Fingerprint fingerprint_of(const StoredRun& run) {
  std::string all = run.run.version + "|" + std::to_string(run.run.obstruction) + "|" + std::to_string(run.run.part) + "/" +
                    std::to_string(run.run.parts);
  all.append(reinterpret_cast<const char*>(&run.run.eps), sizeof run.run.eps);
  for (const ViewFactorFace& face : run.faces) {
    all += face.name + "|" + std::to_string(face.outline.size());
    all.append(bytes_of(face.outline));
    for (const auto& hole : face.holes) {
      all += std::to_string(hole.size());
      all.append(bytes_of(hole));
    }
  }
  all.append(bytes_of(run.obstacles));
  return fingerprint(all.data(), all.size());
}

// The sizes of a block, and the fingerprint of its lists.
struct StoredHead {
  std::uint64_t first_row, rows, entries;
  Fingerprint contents;
};

std::string contents_of(const ExchangeBlock& b) {
  std::string all(bytes_of(b.row_start));
  all += bytes_of(b.columns);
  all += bytes_of(b.values);
  all += bytes_of(b.errors);
  return all;
}

template <class T>
std::string_view take_list(std::string_view from, std::uint64_t count, std::vector<T>& to) {
  to.resize(count);
  std::memcpy(to.data(), from.data(), count * sizeof(T));
  return from.substr(count * sizeof(T));
}

}  // namespace

UnfinishedFactors::UnfinishedFactors(const std::string& path, const StoredRun& run) : path_(path) {
  const Fingerprint mine = fingerprint_of(run);
  std::uint64_t good = 0;
  {
    std::ifstream file(path, std::ios::binary);
    char magic[8] = {};
    Fingerprint theirs = 0;
    file.read(magic, sizeof magic);
    file.read(reinterpret_cast<char*>(&theirs), sizeof theirs);
    if (file && std::memcmp(magic, kMagic, sizeof magic) == 0 && theirs == mine) {
      good = sizeof magic + sizeof theirs;
      std::error_code unknown;
      const std::uint64_t size = std::filesystem::file_size(path, unknown);
      StoredHead head{};
      while (file.read(reinterpret_cast<char*>(&head), sizeof head)) {
        // A block that was cut off, or damaged, ends the list.
        const std::uint64_t left = size - good - sizeof head;
        if (head.rows > left || head.entries > left / 16) break;
        const std::uint64_t bytes = (head.rows + 1) * 8 + head.entries * 16;
        if (bytes > left) break;
        std::string contents(bytes, '\0');
        if (!file.read(contents.data(), static_cast<std::streamsize>(bytes)) || fingerprint(contents.data(), bytes) != head.contents) break;
        ExchangeBlock b;
        b.first_row = head.first_row;
        std::string_view rest = take_list(contents, head.rows + 1, b.row_start);
        rest = take_list(rest, head.entries, b.columns);
        rest = take_list(rest, head.entries, b.values);
        take_list(rest, head.entries, b.errors);
        known_[b.first_row] = std::move(b);
        good += sizeof head + bytes;
      }
    }
  }
  descriptor_ = open(path.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0644);
  if (descriptor_ < 0 || ftruncate(descriptor_, static_cast<off_t>(good)) != 0 || lseek(descriptor_, 0, SEEK_END) < 0)
    throw Error(path, std::string("cannot write the finished rows: ") + std::strerror(errno),
                "choose another folder, or leave out --resume");
  if (good == 0) {
    std::string start(kMagic, 8);
    start.append(reinterpret_cast<const char*>(&mine), sizeof mine);
    write_all(descriptor_, start, path_);
  }
}

UnfinishedFactors::~UnfinishedFactors() {
  if (descriptor_ >= 0) close(descriptor_);
}

bool UnfinishedFactors::find(ExchangeBlock& block) const {
  const auto found = known_.find(block.first_row);
  if (found == known_.end()) return false;
  block = found->second;
  return true;
}

void UnfinishedFactors::add(const ExchangeBlock& block) {
  const std::string contents = contents_of(block);
  const StoredHead head{block.first_row, block.rows(), block.columns.size(), fingerprint(contents.data(), contents.size())};
  std::string all(reinterpret_cast<const char*>(&head), sizeof head);
  all += contents;
  const std::lock_guard lock(mutex_);
  write_all(descriptor_, all, path_);
}

void UnfinishedFactors::remove() {
  close(descriptor_);
  descriptor_ = -1;
  unlink(path_.c_str());
}

}  // namespace steradian::exchange
