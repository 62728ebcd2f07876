// Least squares in a box: Levenberg and Marquardt, and quadratic functions by an active set.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

namespace steradian::solving {

// A function's value, gradient and (Gauss and Newton's) second derivatives, row by row.
struct Quadratic {
  double value = 0;
  std::vector<double> gradient, hessian;
};

// The least value of gradient.p + p.hessian.p / 2 for low <= p <= high, where 0 is within. The second derivatives must be positive
// definite.
//
// Error: gradients of free variables are below 1e-12 of the largest term, those of variables at a bound point outwards.
// Source: Lawson and Hanson, "Solving least squares problems", 1974, chapter 23, for bounds on both sides.
struct BoxStep {
  std::vector<double> step;
  std::size_t solves = 0;  // systems of equations that were solved
};
BoxStep least_in_box(const std::vector<double>& gradient, const std::vector<double>& hessian, const std::vector<double>& low,
                     const std::vector<double>& high);

struct BoxSettings {
  std::vector<double> low, high;
  std::vector<double> typical;  // change of each variable that is felt
  double rounding = 0;          // value below which the rest is rounding: steps after the first end
  int max_steps = 100;
  double tolerance = 1e-6;  // relative change of the value, and of the variables over `typical`, at which steps end
  std::function<std::vector<double>(std::vector<double>)> same{};  // a place of the same value from which steps go on
};

// State after a step that made the value smaller. Returns false to stop.
using BoxProgress = std::function<bool(int step, double value, double damping, const std::vector<double>& x)>;

struct BoxMinimum {
  std::vector<double> x;
  double value = 0;
  std::vector<double> hessian;  // at x
  int steps = 0, evaluations = 0;
  bool converged = false, stopped = false;
};

// Levenberg and Marquardt's steps, each the least value of the damped quadratic in the box.
//
//   value(x)      the function alone
//   quadratic(x)  with its derivatives
//
// Source: damping by Nielsen, "Damping parameter in Marquardt's method", 1999.
BoxMinimum minimize_in_box(const std::function<double(const std::vector<double>&)>& value,
                           const std::function<Quadratic(const std::vector<double>&)>& quadratic, std::vector<double> x,
                           const BoxSettings& settings, const BoxProgress& progress);

// Standard errors from second derivatives of a half sum of squares, and which variables are not determined.
struct Uncertainty {
  std::vector<double> sigma;  // infinite where not determined
  std::vector<char> determined;
};
// variance: of one residual. held: variables at a bound, which count as known.
Uncertainty uncertainty_of(const std::vector<double>& hessian, double variance, const std::vector<double>& typical,
                           const std::vector<char>& held);

}  // namespace steradian::solving
