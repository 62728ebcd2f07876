// Files: reading of a whole one, and AtomicFile, an output that is complete or absent.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/budget.h"

namespace steradian {

// Reading of a whole file: its size is known and checked against the budget before memory is allocated.

using Bytes = std::vector<std::uint8_t>;

// place: the source that names the file, for the Error. Only regular files are read: a device has no size and may never end.
Bytes read_file(const std::string& path, const std::string& place, Budget& budget);

// AtomicFile: an output file that is either complete or absent. It is written without a name in the target's folder and gets its name on
// commit. A program that is killed leaves nothing behind.

// A name that is a device or a pipe (/dev/null, /dev/stdout) is written directly; a symbolic link is followed. Every failure throws Error
// with the path and what to do. An existing file of that name stays unchanged then.
class AtomicFile {
 public:
  explicit AtomicFile(const std::string& path);
  ~AtomicFile();  // removes an uncommitted file
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  void write(std::string_view bytes);

  // The last step: the file appears under its name.
  void commit();

 private:
  [[noreturn]] void fail(const char* doing, int error) const;
  void open_temporary(unsigned mode);
  int name_it();  // returns 0 or the error
  void discard() noexcept;

  std::string path_, target_, temporary_;  // the last is empty while the file has no name
  int descriptor_ = -1;
  bool direct_ = false;
};

// Throws the Error that AtomicFile would give for this path, and leaves nothing behind. A device or a pipe is not opened.
void check_writable(const std::string& path);

// Writes a whole file at once.
void write_file(const std::string& path, std::string_view bytes);

// Writes all bytes to a descriptor, however many calls it takes; `name` is for the Error.
void write_all(int descriptor, std::string_view bytes, const std::string& name);

}  // namespace steradian
