// Random rectangles, over which errors are measured and which the fitter uses.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "fit/lobe.h"
#include "integrals/ggx/ltc_radiance.h"

namespace steradian::fit {

// A light of radiance 1 viewed from the origin; corners are counter-clockwise as seen from there.
using TestRectangle = std::array<Vec3d, 4>;

// Centres uniform over the directions above -6 degrees, at distance 1, half sides of 0.2 to 1, tilted up to 60 degrees away from the
// origin. The error figures of docs/theory/ltc.md use these.
std::vector<TestRectangle> test_rectangles(int count, std::uint64_t seed);

// The same, but every other centre is in a direction to which the lobe sends light: a narrow lobe misses most others.
std::vector<TestRectangle> test_rectangles_near(const Lobe& lobe, int count, std::uint64_t seed);

// Radiance from every rectangle by quasi-Monte Carlo in the lobe's coordinates, mirrored in y: 2 * directions points.
// For a lobe symmetric in y. The error falls like directions^(-3/4): about 1e-4 at 2^17.
std::vector<double> true_radiance(const Lobe& lobe, const std::vector<TestRectangle>& rectangles, int directions);

// Integral over the rectangle of the fitted lobe, by the kernels ltc_* in double; times n_A: the radiance.
double integrate_rectangle(const LtcInverse& inverse, const TestRectangle& rectangle);

}  // namespace steradian::fit
