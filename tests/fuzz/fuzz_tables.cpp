#include <cstdlib>
#include <string>

#include "scene/table_file.h"
#include "steradian/error.h"
#include "steradian/fit.h"
#include "steradian/light_profile.h"
#include "memory_file.h"

namespace steradian::fuzz {
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
