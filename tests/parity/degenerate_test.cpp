// Degenerate inputs: zeros, denormals, the ends of ranges, and vectors of the largest and the smallest lengths. Also directions that are
// equal, opposite, on an axis or too long by the last bit. Every kernel returns finite numbers for them, in double and in float. Results
// that cannot be negative are not negative.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <limits>
#include <map>
#include <random>
#include <set>

#include "cases.h"

namespace steradian::parity {
namespace {

// STERADIAN_DEGENERATE_COUNT=1000000 is the long form.
std::size_t count() {
  const char* text = std::getenv("STERADIAN_DEGENERATE_COUNT");
  return text != nullptr ? std::strtoul(text, nullptr, 10) : 50'000;
}

template <class S>
class Degenerate {
 public:
  Degenerate(const Case& which, std::uint64_t seed) : which_(which), usual_(random_inputs(which, kUsual, seed)), random_(seed) {}

  // Sixteen numbers for the case. About half of its inputs are degenerate, the others usual.
  std::vector<S> inputs() {
    const auto usual = usual_.begin() + static_cast<std::ptrdiff_t>(kInputs * one_of(kUsual));
    std::vector<S> result(usual, usual + kInputs);
    const Input* last_direction = nullptr;
    for (const Input& input : which_.inputs) {
      const bool direction = input.domain == Domain::direction || input.domain == Domain::upper_direction;
      if (one_of(2) == 0) fill(input, result.data() + input.first, last_direction ? result.data() + last_direction->first : nullptr);
      if (direction) last_direction = &input;
    }
    return result;
  }

 private:
  std::uint64_t one_of(std::uint64_t n) { return random_() % n; }
  // Zero, a number near zero, or the last place of one.
  S tiny() {
    const S values[] = {S(0),
                        -S(0),
                        std::numeric_limits<S>::denorm_min(),
                        -std::numeric_limits<S>::denorm_min(),
                        std::numeric_limits<S>::min(),
                        std::numeric_limits<S>::epsilon(),
                        -std::numeric_limits<S>::epsilon()};
    return values[one_of(std::size(values))];
  }

  void fill(const Input& input, S* out, const S* other) {
    switch (input.domain) {
      case Domain::direction:
      case Domain::upper_direction: fill_direction(out, other, input.domain == Domain::upper_direction); break;
      case Domain::vector: {
        fill_direction(out, other, false);
        const S low = static_cast<S>(input.low), high = static_cast<S>(input.high);
        const S lengths[] = {low, high, low, high, S(1)};
        const S length = lengths[one_of(std::size(lengths))];
        for (int k = 0; k < 3; ++k) out[k] *= length;
        break;
      }
      default: {
        const S low = static_cast<S>(input.low), high = static_cast<S>(input.high);
        const S values[] = {low, high, std::clamp(tiny(), low, high), std::clamp(S(1), low, high),
                            std::clamp(std::nextafter(S(1), S(2)), low, high)};
        S x = values[one_of(std::size(values))];
        if (input.domain == Domain::signed_log && one_of(2) == 0) x = -x;
        if (input.domain == Domain::integer) x = std::floor(x);
        *out = x;
      }
    }
  }

  void fill_direction(S* out, const S* other, bool upper) {
    const std::uint64_t kind = one_of(4);
    if (other != nullptr && kind < 2) {
      for (int k = 0; k < 3; ++k) out[k] = kind == 0 ? other[k] : -other[k];
      if (upper) out[2] = std::fabs(out[2]);
      return;
    }
    const std::uint64_t axis = one_of(3);
    for (std::uint64_t k = 0; k < 3; ++k) out[k] = k == axis ? S(1) : tiny();
    if (!upper && one_of(2) == 0) out[axis] = -out[axis];
    if (upper) out[2] = std::fabs(out[2]);
    if (kind == 3) out[axis] = std::nextafter(out[axis], 2 * out[axis]);  // normalisation may leave this
  }

  static constexpr std::size_t kUsual = 1024;
  const Case& which_;
  std::vector<float> usual_;
  std::mt19937_64 random_;
};

template <class S>
struct Findings {
  std::map<std::string, std::size_t> not_finite, negative;
  std::map<std::string, std::vector<S>> first;
};

// Kernels whose value is a density, a fraction or an energy. A negative number is a mistake.
const std::set<std::string>& not_negative() {
  static const std::set<std::string> names = {
      "ggx_distribution",         "ggx_shadowing", "fresnel_schlick",  "beckmann_distribution", "ggx_lobe",
      "blinn_phong_distribution", "phong_power",   "phong_lobe",       "lambert_lobe",          "solid_angle",
      "polygon_irradiance",       "phong_series",  "phong_series_high"};
  return names;
}

template <class S, class Run>
Findings<S> search(Run run) {
  Findings<S> findings;
  for (std::size_t index = 0; index < cases().size(); ++index) {
    const Case& which = cases()[index];
    Degenerate<S> degenerate(which, 17);
    for (std::size_t n = 0; n < count(); ++n) {
      const std::vector<S> in = degenerate.inputs();
      const auto results = run(index, in);
      for (int v = 0; v < which.values; ++v) {
        const S r = results[static_cast<std::size_t>(v)];
        const bool bad = !std::isfinite(r), below = r < 0 && not_negative().count(which.name) > 0;
        if (bad) ++findings.not_finite[which.name];
        if (below) ++findings.negative[which.name];
        if (bad || below) findings.first.emplace(which.name, in);
      }
    }
  }
  return findings;
}

template <class S>
void expect_none(const Findings<S>& findings) {
  const auto shown = [&](const std::string& name) {
    std::string text;
    char number[40];
    for (const S x : findings.first.at(name)) {
      std::snprintf(number, sizeof number, "%.9g ", static_cast<double>(x));
      text += number;
    }
    return text;
  };
  for (const auto& [name, count] : findings.not_finite) ADD_FAILURE() << name << ": " << count << " not finite, first for " << shown(name);
  for (const auto& [name, count] : findings.negative) ADD_FAILURE() << name << ": " << count << " negative, first for " << shown(name);
}

}  // namespace

TEST(Degenerate, InputsGiveFiniteNumbersInDouble) {
  expect_none(search<double>([](std::size_t index, const std::vector<double>& in) { return run_double_at(index, in); }));
}

TEST(Degenerate, InputsGiveFiniteNumbersInFloat) {
  expect_none(search<float>([](std::size_t index, const std::vector<float>& in) { return run_float(index, in); }));
}

}  // namespace steradian::parity
