#include <sys/mman.h>
#include <unistd.h>

#include <cstdlib>
#include <string>

#include "scene/table_file.h"
#include "steradian/error.h"
#include "steradian/fit.h"
#include "steradian/light_profile.h"
#include "targets.h"

namespace steradian::fuzz {
namespace {

// The bytes as a file in memory, because these readers take paths.
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

}  // namespace

void table(Input input) {
  const MemoryFile file(input);
  try {
    scene::read_classic_table(file.path());
  } catch (const Error&) {
  }
}

void samples(Input input) {
  const MemoryFile file(input);
  try {
    read_lobe_samples(file.path(), kLimits);
  } catch (const Error&) {
  }
}

void profile(Input input) {
  for (const char* name : {"input.ies", "input.ldt"}) {
    try {
      const LightProfile profile =
          read_light_profile_from_memory({reinterpret_cast<const char*>(input.data()), input.size()}, name, kLimits);
      double sum = luminous_flux(profile);
      for (int i = 0; i < 27; ++i) sum += intensity(profile, {i % 3 - 1.0, i / 3 % 3 - 1.0, i / 9 - 1.0});
      if (!(sum >= 0)) std::abort();  // not a number, or negative
    } catch (const Error&) {
    }
  }
}

}  // namespace steradian::fuzz
