// FLIP: how different two pictures look to a person who flips between them, pixel by pixel.
// Source: Andersson et al., "FLIP: A Difference Evaluator for Alternating Images", PACMCGIT 3(2), 2020.
#pragma once

#include <vector>

#include "steradian/picture.h"

namespace steradian::image {

struct Flip {
  std::vector<float> error;  // of each pixel, in [0, 1]
  double mean = 0;
};

// Error between the two pictures at that exposure (tone_map), on a screen with so many pixels a degree. 67 is a screen of 3840 pixels and
// 0.7 m, viewed from 0.7 m. Throws Error when the sizes differ.
Flip flip(const Picture& picture, const Picture& reference, float exposure_stops, double pixels_per_degree = 67.02);

}  // namespace steradian::image
