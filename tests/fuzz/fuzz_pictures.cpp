#include <algorithm>

#include "image/decode_image.h"
#include "image/exr.h"
#include "steradian/error.h"
#include "targets.h"

namespace steradian::fuzz {

void picture(Input input) {
  Budget budget(kLimits);
  try {
    decode_exr(input, "picture.exr", budget);
  } catch (const Error&) {
  }
  texture(input);
}

void texture(Input input) {
  Budget budget(kLimits);
  try {
    decode_image(input, "picture", std::size_t{1} << 22, budget);
  } catch (const Error&) {
  }
}

}  // namespace steradian::fuzz
