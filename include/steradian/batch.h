// Many points at once: the radiance that one light sends from each of them, on all cores, and on packs if a method supports them.
//
//   std::vector<Vec3f> position, normal;                       // as many of each
//   std::vector<Vec3f> seen(position.size());
//   const PointRows<float> points = {position.size(), rows_of(position), rows_of(normal), rows_of(normal)};
//   radiance(light, points, Material{}, {.radiance = &seen[0].x});
//
// Needs the layer `render` (steradian::render).
#pragma once

#include <cstddef>
#include <vector>

#include "steradian/area_light.h"
#include "steradian/material.h"
#include "steradian/radiance.h"

namespace steradian {

// Rows of three numbers: component c of row i is first[i * row + c * column].
template <class T>
struct Rows {
  const T* first = nullptr;
  std::ptrdiff_t row = 3;  // 0: every row is the same
  std::ptrdiff_t column = 1;

  T at(std::size_t i, std::size_t c) const { return first[static_cast<std::ptrdiff_t>(i) * row + static_cast<std::ptrdiff_t>(c) * column]; }
};

template <class T>
Rows<T> rows_of(const std::vector<Vector3<T>>& v) {
  return {v.empty() ? nullptr : &v.front().x};
}

// Normals and views need not be unit. A point whose normal or view is zero is no surface: its result is 0. A point with a number that is
// not finite gets NaN.
template <class T>
struct PointRows {
  std::size_t count = 0;
  Rows<T> position, normal, view;
};

// Destination of results: `count` rows without gaps.
template <class T>
struct RadianceRows {
  T* radiance = nullptr;  // three numbers a point
  T* error = nullptr;     // one a point: bound of `reference`, standard error of `sampled`, else 0; null: not wanted
};

struct BatchOptions {
  RadianceOptions radiance{};  // its precision is that of T; `sampled` uses other random numbers for every point
  int threads = 0;             // 0: all
};

// The same as radiance of radiance.h, point by point, within the rounding of its precision. Packs serve Lambert under polygons in double.
// In single precision they serve Lambert under all lights. Under polygons they also serve GGX by closed-form, ltc, ltc-compact and
// half-vector, Phong, Beckmann, Blinn-Phong and Charlie. Throws the same errors. The bytes are the same at any number of threads.
void radiance(const AreaLight& light, const PointRows<float>& points, const Material& lobe, const RadianceRows<float>& result,
              const BatchOptions& options = {});
void radiance(const AreaLight& light, const PointRows<double>& points, const Material& lobe, const RadianceRows<double>& result,
              const BatchOptions& options = {});

}  // namespace steradian
