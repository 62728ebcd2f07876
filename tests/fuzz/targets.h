// Fuzz targets: a stranger's bytes to each reader. A target returns or throws nothing; what the sanitizers find, what does
// not end, and what escapes as another exception than Error is a bug.
#pragma once

#include <cstdint>
#include <span>

#include "steradian/limits.h"

namespace steradian::fuzz {

using Input = std::span<const std::uint8_t>;

// Small, so that a fuzzer runs many a second.
inline constexpr Limits kLimits{.memory = 100'000'000, .work = 20'000'000};

void gltf(Input input);       // load_scene
void svg(Input input);        // load_plane_scene
void svg_frame(Input input);  // a frame of 16 x 16 of what it reads
void eval(Input input);       // lines of queries, answered
void picture(Input input);    // EXR, PNG and JPEG as pictures
void texture(Input input);    // PNG and JPEG as textures
void table(Input input);      // fitted tables
void samples(Input input);    // measured reflection
void profile(Input input);    // IES and EULUMDAT, and what they answer

}  // namespace steradian::fuzz
