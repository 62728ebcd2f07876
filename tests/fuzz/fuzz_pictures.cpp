#include "image/codecs.h"
#include "steradian/error.h"
#include "targets.h"

namespace steradian::fuzz {

namespace {

// The limit is smaller than for scenes. Nearly every input claims a size, and clearing its memory would be most of the work.
constexpr Limits kPictureLimits{.memory = 5'000'000, .work = kLimits.work};

}  // namespace

void picture(Input input) {
  Budget budget(kPictureLimits);
  try {
    image::decode_exr(input, "picture.exr", budget);
  } catch (const Error&) {
  }
  try {
    Budget own(kPictureLimits);
    image::decode_hdr(input, "picture.hdr", own);
  } catch (const Error&) {
  }
  texture(input);
}

void texture(Input input) {
  Budget budget(kPictureLimits);
  try {
    image::decode_image(input, "picture", std::size_t{1} << 22, budget);
  } catch (const Error&) {
  }
}

}  // namespace steradian::fuzz
