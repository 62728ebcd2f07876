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

// Two-sided test of every channel at family-wise significance 0.01 (Sidak: 1 - (1 - 0.01)^(1/n) each). `estimate` has a layer "variance".
// `rounding`: relative error of `picture` itself, added to the standard error: a float picture cannot be more exact than that. Source:
// Mitsuba's image tests (Subr, Arvo, "Statistical hypothesis testing for assessing Monte Carlo estimators", 2007).
ZTest z_test(const Picture& picture, const Picture& estimate, double rounding);

// Adds to the variance of shadows by rays what their samples may have missed. Of 64 samples or more, none may hit the visible part of a
// nearly occluded light. That part is then at most some hundredths: 1 - (1 - 0.05)^64 = 0.96 would have found a twentieth. The same holds
// for a nearly visible light. In both cases three standard errors are a twentieth of `open`, the picture without shadows.
void add_variance_of_rare_samples(Picture& estimate, const Picture& open);

}  // namespace steradian::image
