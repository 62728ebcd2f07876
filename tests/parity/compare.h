// Runs a case on every target and compares: float with double, everything else with float and with the bound.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "cases.h"

namespace steradian::parity {

struct Target {
  std::string name;
  Rounding rounding;         // the model whose guarantees its functions keep
  bool equal_in_arithmetic;  // gives scalar float's bits if neither exp nor log is involved
  std::function<std::vector<float>(std::size_t index, const std::vector<float>& inputs)> run;
};

// Scalar float, and every instruction set that this processor supports, strict and fast.
std::vector<Target> cpu_targets();

struct Difference {
  std::size_t unequal = 0;   // inputs whose bits differ from scalar float (a zero's sign does not count)
  double largest = 0;        // difference from scalar float, by the case's measure
  double share = 0;          // largest fraction of the bound: above 1 is more than roundings explain
  std::size_t beyond = 0;    // inputs beyond the bound, or not finite
  std::string first_beyond;  // description of the first of them
};

struct CaseReport {
  const Case* which;
  std::size_t inputs = 0;
  double largest = 0, rms = 0;      // float against double, by the case's measure
  double typical_bound = 0;         // median of the bound over the largest result: the sharpness of the check
  std::size_t without_bound = 0;    // inputs for which the error analysis finds no bound (a divisor that may be 0)
  std::vector<Difference> targets;  // in the order of the targets
};

CaseReport compare(std::size_t index, const std::vector<Target>& targets, std::size_t count, std::uint64_t seed = 1);

}  // namespace steradian::parity
