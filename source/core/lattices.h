// Lattices: places spread evenly over the unit square and over the sphere of directions, without random numbers.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "steradian/vector.h"

namespace steradian {

// Fractional part of the golden ratio: its multiples are even over [0, 1) for any count.
inline constexpr double kGolden = 0.61803398874989485;

// Point `index` of a Fibonacci lattice of `count` places in the unit square, shifted by `turn` in its second direction.
inline std::array<double, 2> fibonacci_place(std::size_t index, std::size_t count, double turn) {
  const double v = static_cast<double>(index) * kGolden + turn;
  return {(static_cast<double>(index) + 0.5) / static_cast<double>(count), v - std::floor(v)};
}

// The same lattice on the sphere of directions. Each direction stands for the same solid angle. turn: rotation about y, in turns.
inline Vec3d fibonacci_direction(std::size_t index, std::size_t count, double turn) {
  const auto [u, v] = fibonacci_place(index, count, turn);
  const double y = 1 - 2 * u, r = std::sqrt(1 - y * y), phi = 2 * std::numbers::pi * v;
  return {r * std::cos(phi), y, r * std::sin(phi)};
}

// Place `number` of a sequence of which any run is nearly even over the unit square.
// Source: Roberts, "The unreasonable effectiveness of quasirandom sequences", 2018: R2.
inline std::array<double, 2> r2_place(double number) {
  const double u = 0.7548776662466927 * number, v = 0.5698402909980532 * number;
  return {u - std::floor(u), v - std::floor(v)};
}

}  // namespace steradian
