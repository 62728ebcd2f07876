// --frames A..B and the names of its pictures.
#pragma once

#include <string>
#include <vector>

#include "part.h"

namespace steradian::app {

struct FrameRange {
  int first = 0, last = 0;
};
// "A..B", 0 <= A <= B.
FrameRange frame_range(const std::string& text);

// Replaces the #s of a name by the frame's number.
std::string numbered(const std::string& pattern, int frame);

// The frames of a range, or of one part of it, whose pictures do not exist yet, or all; prints the number that exist. Throws UsageError if
// the name has no #.
std::vector<int> frames_to_make(const FrameRange& range, const std::string& output, bool force, Part part = {});

}  // namespace steradian::app
