// Per-pixel z-test of a picture against an estimate with its variance: the statistics of picture tests.
#pragma once

#include "steradian/picture.h"

namespace steradian::image {

struct ZTest {
  std::size_t tested = 0;  // channels of pixels with variance or difference
  std::size_t accepted = 0;
  double threshold = 0;  // standard deviations
  double worst = 0;
  double share() const { return tested > 0 ? static_cast<double>(accepted) / static_cast<double>(tested) : 1; }
};

// Two-sided test of every channel at family-wise significance 0.01 (Sidak: 1 - (1 - 0.01)^(1/n) each). `estimate` has
// a layer "variance". `rounding`: relative error of `picture` itself, added to the standard error: a float picture
// cannot be nearer than that.
// Source: Mitsuba's image tests (Subr, Arvo, "Statistical hypothesis testing for assessing Monte Carlo estimators", 2007).
ZTest z_test(const Picture& picture, const Picture& estimate, double rounding);

// Adds to the variance of shadows by rays what their samples may not have found. Of 64 samples or more, none may meet what is seen of a
// light that is nearly hidden; that says it is no more than some hundredths: 1 - (1 - 0.05)^64 = 0.96 would have found a twentieth. The
// same where nearly all of it is seen: both ways, of three standard errors, a twentieth of `open`, the picture without shadows.
void add_variance_of_rare_samples(Picture& estimate, const Picture& open);

}  // namespace steradian::image
