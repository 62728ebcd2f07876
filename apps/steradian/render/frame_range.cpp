#include "render/frame_range.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <filesystem>

#include "output.h"
#include "steradian/error.h"

namespace steradian::app {
namespace {

std::filesystem::path folder_of(const std::string& path) { return std::filesystem::path(path).parent_path(); }

}  // namespace

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

std::vector<int> frames_to_make(const FrameRange& range, const std::string& output, bool force, Part part) {
  numbered(output, 0);  // throws if there is no #
  std::vector<int> wanted;
  for (int frame = range.first + part.number - 1; frame <= range.last; frame += part.count)
    if (force || !std::filesystem::exists(numbered(output, frame))) wanted.push_back(frame);
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    const std::string path = numbered(output, wanted[i]);
    if (i == 0 || folder_of(path) != folder_of(numbered(output, wanted[i - 1]))) check_output(path, Writes::picture);
  }
  const int length = range.last - range.first + 1;
  const auto all = static_cast<std::size_t>((length - part.number + part.count) / part.count);
  if (wanted.size() < all)
    fmt::print(stderr, "steradian: {} of {} frames are there (--force makes them again)\n", all - wanted.size(), all);
  return wanted;
}

}  // namespace steradian::app
