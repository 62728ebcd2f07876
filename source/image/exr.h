// EXR in memory: the file's bytes, so that reading and writing disks happens in one place.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "core/budget.h"
#include "steradian/picture.h"

namespace steradian::image {

std::string encode_exr(const Picture& picture);

// Throws Error(place, ...) for bytes that are no whole picture; memory is taken after the header has been judged.
Picture decode_exr(std::span<const std::uint8_t> bytes, const std::string& place, Budget& budget);

}  // namespace steradian::image
