#include "solve/box_least_squares.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <limits>

namespace steradian::solving {
namespace {

using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
using Vector = Eigen::VectorXd;

constexpr double kSmall = 1e-12;         // of the largest term: rounding
constexpr double kUndetermined = 1e-10;  // eigenvalue over the largest one, in typical changes, below which a direction is not determined

Eigen::Map<const Matrix> square(const std::vector<double>& m, std::size_t n) {
  return {m.data(), static_cast<Eigen::Index>(n), static_cast<Eigen::Index>(n)};
}

enum class At : char { free, low, high };

// Minimizes over the free variables, the others fixed in `p`.
Vector free_minimum(const Vector& g, const Eigen::Map<const Matrix>& h, const Vector& p, const std::vector<At>& at,
                    const std::vector<Eigen::Index>& free) {
  const auto m = static_cast<Eigen::Index>(free.size());
  Matrix a(m, m);
  Vector b(m);
  for (Eigen::Index i = 0; i < m; ++i) {
    const Eigen::Index row = free[static_cast<std::size_t>(i)];
    b[i] = -g[row];
    for (Eigen::Index j = 0; j < g.size(); ++j)
      if (at[static_cast<std::size_t>(j)] != At::free) b[i] -= h(row, j) * p[j];
    for (Eigen::Index j = 0; j < m; ++j) a(i, j) = h(row, free[static_cast<std::size_t>(j)]);
  }
  return a.ldlt().solve(b);
}

}  // namespace

BoxStep least_in_box(const std::vector<double>& gradient, const std::vector<double>& hessian, const std::vector<double>& low,
                     const std::vector<double>& high) {
  const std::size_t n = gradient.size();
  const auto h = square(hessian, n);
  const Vector g = Eigen::Map<const Vector>(gradient.data(), static_cast<Eigen::Index>(n));
  BoxStep result;
  Vector p = Vector::Zero(static_cast<Eigen::Index>(n));
  std::vector<At> at(n, At::free);
  // Variables that stand at a bound begin there.
  for (std::size_t i = 0; i < n; ++i) {
    if (low[i] >= 0 && gradient[i] > 0) at[i] = At::low;
    if (high[i] <= 0 && gradient[i] < 0) at[i] = At::high;
  }
  const std::size_t most = 10 * n + 20;
  while (result.solves < most) {
    std::vector<Eigen::Index> free;
    for (std::size_t i = 0; i < n; ++i)
      if (at[i] == At::free) free.push_back(static_cast<Eigen::Index>(i));
    if (!free.empty()) {
      const Vector goal = free_minimum(g, h, p, at, free);
      ++result.solves;
      // Goes as far as the first bound.
      double share = 1;
      std::size_t blocked = n;
      At side = At::low;
      for (std::size_t k = 0; k < free.size(); ++k) {
        const auto i = static_cast<std::size_t>(free[k]);
        const double from = p[free[k]], to = goal[static_cast<Eigen::Index>(k)];
        const double bound = to < low[i] ? low[i] : to > high[i] ? high[i] : to;
        if (bound == to) continue;
        const double s = to != from ? (bound - from) / (to - from) : 0;
        if (s < share) share = s, blocked = i, side = to < low[i] ? At::low : At::high;
      }
      share = std::clamp(share, 0.0, 1.0);
      for (std::size_t k = 0; k < free.size(); ++k) p[free[k]] += share * (goal[static_cast<Eigen::Index>(k)] - p[free[k]]);
      if (blocked < n) {
        at[blocked] = side;
        p[static_cast<Eigen::Index>(blocked)] = side == At::low ? low[blocked] : high[blocked];
        continue;
      }
    }
    // All free variables are at their minimum: frees the variable at a bound whose gradient points inwards most.
    const Vector slope = g + h * p;
    const double largest = g.cwiseAbs().maxCoeff() + (h.cwiseAbs() * p.cwiseAbs()).maxCoeff();
    std::size_t worst = n;
    double most_inwards = kSmall * largest;
    for (std::size_t i = 0; i < n; ++i) {
      const double inwards = at[i] == At::low    ? -slope[static_cast<Eigen::Index>(i)]
                             : at[i] == At::high ? slope[static_cast<Eigen::Index>(i)]
                                                 : 0;
      if (inwards > most_inwards && low[i] < high[i]) most_inwards = inwards, worst = i;
    }
    if (worst == n) break;
    at[worst] = At::free;
  }
  result.step.assign(p.data(), p.data() + p.size());
  return result;
}

BoxMinimum minimize_in_box(const std::function<double(const std::vector<double>&)>& value,
                           const std::function<Quadratic(const std::vector<double>&)>& quadratic, std::vector<double> x,
                           const BoxSettings& settings, const BoxProgress& progress) {
  const std::size_t n = x.size();
  BoxMinimum best;
  Quadratic here = quadratic(x);
  best.evaluations = 1;
  double damping = 1e-3, growth = 2;
  bool ended = progress && !progress(0, here.value, damping, x);
  best.stopped = ended;
  for (int tries = 0; !ended && best.steps < settings.max_steps && tries < 20 * settings.max_steps; ++tries) {
    // The damping of each variable is its own second derivative, or that of a typical change where the value hardly knows it.
    std::vector<double> damped = here.hessian, low(n), high(n), diagonal(n);
    double scale = 0;
    for (std::size_t i = 0; i < n; ++i) scale = std::max(scale, here.hessian[i * n + i] * settings.typical[i] * settings.typical[i]);
    for (std::size_t i = 0; i < n; ++i) {
      diagonal[i] = std::max(here.hessian[i * n + i], 1e-9 * scale / (settings.typical[i] * settings.typical[i]));
      damped[i * n + i] += damping * diagonal[i];
      low[i] = settings.low[i] - x[i];
      high[i] = settings.high[i] - x[i];
    }
    if (!(scale > 0)) {  // nothing changes with any variable
      best.converged = true;
      break;
    }
    const std::vector<double> step = least_in_box(here.gradient, damped, low, high).step;
    std::vector<double> there = x;
    double expected = 0, moved = 0;
    for (std::size_t i = 0; i < n; ++i) {
      there[i] = std::clamp(x[i] + step[i], settings.low[i], settings.high[i]);
      moved = std::max(moved, std::fabs(step[i]) / settings.typical[i]);
      double curved = 0;
      for (std::size_t j = 0; j < n; ++j) curved += here.hessian[i * n + j] * step[j];
      expected -= step[i] * (here.gradient[i] + 0.5 * curved);
    }
    if (moved <= 1e-9 || expected <= 1e-15 * here.value || (best.steps > 0 && here.value <= settings.rounding)) {
      best.converged = true;
      break;
    }
    const double reached = value(there);
    ++best.evaluations;
    const double gain = (here.value - reached) / expected;
    if (!(reached < here.value)) {
      // Rounding hides the rest of the way.
      if (moved <= settings.tolerance && expected <= settings.tolerance * here.value) {
        best.converged = true;
        break;
      }
      damping *= growth;
      growth *= 2;
      if (!(damping < 1e12)) {
        best.converged = moved <= settings.tolerance;
        break;
      }
      continue;
    }
    const double change = (here.value - reached) / here.value;
    x = settings.same ? settings.same(std::move(there)) : std::move(there);
    here = quadratic(x);
    ++best.evaluations;
    ++best.steps;
    const double wide = 2 * gain - 1;
    damping = std::max(damping * std::max(1.0 / 3, 1 - wide * wide * wide), 1e-12);
    growth = 2;
    if (progress && !progress(best.steps, here.value, damping, x)) {
      best.stopped = ended = true;
    } else if (change <= settings.tolerance && moved <= settings.tolerance * 10) {
      best.converged = ended = true;
    }
  }
  best.x = std::move(x);
  best.value = here.value;
  best.hessian = std::move(here.hessian);
  return best;
}

Uncertainty uncertainty_of(const std::vector<double>& hessian, double variance, const std::vector<double>& typical,
                           const std::vector<char>& held) {
  const std::size_t n = typical.size();
  Uncertainty result{std::vector<double>(n, 0.0), std::vector<char>(n, 1)};
  std::vector<Eigen::Index> free;
  for (std::size_t i = 0; i < n; ++i)
    if (held[i] == 0) free.push_back(static_cast<Eigen::Index>(i));
  const auto m = static_cast<Eigen::Index>(free.size());
  if (m == 0) return result;
  const auto h = square(hessian, n);
  Matrix a(m, m);  // in typical changes
  for (Eigen::Index i = 0; i < m; ++i)
    for (Eigen::Index j = 0; j < m; ++j)
      a(i, j) = h(free[static_cast<std::size_t>(i)], free[static_cast<std::size_t>(j)]) *
                typical[static_cast<std::size_t>(free[static_cast<std::size_t>(i)])] *
                typical[static_cast<std::size_t>(free[static_cast<std::size_t>(j)])];
  const Eigen::SelfAdjointEigenSolver<Matrix> eigen(a);
  const double largest = std::max(eigen.eigenvalues().maxCoeff(), 0.0);
  for (Eigen::Index i = 0; i < m; ++i) {
    const auto number = static_cast<std::size_t>(free[static_cast<std::size_t>(i)]);
    double inverse = 0;
    for (Eigen::Index k = 0; k < m; ++k) {
      const double part = eigen.eigenvectors()(i, k), value = eigen.eigenvalues()[k];
      if (value > kUndetermined * largest && largest > 0) {
        inverse += part * part / value;
      } else if (part * part > 0.01) {
        result.determined[number] = 0;
      }
    }
    result.sigma[number] = std::sqrt(inverse * variance) * typical[number];
    if (result.sigma[number] > typical[number]) result.determined[number] = 0;
    if (result.determined[number] == 0) result.sigma[number] = std::numeric_limits<double>::infinity();
  }
  return result;
}

}  // namespace steradian::solving
