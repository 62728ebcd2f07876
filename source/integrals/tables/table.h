// Tables of linearly transformed cosines, and the half precision in which they are stored.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "integrals/ggx/ltc_radiance.h"
#include "steradian/material.h"
#include "steradian/polygon_light.h"
#include "steradian/shading_point.h"

namespace steradian {

// Half precision: 1 sign, 5 exponent, 10 fraction bits. Rounds to nearest, ties to even; overflow goes to infinity.

std::uint16_t half_from_float(float x);
float float_from_half(std::uint16_t bits);
inline float round_to_half(float x) { return float_from_half(half_from_float(x)); }

// The two layouts of a fitted table, and their look-ups.

// Result of a look-up: the matrix and both magnitudes.
struct LtcValue {
  LtcInverse inverse;
  double n_a = 0;
  double f_a = 0;
};

// The element of M^-1 that is 1. Engines expect the middle one; docs/theory/ltc.md describes the effect of each between the nodes.
enum class ClassicNormalisation { middle, last };

// Two textures as engines sample them: roughness along a row, sqrt(1 - cos theta) from row to row, nodes on the ends.
//   matrix     M^-1 over its middle element: column 0 row 0, column 0 row 2, column 2 row 0, column 2 row 2
//   magnitude  n_A, f_A, 0, form factor of a sphere clipped by the horizon (clipped_sphere_form_factor)
struct ClassicTable {
  int size = 0;
  std::vector<std::array<float, 4>> matrix;
  std::vector<std::array<float, 4>> magnitude;
  ClassicNormalisation normalisation = ClassicNormalisation::middle;  // last: the fourth of matrix is the middle

  LtcValue look_up(double roughness, double cos_theta) const;
};

// Plain arrays: shapes (LtcShape) and magnitudes (n_A, f_A), each on its own grid, in half precision: at most 4 KB.
struct CompactTable {
  LobeFrame frame = LobeFrame::mirror;
  int shape_size = 0;
  int magnitude_size = 0;
  std::vector<std::array<float, 4>> shapes;
  std::vector<std::array<float, 2>> magnitudes;

  struct Entry {
    LtcShape shape;
    double n_a = 0;
    double f_a = 0;
  };
  Entry entry(double roughness, double cos_theta) const;
  LtcValue look_up(double roughness, double cos_theta) const;
  std::size_t bytes() const { return shapes.size() * 8 + magnitudes.size() * 4; }
};

// ltc_radiance by a custom table, fitted to another lobe, instead of GGX's. Precondition: serves(LtcMethod::classic, material).
Vec3d ltc_radiance_by(const ClassicTable& table, const PreparedPolygon& light, const ShadingPoint& at, const Material& material);
Vec3d ltc_radiance_by_float(const ClassicTable& table, const PreparedPolygon& light, const ShadingPoint& at, const Material& material);

}  // namespace steradian
