// Faces and places for the tests and benches of view factors.
#pragma once

#include <cmath>
#include <random>
#include <vector>

#include "steradian/view_factors.h"

namespace steradian::exchange {

// The inside of a unit cube, turned by 0.7 about a skew axis, with n x n elements a face.
inline std::vector<ViewFactorFace> turned_cube(int n) {
  std::vector<ViewFactorFace> faces;
  const Vec3d axis = normalized(Vec3d{1, 2, 3}), x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};
  const auto add = [&](Vec3d corner, Vec3d a, Vec3d b) {
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j) {
        const auto at = [&](int s, int t) {
          return rotated(corner + a * (static_cast<double>(s) / n) + b * (static_cast<double>(t) / n), axis, 0.7);
        };
        faces.push_back({"", {at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)}});
      }
  };
  add({}, x, y);
  add(z, y, x);
  add({}, y, z);
  add(x, z, y);
  add({}, z, x);
  add(y, x, z);
  return faces;
}

inline Vec3d random_place(std::mt19937& random) {
  std::uniform_real_distribution<double> place(-1, 1);
  const double x = place(random), y = place(random), z = place(random);
  return {x, y, z};
}

}  // namespace steradian::exchange
