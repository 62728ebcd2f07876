// Accumulation: a Monte Carlo picture that gets better for as long as nothing changes: the mean of passes, each with random numbers of its
// own.
#pragma once

#include <cstdint>
#include <vector>

#include "steradian/picture.h"

namespace steradian::view {

class Accumulation {
 public:
  // A pass has so many pairs of samples a light and pixel, and their mean's variance in its layer "variance". All are of one size.
  void add(const Picture& pass, int pairs);

  std::uint64_t pairs() const { return pairs_; }
  Picture picture() const;  // the mean, weighted by pairs, with its variance
  // rms of the mean's standard error over rms of the mean, over pixels and channels: what `render --target-error` is about. 0 before a
  // pass.
  double relative_error() const;

 private:
  int width_ = 0, height_ = 0;
  std::uint64_t pairs_ = 0;
  std::vector<Vec3d> sum_, variance_;  // of pass times its pairs; of their variance times pairs squared
};

}  // namespace steradian::view
