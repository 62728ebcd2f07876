// The parity cases of the kernels' x_cases.glsl in C++: their names, the domains of their inputs, and functions that run them. They run as
// double, float, packs, and in arithmetic that carries a bound on every rounding.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "core/simd.h"

namespace steradian::parity {

enum class Domain { direction, upper_direction, vector, range, log, signed_log, integer };
enum class Measure { absolute, relative };
enum class Bound { running, statistical };  // rounded.h, shaken.h

struct Input {
  int first;  // index among the sixteen reals
  Domain domain;
  double low, high;
};

struct Case {
  std::string name, title;
  Measure measure;
  int values;       // how many of the four results count
  bool arithmetic;  // neither exp nor log is reached: results can be equal to the bit
  Bound bound;
  std::vector<Input> inputs;
};

const std::vector<Case>& cases();

inline constexpr std::size_t kInputs = 16, kResults = 4;

// count times sixteen floats. The same seed gives the same inputs on every machine.
std::vector<float> random_inputs(const Case& which, std::size_t count, std::uint64_t seed);

// count times four results of case number `index`.
std::vector<double> run_double(std::size_t index, const std::vector<float>& inputs);
std::vector<double> run_double_at(std::size_t index, const std::vector<double>& input);  // sixteen numbers, four results
// The derivatives of the four results by each of the sixteen numbers.
std::vector<std::vector<double>> run_dual(std::size_t index, const std::vector<double>& input);
std::vector<float> run_float(std::size_t index, const std::vector<float>& inputs);

enum class PackKind { fast, strict };  // strict: no contraction, IEEE square roots and divisions
std::vector<float> run_packs(std::size_t index, const std::vector<float>& inputs, Simd simd, PackKind kind);

// The value of the float algorithm without roundings, and a bound on the distance of any evaluation in float.
struct BoundedResults {
  std::vector<double> value, bound;
};
enum class Rounding { cpu, gpu };  // the functions: ours and xsimd's, or those that Vulkan guarantees for a device
BoundedResults run_bounded(std::size_t index, const std::vector<float>& inputs, Rounding rounding);

}  // namespace steradian::parity
