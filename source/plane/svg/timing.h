// Active times of SMIL animations, and their progress.
#pragma once

#include <optional>
#include <string_view>

#include "plane/svg/document.h"

namespace steradian::plane::svg {

// Seconds: "1.5", "1.5s", "200ms", "2min", "1h", "01:30", "0:01:30.5".
std::optional<double> clock_value(std::string_view text);

// Progress in its simple duration, 0 to 1, and the number of completed durations.
struct TimelineProgress {
  double share = 0;
  int iteration = 0;
};

// Empty if the animation has no effect at that time: not yet begun, over and not frozen, or begun by an event.
std::optional<TimelineProgress> progress_of(SvgDocument& document, pugi::xml_node animation, double seconds);

// Time from the beginning of the document to the end of the animation; if it repeats without end, to the end of its first turn. 0 if it
// never begins or has no duration.
struct Extent {
  double seconds = 0;
  bool endless = false;
};
Extent extent_of(SvgDocument& document, pugi::xml_node animation);

}  // namespace steradian::plane::svg
