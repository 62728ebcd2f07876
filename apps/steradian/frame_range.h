// --frames A..B and the names of its pictures.
#pragma once

#include <string>
#include <vector>

namespace steradian::app {

struct FrameRange {
  int first = 0, last = 0;
};
// "A..B", 0 <= A <= B.
FrameRange frame_range(const std::string& text);

// The #s of a name become the frame's number.
std::string numbered(const std::string& pattern, int frame);

// The frames of a range whose pictures are not there yet, or all; says how many are there. Throws UsageError where the name has no #.
std::vector<int> frames_to_make(const FrameRange& range, const std::string& output, bool force);

}  // namespace steradian::app
