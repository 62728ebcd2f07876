// Numerical difference of two pictures.
#pragma once

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

// The value above which a thousandth of the channels lie: an exposure would map it to 1. 0 for an empty picture.
double white_of(const Picture& picture);

}  // namespace steradian
