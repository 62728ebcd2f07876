// The procedures by which packs and shaders compute lobes under a light.
#pragma once

#include <cstddef>

// A list of them, in the order in which a device runs them. Each is a function of source/render/direct/lobe_packs.h and a shader,
// shaders/NAME.comp. CMake reads this list, too.
#define STERADIAN_PROCEDURES(X) \
  X(diffuse)                    \
  X(ltc)                        \
  X(closed_form)                \
  X(representative_point)       \
  X(sheen)                      \
  X(ltc_clipless)               \
  X(half_vector)                \
  X(phong_lobe)

namespace steradian::methods {

#define STERADIAN_ENUMERATOR(name) name,
enum class Procedure : std::size_t { STERADIAN_PROCEDURES(STERADIAN_ENUMERATOR) none };
#undef STERADIAN_ENUMERATOR

inline constexpr auto kProcedures = static_cast<std::size_t>(Procedure::none);

}  // namespace steradian::methods
