// --frames A..B and the names of its pictures.
#pragma once

#include <string>

namespace steradian::app {

struct FrameRange {
  int first = 0, last = 0;
};
// "A..B", 0 <= A <= B.
FrameRange frame_range(const std::string& text);

// The #s of a name become the frame's number.
std::string numbered(const std::string& pattern, int frame);

}  // namespace steradian::app
