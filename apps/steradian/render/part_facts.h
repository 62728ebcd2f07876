// Facts in the metadata of a part of a picture, which the whole picture does not have.
#pragma once

namespace steradian::app::part_facts {

inline constexpr const char* kSettings = "steradian.picture";  // all on which the pixels depend
inline constexpr const char* kAutoExposure = "auto";           // the exposure, where it follows from the whole picture

}  // namespace steradian::app::part_facts
