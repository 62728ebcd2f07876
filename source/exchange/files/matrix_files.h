// Files of view factors: .npz with all that is known of a run, .mtx and .vf with the matrix alone.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "core/budget.h"
#include "exchange/files/masks.h"
#include "steradian/view_factors.h"

namespace steradian::exchange {

// Facts about a run: the settings on which every entry depends, and the part that it holds.
struct RunFacts {
  std::string version;
  double eps = 0;
  bool obstruction = true;
  int part = 1, parts = 1;
  std::vector<std::size_t> groups;  // by face; empty: the matrix is that of the faces
  double smallest = 0;              // factors below it were left out
};

// Rows that the faces add up to, for a matrix that is still by face.
struct Grouping {
  std::vector<std::size_t> groups = {};  // by face: its place in names; empty: rows are faces
  std::vector<std::string> names = {};
  std::vector<FaceMask> masks = {};
};

struct StoredRun {
  RunFacts run;
  std::vector<ViewFactorFace> faces;
  std::vector<std::array<Vec3d, 3>> obstacles = {};
  ViewFactors factors;
  Grouping grouping = {};  // a part has it for the whole matrix
};

// The arrays indices, indptr, format, shape and data are those of scipy.sparse.save_npz: the lower triangle of the exchange areas. Others:
// areas, row_sums, row_errors, errors (one an entry), names, run (JSON), the faces (corners, loops, face_loops), the obstacles
// and, in a part by groups, its grouping.
void write_factors_npz(const std::string& path, const StoredRun& stored);
StoredRun read_factors_npz(const std::string& path, Budget& budget);

// Matrix Market: the exchange areas as a symmetric coordinate matrix.
void write_factors_mtx(const std::string& path, const ViewFactors& factors);

// Writes the file in the format of its ending. Endings: .npz, .h5 (HDF5 with the arrays of .npz), .mtx and .vf (text of View3D). Throws
// UsageError for others.
void write_factors(const std::string& path, const StoredRun& stored);
void check_factors_name(const std::string& path);

}  // namespace steradian::exchange
