// The least power that keeps illuminances within their bands, by sequential quadratic programming.
#pragma once

#include <optional>
#include <vector>

namespace steradian::solving {

// A linear function of the unknowns that must not be negative: constant + slopes.x.
struct Condition {
  double constant = 0;
  std::vector<double> slopes;
};

// The x in the box that satisfies all conditions with the least cost.x. None if there is none, to 1e-6 of a condition's largest term.
std::optional<std::vector<double>> least_cost(const std::vector<double>& cost, const std::vector<Condition>& conditions,
                                              const std::vector<double>& low, const std::vector<double>& high, std::vector<double> start);

}  // namespace steradian::solving
