#include "core/atomic_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>

#include "steradian/error.h"

namespace steradian {
namespace {

std::string hint_for(int error) {
  switch (error) {
    case ENOSPC:
    case EDQUOT: return "the disk is full: free some space or choose another place";
    case ENOENT: return "the folder does not exist: make it first";
    case EACCES:
    case EPERM: return "the folder is not writable: choose another place";
    case EROFS: return "the disk is read-only: choose another place";
    case EISDIR: return "this is a folder: name a file in it";
    default: return "choose another place";
  }
}

std::string resolved(const std::string& path) {
  char* real = realpath(path.c_str(), nullptr);
  if (real == nullptr) return path;
  std::string result(real);
  std::free(real);
  return result;
}

// The permissions that open() would give; umask can only be read by setting it.
mode_t usual_mode(const struct stat* existing) {
  if (existing != nullptr) return existing->st_mode & 0777;
  const mode_t mask = umask(0);
  umask(mask);
  return 0666 & ~mask;
}

}  // namespace

void write_all(int descriptor, std::string_view bytes, const std::string& name) {
  while (!bytes.empty()) {
    const ssize_t n = ::write(descriptor, bytes.data(), bytes.size());
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) throw Error(name, std::string("cannot write: ") + std::strerror(errno), hint_for(errno));
    bytes.remove_prefix(static_cast<std::size_t>(n));
  }
}

AtomicFile::AtomicFile(const std::string& path) : path_(path), target_(resolved(path)) {
  struct stat existing {};
  const bool exists = stat(target_.c_str(), &existing) == 0;
  if (exists && S_ISDIR(existing.st_mode)) fail("cannot write", EISDIR);
  if (exists && !S_ISREG(existing.st_mode)) {
    direct_ = true;
    temporary_ = target_;
    descriptor_ = open(target_.c_str(), O_WRONLY | O_CLOEXEC);
    if (descriptor_ < 0) fail("cannot open", errno);
    return;
  }
  temporary_ = target_ + ".XXXXXX";
  descriptor_ = mkostemp(temporary_.data(), O_CLOEXEC);
  if (descriptor_ < 0) fail("cannot create", errno);
  fchmod(descriptor_, usual_mode(exists ? &existing : nullptr));
}

AtomicFile::~AtomicFile() { discard(); }

void AtomicFile::write(std::string_view bytes) { write_all(descriptor_, bytes, path_); }

void AtomicFile::commit() {
  const int closed = close(descriptor_);
  const int error = errno;
  descriptor_ = -1;
  if (closed != 0) {
    discard();
    fail("cannot write", error);
  }
  if (!direct_ && rename(temporary_.c_str(), target_.c_str()) != 0) {
    const int renaming = errno;
    discard();
    fail("cannot rename the finished file", renaming);
  }
  temporary_.clear();
}

void AtomicFile::discard() noexcept {
  if (descriptor_ >= 0) close(descriptor_);
  descriptor_ = -1;
  if (!direct_ && !temporary_.empty()) unlink(temporary_.c_str());
  temporary_.clear();
}

void AtomicFile::fail(const char* doing, int error) const {
  throw Error(path_, std::string(doing) + ": " + std::strerror(error), hint_for(error));
}

}  // namespace steradian
