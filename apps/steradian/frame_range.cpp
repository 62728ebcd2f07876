#include "frame_range.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "steradian/error.h"

namespace steradian::app {

FrameRange frame_range(const std::string& text) {
  FrameRange frames;
  const std::size_t dots = text.find("..");
  const auto number = [&](std::size_t from, std::size_t to, int& value) {
    const auto [end, error] = std::from_chars(text.data() + from, text.data() + to, value);
    return error == std::errc() && end == text.data() + to && value >= 0;
  };
  if (dots == std::string::npos || !number(0, dots, frames.first) || !number(dots + 2, text.size(), frames.last) ||
      frames.first > frames.last || frames.last > 1000000)
    throw UsageError("--frames", text + " are no frames", "write A..B, as in 0..99");
  return frames;
}

std::string numbered(const std::string& pattern, int frame) {
  const std::size_t first = pattern.find('#');
  if (first == std::string::npos) throw UsageError("--output", "has no # for the frames' numbers", "write -o 'frame_####.png'");
  const std::size_t end = std::min(pattern.find_first_not_of('#', first), pattern.size());
  return pattern.substr(0, first) + fmt::format("{:0{}}", frame, end - first) + pattern.substr(end);
}

}  // namespace steradian::app
