// Fuzz targets: arbitrary bytes for each reader. A target returns or throws nothing. A bug is any finding of the sanitizers, any endless
// run, and any escaping exception other than Error.
#pragma once

#include <cstdint>
#include <span>

#include "steradian/limits.h"

namespace steradian::fuzz {

using Input = std::span<const std::uint8_t>;

// Small limits, so that a fuzzer runs many inputs a second.
inline constexpr Limits kLimits{.memory = 100'000'000, .work = 20'000'000};

void gltf(Input input);       // load_scene
void svg(Input input);        // load_plane_scene
void svg_frame(Input input);  // a frame of 16 x 16 of the scene read
void eval(Input input);       // lines of queries, with their answers
void picture(Input input);    // EXR, PNG and JPEG as pictures
void texture(Input input);    // PNG and JPEG as textures
void table(Input input);      // fitted tables
void samples(Input input);    // measured reflection
void factors(Input input);    // files of view factors, and of View3D with the factors of its surfaces
void solve(Input input);      // questions of `solve`
void profile(Input input);    // IES and EULUMDAT, and the intensities that they give

}  // namespace steradian::fuzz
