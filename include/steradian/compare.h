// Difference of two pictures in numbers.
#pragma once

#include "steradian/picture.h"

namespace steradian {

struct Difference {
  double rmse = 0;         // root of the mean square over pixels and channels
  double relative_l2 = 0;  // |a - b| / |b|; 0 where both are black, infinite where only b is
  double max = 0;          // largest absolute difference of a channel
  double mean_ratio = 0;   // mean of a / mean of b; 1 where both are black
  int max_x = 0, max_y = 0;
};

// b is the reference. Throws Error when the sizes differ or a pixel is not finite.
Difference difference(const Picture& a, const Picture& b);

// The value that all but a thousandth of the channels stay below: what an exposure would map to 1. 0 of an empty picture.
double white_of(const Picture& picture);

}  // namespace steradian
