// The two layouts of one fit, and how each is read.
#pragma once

#include <array>
#include <vector>

#include "ltc/fit.h"

namespace steradian {

// What a look-up gives: the matrix and both magnitudes.
struct LtcValue {
  LtcInverse inverse;
  double n_a = 0;
  double f_a = 0;
};

// Two textures as engines sample them: roughness along a row, sqrt(1 - cos theta) from row to row, nodes on the ends.
//   matrix     M^-1 over its middle element: column 0 row 0, column 0 row 2, column 2 row 0, column 2 row 2
//   magnitude  n_A, f_A, 0, form factor of a sphere clipped by the horizon (see clipped_sphere.h)
struct ClassicTable {
  int size = 0;
  std::vector<std::array<float, 4>> matrix;
  std::vector<std::array<float, 4>> magnitude;

  LtcValue look_up(double roughness, double cos_theta) const;
};

// Which element of M^-1 is 1. Engines expect the middle one; see docs/ltc.md for what each does between the nodes.
enum class ClassicNormalisation { middle, last };

ClassicTable classic_table(const LtcTable& fit, ClassicNormalisation normalisation = ClassicNormalisation::middle);

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

struct CompactSizes {
  int shape = 16;
  int magnitude = 22;  // together 3984 bytes
};

// The coarse values are those whose interpolation is nearest to the fine ones, in the sense of least squares.
CompactTable compact_table(const LtcTable& fit, CompactSizes sizes = {});

// The fit itself at its nodes, and interpolated in the shapes between them.
LtcValue look_up_shapes(const LtcTable& fit, double roughness, double cos_theta);

}  // namespace steradian
