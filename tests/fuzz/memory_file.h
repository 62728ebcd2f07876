// MemoryFile: the bytes of a fuzzer as a file, for readers that take paths.
#pragma once

#include <sys/mman.h>
#include <unistd.h>

#include <string>

#include "targets.h"

namespace steradian::fuzz {

class MemoryFile {
 public:
  explicit MemoryFile(Input input) : descriptor_(memfd_create("input", 0)) {
    std::size_t written = 0;
    while (written < input.size()) {
      const ssize_t more = write(descriptor_, input.data() + written, input.size() - written);
      if (more <= 0) break;
      written += static_cast<std::size_t>(more);
    }
  }
  ~MemoryFile() { close(descriptor_); }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;
  std::string path() const { return "/proc/self/fd/" + std::to_string(descriptor_); }

 private:
  int descriptor_;
};

}  // namespace steradian::fuzz
