#include "solve/least_power.h"

#include <algorithm>
#include <cmath>
#include <nlopt.hpp>

namespace steradian::solving {
namespace {

constexpr double kTolerance = 1e-6;

double scale_of(const Condition& c, const std::vector<double>& x) {
  double scale = std::fabs(c.constant);
  for (std::size_t i = 0; i < x.size(); ++i) scale = std::max(scale, std::fabs(c.slopes[i] * x[i]));
  return std::max(scale, 1e-300);
}

double value_of(const Condition& c, const std::vector<double>& x) {
  double value = c.constant;
  for (std::size_t i = 0; i < x.size(); ++i) value += c.slopes[i] * x[i];
  return value;
}

double objective(const std::vector<double>& x, std::vector<double>& gradient, void* data) {
  const auto& cost = *static_cast<const std::vector<double>*>(data);
  double sum = 0;
  for (std::size_t i = 0; i < x.size(); ++i) sum += cost[i] * x[i];
  if (!gradient.empty()) gradient = cost;
  return sum;
}

// NLopt's conditions are below 0.
void conditions_of(unsigned count, double* result, unsigned n, const double* x, double* gradient, void* data) {
  const auto& conditions = *static_cast<const std::vector<Condition>*>(data);
  for (unsigned k = 0; k < count; ++k) {
    double value = conditions[k].constant;
    for (unsigned i = 0; i < n; ++i) value += conditions[k].slopes[i] * x[i];
    result[k] = -value;
    if (gradient != nullptr)
      for (unsigned i = 0; i < n; ++i) gradient[k * n + i] = -conditions[k].slopes[i];
  }
}

}  // namespace

std::optional<std::vector<double>> least_cost(const std::vector<double>& cost, const std::vector<Condition>& conditions,
                                              const std::vector<double>& low, const std::vector<double>& high, std::vector<double> start) {
  std::vector<Condition> scaled = conditions;
  for (Condition& c : scaled) {
    const double scale = scale_of(c, start);
    c.constant /= scale;
    for (double& s : c.slopes) s /= scale;
  }
  std::vector<double> own_cost = cost;
  const double largest = *std::max_element(cost.begin(), cost.end());
  for (double& c : own_cost) c /= std::max(largest, 1e-300);
  nlopt::opt optimizer(nlopt::LD_SLSQP, static_cast<unsigned>(cost.size()));
  optimizer.set_lower_bounds(low);
  optimizer.set_upper_bounds(high);
  optimizer.set_min_objective(objective, &own_cost);
  if (!scaled.empty()) optimizer.add_inequality_mconstraint(conditions_of, &scaled, std::vector<double>(scaled.size(), 1e-9));
  optimizer.set_ftol_rel(1e-10);
  optimizer.set_maxeval(500);
  double value = 0;
  for (std::size_t i = 0; i < start.size(); ++i) start[i] = std::clamp(start[i], low[i], high[i]);
  try {
    optimizer.optimize(start, value);
  } catch (const nlopt::roundoff_limited&) {  // the best so far is judged below
  } catch (const std::runtime_error&) {
    return {};
  }
  for (const Condition& c : scaled)
    if (!(value_of(c, start) >= -kTolerance * scale_of(c, start))) return {};
  return start;
}

}  // namespace steradian::solving
