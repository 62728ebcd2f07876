// Integrals over directions of light that fades along its path, for which there are no closed forms.
#pragma once

#include <algorithm>
#include <cmath>

#include "reference/gauss_kronrod.h"
#include "steradian/plane.h"

namespace steradian::plane {

// Adds the integral of radiance(direction), and of radiance times direction, by Gauss-Kronrod's 15 nodes. Intervals are halved until the
// two rules agree to the tolerance, as a fraction of the brightest value met. The angle is begin + (end - begin) (3 s^2 - 2 s^3), s from 0
// to 1: at the tangent to a curve the distance changes like the root of the angle, which is smooth in s.
template <class Radiance>
void add_integral(const Radiance& radiance, double begin, double end, double tolerance, PlaneLight& sum) {
  struct Piece {
    double from, to;
    int depth;
  };
  constexpr int kDeepest = 12;
  Piece stack[kDeepest + 2];
  int count = 0;
  stack[count++] = {0, 1, 0};
  double brightest = 1e-300;
  while (count > 0) {
    const Piece piece = stack[--count];
    const double half = 0.5 * (piece.to - piece.from);
    PlaneLight kronrod;
    Vec3d gauss;
    for (const auto& node : reference::kKronrodNodes) {
      const double s = piece.from + half * (1 + node.x), angle = begin + (end - begin) * s * s * (3 - 2 * s);
      const double width = half * (end - begin) * 6 * s * (1 - s);
      const Vec2d u{std::cos(angle), std::sin(angle)};
      const Vec3d value = radiance(u);
      brightest = std::max({brightest, value.x, value.y, value.z});
      const Vec3d weighted = value * (node.kronrod * width);
      kronrod.radiance += weighted;
      kronrod.moment_x += weighted * u.x;
      kronrod.moment_y += weighted * u.y;
      gauss += value * (node.gauss * width);
    }
    const Vec3d off = kronrod.radiance - gauss;
    const double error = std::max({std::fabs(off.x), std::fabs(off.y), std::fabs(off.z)});
    if (error > tolerance * brightest && piece.depth < kDeepest) {
      const double middle = piece.from + half;
      stack[count++] = {middle, piece.to, piece.depth + 1};
      stack[count++] = {piece.from, middle, piece.depth + 1};
      continue;
    }
    sum.radiance += kronrod.radiance;
    sum.moment_x += kronrod.moment_x;
    sum.moment_y += kronrod.moment_y;
  }
}

}  // namespace steradian::plane
