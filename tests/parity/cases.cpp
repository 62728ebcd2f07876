#include "cases.h"

#include <cmath>
#include <random>

#include "packs.h"

namespace steradian::parity {
namespace {

#define PARITY_LIST(...) __VA_ARGS__
const std::vector<Case> kCases = {
#define PARITY_CASE(name, title, measure, values, arithmetic, bound, inputs) \
  Case{#name, title, measure, values, arithmetic, bound, PARITY_LIST inputs},
#include "parity_cases.inc"
#undef PARITY_CASE
};

// Uniform in [0, 1), from the generator's bits, because std::uniform_real_distribution differs between C++ libraries.
double uniform(std::mt19937_64& random) { return static_cast<double>(random() >> 11) * 0x1p-53; }

double between(std::mt19937_64& random, double low, double high) { return low + (high - low) * uniform(random); }

double log_between(std::mt19937_64& random, double low, double high) { return std::exp(between(random, std::log(low), std::log(high))); }

void direction(std::mt19937_64& random, double lowest_z, double length, float* out) {
  const double z = between(random, lowest_z, 1.0), phi = between(random, 0.0, 6.283185307179586);
  const double r = std::sqrt(1.0 - z * z);
  out[0] = static_cast<float>(length * r * std::cos(phi));
  out[1] = static_cast<float>(length * r * std::sin(phi));
  out[2] = static_cast<float>(length * z);
}

void fill(std::mt19937_64& random, const Input& input, float* out) {
  const double low = input.low, high = input.high;
  switch (input.domain) {
    case Domain::direction: direction(random, -1.0, 1.0, out); break;
    case Domain::upper_direction: direction(random, 0.0, 1.0, out); break;
    case Domain::vector: {
      const double length = log_between(random, low, high);
      direction(random, -1.0, length, out);
      break;
    }
    case Domain::range: *out = static_cast<float>(between(random, low, high)); break;
    case Domain::log: *out = static_cast<float>(log_between(random, low, high)); break;
    case Domain::signed_log: {
      const double sign = (random() & 1) != 0 ? 1.0 : -1.0;
      *out = static_cast<float>(sign * log_between(random, low, high));
      break;
    }
    case Domain::integer: *out = static_cast<float>(std::floor(between(random, low, high + 1.0))); break;
  }
}

const PackTable& table_for(Simd simd, PackKind kind) {
  return kind == PackKind::strict ? parity_table_strict_for(simd) : parity_table_parity_for(simd);
}

}  // namespace

const std::vector<Case>& cases() { return kCases; }

std::vector<float> random_inputs(const Case& which, std::size_t count, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::vector<float> inputs(count * kInputs, 0.0f);
  for (std::size_t n = 0; n < count; ++n)
    for (const Input& input : which.inputs) fill(random, input, &inputs[n * kInputs + static_cast<std::size_t>(input.first)]);
  return inputs;
}

std::vector<float> run_packs(std::size_t index, const std::vector<float>& inputs, Simd simd, PackKind kind) {
  const std::size_t count = inputs.size() / kInputs, padded = (count + 15) / 16 * 16;
  std::vector<float> in = inputs;
  while (in.size() < padded * kInputs) in.insert(in.end(), inputs.end() - kInputs, inputs.end());
  std::vector<float> results(padded * kResults);
  table_for(simd, kind).run(index, in.data(), results.data(), padded);
  results.resize(count * kResults);
  return results;
}

}  // namespace steradian::parity
