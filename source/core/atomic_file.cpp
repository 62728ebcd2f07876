// AtomicFile on POSIX systems, and on Windows.
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <random>
#include <sys/stat.h>
#include <unistd.h>

#include "core/files.h"
#include "steradian/error.h"

namespace steradian {
namespace {

#if defined(_WIN32)
constexpr int kWrite = O_WRONLY | O_BINARY | O_NOINHERIT;
#else
constexpr int kWrite = O_WRONLY | O_CLOEXEC;
#endif

std::string hint_for(int error) {
  switch (error) {
    case ENOSPC:
#if defined(EDQUOT)
    case EDQUOT:
#endif
      return "the disk is full: free some space or choose another place";
    case EFBIG: return "the file is larger than this process may write (ulimit -f), or than the disk can hold";
    case ENOENT: return "the folder does not exist: make it first";
    case EACCES:
    case EPERM: return "the folder is not writable: choose another place";
    case EROFS: return "the disk is read-only: choose another place";
    case EISDIR: return "this is a folder: name a file in it";
    default: return "choose another place";
  }
}

std::string resolved(const std::string& path) {
  std::error_code error;
  const std::filesystem::path real = std::filesystem::canonical(path, error);
  return error ? path : real.string();
}

#if !defined(_WIN32)
std::string folder_of(const std::string& path) {
  const std::size_t slash = path.rfind('/');
  return slash == std::string::npos ? "." : path.substr(0, slash + 1);
}
#endif

// Calls make with names beside the target until one is free; make returns -1 and sets errno. Returns the name that was taken, or an empty
// one.
template <class Make>
std::string take_free_name(const std::string& target, Make make) {
  std::random_device random;
  for (int attempt = 0; attempt < 100; ++attempt) {
    const std::string name = target + "." + std::to_string(random());
    if (make(name) >= 0) return name;
    if (errno != EEXIST) break;
  }
  return {};
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
    descriptor_ = open(target_.c_str(), kWrite);
    if (descriptor_ < 0) fail("cannot open", errno);
    return;
  }
  open_temporary(0666);
  // A new file has the permissions that the process's umask allows; a replaced one keeps its permissions.
#if !defined(_WIN32)
  if (exists) fchmod(descriptor_, existing.st_mode & 0777);
#endif
}

// Opens a file without a name where the file system supports it, else under a temporary name.
void AtomicFile::open_temporary(unsigned mode) {
#if !defined(_WIN32)
  descriptor_ = open(folder_of(target_).c_str(), O_TMPFILE | kWrite, mode);
  if (descriptor_ >= 0 || errno == EACCES || errno == EROFS) {
    if (descriptor_ < 0) fail("cannot create", errno);
    return;
  }
#endif
  temporary_ =
      take_free_name(target_, [&](const std::string& name) { return descriptor_ = open(name.c_str(), O_CREAT | O_EXCL | kWrite, mode); });
  if (descriptor_ < 0) fail("cannot create", errno);
}

// A link cannot replace a file: if one exists, the new file gets a name beside it and is renamed.
int AtomicFile::name_it() {
#if defined(_WIN32)
  // An open file cannot be renamed, and rename() does not replace a file.
  close(descriptor_);
  descriptor_ = -1;
  std::error_code error;
  std::filesystem::rename(temporary_, target_, error);
  if (error) return error.default_error_condition().value();
#else
  if (temporary_.empty()) {
    const std::string unnamed = "/proc/self/fd/" + std::to_string(descriptor_);
    const auto link_as = [&](const std::string& name) {
      return linkat(AT_FDCWD, unnamed.c_str(), AT_FDCWD, name.c_str(), AT_SYMLINK_FOLLOW);
    };
    if (link_as(target_) == 0) return 0;
    if (errno != EEXIST) return errno;
    temporary_ = take_free_name(target_, link_as);
    if (temporary_.empty()) return errno;
  }
  if (rename(temporary_.c_str(), target_.c_str()) != 0) return errno;
#endif
  temporary_.clear();
  return 0;
}

AtomicFile::~AtomicFile() { discard(); }

void AtomicFile::write(std::string_view bytes) { write_all(descriptor_, bytes, path_); }

void AtomicFile::commit() {
  // Some file systems report a full disk only at a close; naming needs the descriptor after that.
  const int written = close(dup(descriptor_)) == 0 ? 0 : errno;
  const int named = written != 0 || direct_ ? 0 : name_it();
  discard();
  if (written != 0) fail("cannot write", written);
  if (named != 0) fail("cannot name the finished file", named);
}

void AtomicFile::discard() noexcept {
  if (descriptor_ >= 0) close(descriptor_);
  descriptor_ = -1;
  if (!temporary_.empty()) unlink(temporary_.c_str());
  temporary_.clear();
}

void AtomicFile::fail(const char* doing, int error) const {
  throw Error(path_, std::string(doing) + ": " + std::strerror(error), hint_for(error));
}

void check_writable(const std::string& path) {
  struct stat existing {};
  const bool direct = stat(path.c_str(), &existing) == 0 && !S_ISREG(existing.st_mode) && !S_ISDIR(existing.st_mode);
  if (!direct) {
    const AtomicFile unused(path);
    return;
  }
  if (access(path.c_str(), W_OK) != 0) throw Error(path, std::string("cannot open: ") + std::strerror(errno), hint_for(errno));
}

}  // namespace steradian
