// EXR in memory: functions on the file's bytes, so that all disk access happens in one place.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "core/budget.h"
#include "steradian/picture.h"

namespace steradian::image {

std::string encode_exr(const Picture& picture);

// Throws Error(place, ...) for bytes that are not a whole picture. Memory is allocated after the header has been checked.
Picture decode_exr(std::span<const std::uint8_t> bytes, const std::string& place, Budget& budget);

}  // namespace steradian::image
