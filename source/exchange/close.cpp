#include <algorithm>
#include <cmath>
#include <limits>

#include "steradian/error.h"
#include "steradian/view_factors.h"

namespace steradian {
namespace {

constexpr int kMostRounds = 20;       // of fixing entries at 0 and solving again
constexpr double kClosedRow = 1e-15;  // a row sum is off by its rounding

using Numbers = std::vector<double>;

// Calls use(row, column, block, place) for all entries.
template <class Blocks, class Use>
void for_each_entry(Blocks& blocks, Use use) {
  for (auto& b : blocks)
    for (std::size_t r = 0; r < b.rows(); ++r)
      for (std::size_t k = b.row_start[r]; k < b.row_start[r + 1]; ++k) use(b.first_row + r, b.columns[k], b, k);
}

double weight_of(const ExchangeBlock& b, std::size_t k) {
  const auto e = static_cast<double>(b.errors[k]);
  return b.values[k] > 0 ? e * e : 0.0;
}

double product(const Numbers& a, const Numbers& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}

// (diag(W 1) + W) x for the symmetric weights W.
Numbers weighted(const std::vector<ExchangeBlock>& blocks, const Numbers& x) {
  Numbers y(x.size(), 0.0);
  for_each_entry(blocks, [&](std::size_t i, std::size_t j, const ExchangeBlock& b, std::size_t k) {
    const double moved = weight_of(b, k) * (x[i] + x[j]);
    y[i] += moved;
    y[j] += moved;
  });
  return y;
}

// Conjugate gradients with the diagonal as preconditioner. The matrix is positive semidefinite, and the gaps lie in its range up to
// rounding.
Numbers solve(const std::vector<ExchangeBlock>& blocks, const Numbers& gaps) {
  const std::size_t n = gaps.size();
  Numbers diagonal(n, 0.0), x(n, 0.0), r = gaps, z(n), p(n);
  for_each_entry(blocks, [&](std::size_t i, std::size_t j, const ExchangeBlock& b, std::size_t k) {
    diagonal[i] += weight_of(b, k);
    diagonal[j] += weight_of(b, k);
  });
  const auto precondition = [&] {
    for (std::size_t i = 0; i < n; ++i) z[i] = diagonal[i] > 0 ? r[i] / diagonal[i] : 0.0;
  };
  precondition();
  p = z;
  double rz = product(r, z);
  const double start = product(gaps, gaps);
  for (std::size_t step = 0; step < 4 * n + 100 && rz > 0 && product(r, r) > 1e-30 * start; ++step) {
    const Numbers q = weighted(blocks, p);
    const double curvature = product(p, q);
    if (!(curvature > 0)) break;
    const double alpha = rz / curvature;
    for (std::size_t i = 0; i < n; ++i) {
      x[i] += alpha * p[i];
      r[i] -= alpha * q[i];
    }
    precondition();
    const double next = product(r, z);
    for (std::size_t i = 0; i < n; ++i) p[i] = z[i] + next / rz * p[i];
    rz = next;
  }
  return x;
}

}  // namespace

ViewFactors closed_view_factors(const ViewFactors& factors) {
  ViewFactors result = factors;
  result.sum_rows();
  for (std::size_t i = 0; i < result.size(); ++i) {
    const double gap = std::fabs(result.row_sums[i] - 1);
    if (gap > result.row_errors[i] + 64 * std::numeric_limits<double>::epsilon())
      throw Error(result.names[i].empty() ? "face " + std::to_string(i) : result.names[i],
                  "its factors add up to " + std::to_string(result.row_sums[i]) + ", which its error does not explain",
                  "the enclosure has a hole; leave out --close");
  }
  // Least squares of dH_ij / err_ij under the sums of rows: dH_ij = err_ij^2 (l_i + l_j).
  for (int round = 0; round < kMostRounds; ++round) {
    Numbers gaps(result.size());
    double worst = 0;
    for (std::size_t i = 0; i < result.size(); ++i) {
      gaps[i] = result.areas[i] * (1 - result.row_sums[i]);
      worst = std::max(worst, std::fabs(1 - result.row_sums[i]));
    }
    if (worst <= kClosedRow) break;
    const Numbers l = solve(result.blocks, gaps);
    for_each_entry(result.blocks, [&](std::size_t i, std::size_t j, ExchangeBlock& b, std::size_t k) {
      // An entry that would turn negative stays at 0, where its weight is 0.
      b.values[k] = std::max(b.values[k] + weight_of(b, k) * (l[i] + l[j]), 0.0);
    });
    result.sum_rows();
  }
  return result;
}

}  // namespace steradian
