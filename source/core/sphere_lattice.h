// A lattice of directions over the sphere.
#pragma once

#include <cmath>
#include <cstddef>
#include <numbers>

#include "steradian/vector.h"

namespace steradian {

// Point `index` of a Fibonacci lattice of `count` directions. Each stands for the same solid angle. turn: rotation about y, in turns.
inline Vec3d lattice_direction(std::size_t index, std::size_t count, double turn) {
  constexpr double kGolden = 0.61803398874989485;
  const double y = 1 - (2 * static_cast<double>(index) + 1) / static_cast<double>(count), r = std::sqrt(1 - y * y);
  const double phi = 2 * std::numbers::pi * std::fmod(static_cast<double>(index) * kGolden + turn, 1.0);
  return {r * std::cos(phi), y, r * std::sin(phi)};
}

}  // namespace steradian
