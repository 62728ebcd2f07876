// Options shared by verbs with pictures: converts their words to numbers.
#pragma once

#include <optional>
#include <string>

namespace steradian::app {

struct PictureSize {
  int width = 0, height = 0;
};

// Parses "1280x720". Throws WrongOption. The limit prevents a typing error from asking for terabytes.
PictureSize picture_size(const std::string& text);

// Parses stops, -30 to 30; none for "auto". Throws WrongOption.
std::optional<float> exposure_stops(const std::string& text);

}  // namespace steradian::app
