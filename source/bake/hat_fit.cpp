#include "bake/hat_fit.h"

#include <Eigen/Sparse>
#include <algorithm>
#include <limits>

#include "steradian/error.h"

namespace steradian::bake {
namespace {

using Matrix = Eigen::SparseMatrix<double>;
using Triplet = Eigen::Triplet<double, int>;

constexpr std::size_t kMostTriplets = std::size_t{1} << 21;  // 32 MB, then they join the matrix
constexpr int kRounds = 4;                                   // in which negative unknowns become zero
constexpr double kHold = 1e9;                                // weight that holds an unknown at zero, over its own
constexpr double kResidual = 1e-10;                          // at which iterations end
constexpr double kSmallest = 1e-4;                           // of the largest value: nearer to zero, a negative one is cut off

// Hats alone are well conditioned, so that few iterations solve them. Seams are stiff, and want a better preconditioner.
class HatSolver {
 public:
  HatSolver(const Matrix& matrix, bool has_seams) : has_seams_(has_seams) { change(matrix); }

  void change(const Matrix& matrix) {
    matrix_ = matrix;
    if (has_seams_)
      prepare(stiff_);
    else
      prepare(iterations_);
  }

  Eigen::VectorXd solve(const Eigen::VectorXd& right, const Eigen::VectorXd& guess) {
    if (right.isZero(0)) return Eigen::VectorXd::Zero(right.size());
    return has_seams_ ? Eigen::VectorXd(stiff_.solveWithGuess(right, guess)) : Eigen::VectorXd(iterations_.solveWithGuess(right, guess));
  }

 private:
  template <class Iterations>
  void prepare(Iterations& iterations) {
    iterations.setTolerance(kResidual);
    iterations.compute(matrix_);
    if (iterations.info() != Eigen::Success) throw Error("the fit", "has no solution", "report this scene as a bug");
  }

  const bool has_seams_;
  Matrix matrix_;
  Eigen::ConjugateGradient<Matrix, Eigen::Lower, Eigen::IncompleteCholesky<double, Eigen::Lower>> stiff_;
  Eigen::ConjugateGradient<Matrix, Eigen::Lower> iterations_;
};

}  // namespace

struct HatFit::Equations {
  Matrix matrix;  // lower half
  std::vector<Triplet> triplets;
  Eigen::MatrixX3d right;
  bool has_seams = false;

  explicit Equations(std::size_t n)
      : matrix(static_cast<Eigen::Index>(n), static_cast<Eigen::Index>(n)),
        right(Eigen::MatrixX3d::Zero(static_cast<Eigen::Index>(n), 3)) {}

  void add(std::span<const Hat> hats, double area) {
    for (const Hat& a : hats)
      for (const Hat& b : hats)
        if (a.unknown >= b.unknown)
          triplets.emplace_back(static_cast<int>(a.unknown), static_cast<int>(b.unknown), area * a.value * b.value);
    if (triplets.size() > kMostTriplets) gather();
  }

  void gather() {
    Matrix more(matrix.rows(), matrix.cols());
    more.setFromTriplets(triplets.begin(), triplets.end());
    matrix += more;
    triplets.clear();
  }
};

HatFit::HatFit(std::size_t unknowns) : equations_(std::make_unique<Equations>(unknowns)) {}
HatFit::~HatFit() = default;
HatFit::HatFit(HatFit&&) noexcept = default;

void HatFit::add_value(std::span<const Hat> hats, double area, Vec3d value) {
  equations_->add(hats, area);
  for (const Hat& h : hats)
    for (int c = 0; c < 3; ++c)
      equations_->right(static_cast<Eigen::Index>(h.unknown), c) += area * h.value * (c == 0 ? value.x : c == 1 ? value.y : value.z);
}

void HatFit::add_zero(std::span<const Hat> hats, double area) {
  equations_->add(hats, area);
  equations_->has_seams |= hats.size() > 2;
}

std::vector<Vec3d> HatFit::solve() {
  Equations& e = *equations_;
  e.gather();
  const Eigen::Index n = e.matrix.rows();
  std::vector<Vec3d> values(static_cast<std::size_t>(n));
  double largest = 0;
  for (Eigen::Index i = 0; i < n; ++i) largest = std::max(largest, e.matrix.coeff(i, i));
  if (!(largest > 0)) return values;
  // Unknowns without any equation, and groups that only differences join.
  for (Eigen::Index i = 0; i < n; ++i) e.matrix.coeffRef(i, i) += 1e-14 * largest;
  HatSolver solver(e.matrix, e.has_seams);
  Eigen::MatrixX3d solution(n, 3);
  for (int c = 0; c < 3; ++c) solution.col(c) = solver.solve(e.right.col(c), Eigen::VectorXd::Zero(n));
  const double least = -kSmallest * solution.maxCoeff();
  for (int c = 0; c < 3; ++c) {
    std::vector<std::uint8_t> held(static_cast<std::size_t>(n), 0);
    Matrix matrix;
    for (int round = 0; round < kRounds; ++round) {
      bool any = false;
      for (Eigen::Index i = 0; i < n; ++i) {
        if (!(solution(i, c) < least) || held[static_cast<std::size_t>(i)] != 0) continue;
        if (matrix.rows() == 0) matrix = e.matrix;
        held[static_cast<std::size_t>(i)] = 1;
        matrix.coeffRef(i, i) += kHold * std::max(matrix.coeff(i, i), 1e-12 * largest);
        any = true;
      }
      if (!any) break;
      solver.change(matrix);
      solution.col(c) = solver.solve(e.right.col(c), solution.col(c));
    }
    for (Eigen::Index i = 0; i < n; ++i) {
      Vec3d& v = values[static_cast<std::size_t>(i)];
      (c == 0 ? v.x : c == 1 ? v.y : v.z) = held[static_cast<std::size_t>(i)] != 0 ? 0 : std::max(solution(i, c), 0.0);
    }
  }
  return values;
}

}  // namespace steradian::bake
