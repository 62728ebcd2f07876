#include "scene/emitters/symmetric_matrix.h"

#include <Eigen/Dense>

namespace steradian::scene {
namespace {

using Entries = Eigen::Map<const Eigen::MatrixXd>;  // column-major, which equals the rows of a symmetric matrix

Entries entries_of(const SymmetricMatrix& matrix) {
  const auto n = static_cast<Eigen::Index>(matrix.n);
  return {matrix.entries.data(), n, n};
}

}  // namespace

void SymmetricMatrix::add_square(const std::vector<double>& v, double weight) {
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j) entries[i * n + j] += weight * v[i] * v[j];
}

std::vector<double> solve(const SymmetricMatrix& matrix, const std::vector<double>& right) {
  const Eigen::Map<const Eigen::VectorXd> b(right.data(), static_cast<Eigen::Index>(right.size()));
  const Eigen::VectorXd x = Eigen::MatrixXd(entries_of(matrix)).ldlt().solve(b);
  return {x.data(), x.data() + x.size()};
}

EigenSystem eigen_system(const SymmetricMatrix& matrix) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver{Eigen::MatrixXd(entries_of(matrix))};
  EigenSystem system;
  for (Eigen::Index i = 0; i < solver.eigenvalues().size(); ++i) {
    system.values.push_back(solver.eigenvalues()(i));
    const Eigen::VectorXd v = solver.eigenvectors().col(i);
    system.vectors.emplace_back(v.data(), v.data() + v.size());
  }
  return system;
}

}  // namespace steradian::scene
