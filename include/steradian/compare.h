// Numerical difference of two pictures.
#pragma once

#include <string>
#include <vector>

#include "steradian/picture.h"

namespace steradian {

struct Difference {
  double rmse = 0;         // root of the mean square over pixels and channels
  double relative_l2 = 0;  // |a - b| / |b|; 0 if both are black, infinite if only b is
  double max = 0;          // largest absolute difference of a channel
  double mean_ratio = 0;   // mean of a / mean of b; 1 if both are black
  int max_x = 0, max_y = 0;
};

// Computes the difference; b is the reference. Throws Error when the sizes differ or a pixel is not finite.
Difference difference(const Picture& a, const Picture& b);

// How well a picture's own error layers cover its difference from a reference.
struct Coverage {
  double fraction = 1;  // of the pixels: each channel differs by at most the layers' sum and four standard errors of the reference
  double worst = 0;     // largest difference of a channel over that sum; infinite where the sum is 0 and the difference is not
  int worst_x = 0, worst_y = 0;
};

// layers: of a, by name. b is the reference; its layer "variance" is of its pixels, and 0 if it has none. Throws Error for a layer that a
// lacks, and as difference does. Rounding to float counts as covered.
Coverage coverage(const Picture& a, const Picture& b, const std::vector<std::string>& layers);

// The value above which a thousandth of the channels lie: an exposure would map it to 1. 0 for an empty picture.
double white_of(const Picture& picture);

}  // namespace steradian
