// AtomicFile: an output file that is complete or not there. Written beside its name, renamed when it is done.
#pragma once

#include <string>
#include <string_view>

namespace steradian {

// A name that is a device or a pipe (/dev/null, /dev/stdout) is written straight; a symbolic link is followed.
// Every failure throws Error with the path and what to do; the file of that name, if there was one, stays as it was.
class AtomicFile {
 public:
  explicit AtomicFile(const std::string& path);
  ~AtomicFile();  // removes what was not committed
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  void write(std::string_view bytes);

  // The last step: the file appears under its name.
  void commit();

  // Where the bytes go until then: for libraries that write to a path of their own. The file exists and is empty.
  const std::string& temporary_path() const { return temporary_; }

 private:
  [[noreturn]] void fail(const char* doing, int error) const;
  void discard() noexcept;

  std::string path_, target_, temporary_;
  int descriptor_ = -1;
  bool direct_ = false;
};

// Writes all bytes to a descriptor, however many calls it takes; `name` is for the Error.
void write_all(int descriptor, std::string_view bytes, const std::string& name);

}  // namespace steradian
