// Small symmetric matrices: linear systems and eigenvectors. Only one unit includes Eigen, because its decompositions cost the compiler
// half a minute in each unit.
#pragma once

#include <cstddef>
#include <vector>

namespace steradian::scene {

// A symmetric matrix of n rows, stored by rows.
struct SymmetricMatrix {
  explicit SymmetricMatrix(std::size_t rows) : n(rows), entries(rows * rows, 0.0) {}
  double& operator()(std::size_t row, std::size_t column) { return entries[row * n + column]; }
  double operator()(std::size_t row, std::size_t column) const { return entries[row * n + column]; }
  // Adds weight * v v'.
  void add_square(const std::vector<double>& v, double weight = 1);

  std::size_t n;
  std::vector<double> entries;
};

// Solves matrix * x = right by LDL'. The result is not finite if the matrix is singular.
std::vector<double> solve(const SymmetricMatrix& matrix, const std::vector<double>& right);

struct EigenSystem {
  std::vector<double> values;                // in increasing order
  std::vector<std::vector<double>> vectors;  // unit vectors, in the same order
};
EigenSystem eigen_system(const SymmetricMatrix& matrix);

}  // namespace steradian::scene
