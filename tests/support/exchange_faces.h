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

// n x n houses of different heights on a ground of streets, 30 m from house to house. No faces under the houses.
inline std::vector<ViewFactorFace> town(int n) {
  std::vector<ViewFactorFace> faces;
  std::mt19937 random(2);
  const auto number = [&](double low, double high) { return low + (high - low) * 0x1p-32 * static_cast<double>(random()); };
  const auto add = [&](Vec3d a, Vec3d b, Vec3d c, Vec3d d) { faces.push_back({"", {a, b, c, d}}); };
  const auto ground = [&](double x, double y, double w, double h) { add({x, y, 0}, {x + w, y, 0}, {x + w, y + h, 0}, {x, y + h, 0}); };
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const double x0 = 30 * i + number(0, 3), y0 = 30 * j + number(0, 3), x1 = x0 + number(12, 18), y1 = y0 + number(12, 18),
                   z = number(6, 25);
      add({x0, y0, z}, {x1, y0, z}, {x1, y1, z}, {x0, y1, z});
      add({x0, y0, 0}, {x1, y0, 0}, {x1, y0, z}, {x0, y0, z});
      add({x1, y0, 0}, {x1, y1, 0}, {x1, y1, z}, {x1, y0, z});
      add({x1, y1, 0}, {x0, y1, 0}, {x0, y1, z}, {x1, y1, z});
      add({x0, y1, 0}, {x0, y0, 0}, {x0, y0, z}, {x0, y1, z});
      if (j + 1 < n) ground(30 * i, 30 * j + 21, 21, 9);
      if (i + 1 < n) ground(30 * i + 21, 30 * j, 9, 21);
      if (i + 1 < n && j + 1 < n) ground(30 * i + 21, 30 * j + 21, 9, 9);
    }
  return faces;
}

inline Vec3d random_place(std::mt19937& random) {
  std::uniform_real_distribution<double> place(-1, 1);
  const double x = place(random), y = place(random), z = place(random);
  return {x, y, z};
}

}  // namespace steradian::exchange
