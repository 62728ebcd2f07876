// Files of view factors: .npz with all that is known of a run, .mtx and .vf with the matrix alone.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "core/budget.h"
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

struct StoredRun {
  RunFacts run;
  std::vector<ViewFactorFace> faces;
  std::vector<std::array<Vec3d, 3>> obstacles = {};
  ViewFactors factors;
};

// The arrays indices, indptr, format, shape and data are those of scipy.sparse.save_npz: the lower triangle of the exchange areas. Others:
// areas, row_sums, row_errors, errors (one an entry), names, run (JSON), the faces (corners, loops, face_loops) and the obstacles.
void write_factors_npz(const std::string& path, const StoredRun& stored);
StoredRun read_factors_npz(const std::string& path, Budget& budget);

// Matrix Market: the exchange areas as a symmetric coordinate matrix.
void write_factors_mtx(const std::string& path, const ViewFactors& factors);

// Writes the file in the format of its ending. Throws UsageError for another ending than .npz, .mtx and .vf (text of View3D).
void write_factors(const std::string& path, const StoredRun& stored);
void check_factors_name(const std::string& path);

}  // namespace steradian::exchange
