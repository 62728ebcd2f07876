// Means over stratified directions.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "steradian/plane.h"

namespace steradian::plane {
namespace stratified {

// splitmix64 (Steele, Lea, Flood 2014).
inline std::uint64_t mix(std::uint64_t x) {
  x += 0x9E3779B97F4A7C15u;
  x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9u;
  x = (x ^ (x >> 27)) * 0x94D049BB133111EBu;
  return x ^ (x >> 31);
}

inline double uniform(std::uint64_t x) { return static_cast<double>(mix(x) >> 11) * 0x1p-53; }

inline std::uint64_t seed_of(Vec2d p, std::uint64_t seed) {
  return mix(std::bit_cast<std::uint64_t>(p.x) ^ mix(std::bit_cast<std::uint64_t>(p.y) ^ mix(seed)));
}

}  // namespace stratified

// Mean of f over stratified directions, one random direction in each of spp equal sectors.
template <class F>
PlaneLight mean_over_directions(Vec2d from, const PlaneSampling& sampling, F f) {
  PlaneLight sum;
  const std::uint64_t seed = stratified::seed_of(from, sampling.seed);
  for (int i = 0; i < sampling.spp; ++i) {
    const double angle = 2 * std::numbers::pi * (i + stratified::uniform(seed + static_cast<std::uint64_t>(i))) / sampling.spp;
    const Vec2d u{std::cos(angle), std::sin(angle)};
    const Vec3d radiance = f(u);
    sum.radiance += radiance;
    sum.moment_x += radiance * u.x;
    sum.moment_y += radiance * u.y;
  }
  const double scale = 1.0 / std::max(sampling.spp, 1);
  return {sum.radiance * scale, sum.moment_x * scale, sum.moment_y * scale};
}

}  // namespace steradian::plane
