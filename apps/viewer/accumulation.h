// Accumulation: a Monte Carlo picture that improves while nothing changes. It is the mean of passes, each with different random numbers.
#pragma once

#include <cstdint>
#include <vector>

#include "steradian/picture.h"

namespace steradian::view {

class Accumulation {
 public:
  // A pass has `pairs` pairs of samples per light and pixel, and the variance of its mean in the layer "variance". All passes have one
  // size.
  void add(const Picture& pass, int pairs);

  std::uint64_t pairs() const { return pairs_; }
  Picture picture() const;  // the mean, weighted by pairs, with its variance
  // rms of the mean's standard error over rms of the mean, over pixels and channels, as in `render --target-error`. 0 before the first
  // pass.
  double relative_error() const;

 private:
  int width_ = 0, height_ = 0;
  std::uint64_t pairs_ = 0;
  std::vector<Vec3d> sum_, variance_;  // sum of pass times its pairs; sum of variance times pairs squared
};

}  // namespace steradian::view
