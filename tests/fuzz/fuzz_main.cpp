// The entry of libFuzzer. STERADIAN_FUZZ_TARGET is one of the functions in targets.h.
#include <cstddef>

#include "targets.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  steradian::fuzz::STERADIAN_FUZZ_TARGET({data, size});
  return 0;
}
