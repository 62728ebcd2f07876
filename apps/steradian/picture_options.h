// Options that verbs with pictures share: how their words become numbers.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace steradian::app {

struct PictureSize {
  int width = 0, height = 0;
};

// "1280x720". Throws WrongOption. The limit keeps a slip of the finger from asking for terabytes.
PictureSize picture_size(const std::string& text);

// Stops, -30 to 30; none for "auto". Throws WrongOption.
std::optional<float> exposure_stops(const std::string& text);

// What --tone takes: names of steradian/tone.h.
std::vector<std::string> tone_curve_names();

}  // namespace steradian::app
