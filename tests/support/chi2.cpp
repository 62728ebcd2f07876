#include "support/chi2.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/random.h"

namespace steradian::reference {

// Uses the series below the mean, and Legendre's continued fraction (by Lentz's method) above it.
double regularized_upper_gamma(double a, double x) {
  if (!(x > 0)) return 1;
  const double front = std::exp(a * std::log(x) - x - std::lgamma(a));
  constexpr double kEnough = 1e-16;
  if (x < a + 1) {
    double term = 1 / a, sum = term;
    for (double n = a + 1; term > kEnough * sum; n += 1) {
      term *= x / n;
      sum += term;
    }
    return 1 - front * sum;
  }
  constexpr double kTiny = 1e-300;  // replaces a zero denominator
  double b = x + 1 - a, c = 1 / kTiny, d = 1 / b, product = d;
  for (int i = 1; i < 100'000; ++i) {
    const double numerator = -i * (i - a);
    b += 2;
    d = numerator * d + b;
    d = 1 / (d == 0 ? kTiny : d);
    c = b + numerator / c;
    if (c == 0) c = kTiny;
    product *= c * d;
    if (std::fabs(c * d - 1) < 1e-15) break;
  }
  return front * product;
}

double chi2_p_value(double statistic, int freedom) { return regularized_upper_gamma(0.5 * freedom, 0.5 * statistic); }

double sidak_level(double significance, int tests) { return -std::expm1(std::log1p(-significance) / tests); }

namespace {

// The sphere as the unit square: x the azimuth, y the area from the pole, stretched so that half of it is a given cap.
struct Cells {
  Frame frame;
  double w2;  // squared tangent of half the cap's angle

  Vec3d direction(double x, double y) const {
    const double area = w2 * y / (1 - y + w2 * y);
    const double phi = 2 * std::numbers::pi * x, sine = 2 * std::sqrt(area * (1 - area));
    return frame.to_world({sine * std::cos(phi), sine * std::sin(phi), 1 - 2 * area});
  }
  double solid_angle_per_square(double y) const {
    const double d = 1 - y + w2 * y;
    return 4 * std::numbers::pi * w2 / (d * d);
  }
  std::array<double, 2> coordinates(Vec3d l) const {
    const Vec3d p = frame.to_local(l);
    const double x = std::atan2(p.y, p.x) / (2 * std::numbers::pi);
    // Squares of tangents of half angles are computed from the sine on the side where 1 - cosine would cancel.
    const double sine2 = p.x * p.x + p.y * p.y;
    const double t2 = p.z > 0 ? sine2 / ((1 + p.z) * (1 + p.z)) : (1 - p.z) * (1 - p.z) / std::max(sine2, 1e-300);
    return {x < 0 ? x + 1 : x, t2 / (t2 + w2)};
  }
};

struct Rectangle {
  double x0, x1, y0, y1;
};

template <class F>
double gauss_3x3(const F& f, const Rectangle& r) {
  static constexpr double kNode = 0.774596669241483377, kWeights[3] = {5.0 / 18, 8.0 / 18, 5.0 / 18};
  double sum = 0;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      sum += kWeights[i] * kWeights[j] *
             f(0.5 * (r.x0 + r.x1) + 0.5 * (r.x1 - r.x0) * (i - 1) * kNode, 0.5 * (r.y0 + r.y1) + 0.5 * (r.y1 - r.y0) * (j - 1) * kNode);
  return sum * (r.x1 - r.x0) * (r.y1 - r.y0);
}

struct Integral {
  double value = 0;
  double error = 0;  // difference that remained at the greatest depth: along jumps of the density
};

// Halves both sides until the quarters agree with the whole. The first halvings are unconditional: nine points may all miss a light. The
// depth bounds the work along a light's outline.
template <class F>
Integral integrate(const F& f, const Rectangle& r, double whole, double tolerance, int depth) {
  constexpr int kDepth = 9, kForced = 3;
  const double x = 0.5 * (r.x0 + r.x1), y = 0.5 * (r.y0 + r.y1);
  const Rectangle quarters[4] = {{r.x0, x, r.y0, y}, {x, r.x1, r.y0, y}, {r.x0, x, y, r.y1}, {x, r.x1, y, r.y1}};
  double parts[4], sum = 0;
  for (int i = 0; i < 4; ++i) sum += parts[i] = gauss_3x3(f, quarters[i]);
  const double error = std::fabs(sum - whole);
  if (depth == kDepth || (depth >= kForced && error < tolerance)) return {sum, error};
  Integral total;
  for (int i = 0; i < 4; ++i) {
    const Integral part = integrate(f, quarters[i], parts[i], 0.5 * tolerance, depth + 1);
    total.value += part.value;
    total.error += part.error;
  }
  return total;
}

}  // namespace

Chi2Result chi2_test(const std::function<Vec3d(double, double)>& sample, const std::function<double(Vec3d)>& pdf,
                     const Chi2Options& options) {
  const double half_tangent = std::tan(std::min(0.5 * options.width, 1.5));
  const Cells cells{Frame::from_normal(normalized(options.axis)), half_tangent * half_tangent};
  const int cell_count = options.rings * options.columns;
  std::vector<double> expected, counted(static_cast<std::size_t>(cell_count) + 1, 0.0);

  Chi2Result result;
  const auto density = [&](double x, double y) { return pdf(cells.direction(x, y)) * cells.solid_angle_per_square(y); };
  double integration_error = 0;
  for (int ring = 0; ring < options.rings; ++ring)
    for (int column = 0; column < options.columns; ++column) {
      const Rectangle r{double(column) / options.columns, double(column + 1) / options.columns, double(ring) / options.rings,
                        double(ring + 1) / options.rings};
      // The tolerance is a tenth of a sample: far below the deviation of any cell that is not pooled.
      const Integral p = integrate(density, r, 0, 0.1 / options.samples, 0);
      result.expected_total += p.value;
      integration_error += p.error;
      expected.push_back(p.value * options.samples);
    }
  const double lack = 1 - result.expected_total;
  expected.push_back(lack > integration_error ? lack * options.samples : 0);

  Random random(options.seed);
  for (int i = 0; i < options.samples; ++i) {
    const double u = random.uniform(), v = random.uniform();
    const Vec3d l = sample(u, v);
    std::size_t cell = static_cast<std::size_t>(cell_count);
    if (!(l == Vec3d{})) {
      const auto [x, y] = cells.coordinates(l);
      const int column = std::min(static_cast<int>(x * options.columns), options.columns - 1);
      const int ring = std::min(static_cast<int>(y * options.rings), options.rings - 1);
      cell = static_cast<std::size_t>(ring * options.columns + column);
    }
    counted[cell] += 1;
  }

  double pooled_expected = 0, pooled_counted = 0, worst = 0;
  int used = 0;
  const auto add = [&](double e, double c, const std::string& name) {
    const double term = (c - e) * (c - e) / e;
    result.statistic += term;
    ++used;
    if (term > worst) {
      worst = term;
      result.evidence = "worst cell " + name + ": expected " + std::to_string(e) + ", counted " + std::to_string(c);
    }
  };
  for (std::size_t i = 0; i < expected.size(); ++i) {
    if (expected[i] >= 5) {
      add(expected[i], counted[i],
          i + 1 == expected.size() ? "of no direction"
                                   : "ring " + std::to_string(i / static_cast<std::size_t>(options.columns)) + " column " +
                                         std::to_string(i % static_cast<std::size_t>(options.columns)));
    } else {
      pooled_expected += expected[i];
      pooled_counted += counted[i];
    }
  }
  // Fewer than 5 are expected even together: their counts are then too few for the test, but there must not be many.
  if (pooled_expected >= 5 || pooled_counted > 25) add(std::max(pooled_expected, 1e-3), pooled_counted, "(pooled)");
  result.freedom = std::max(used - 1, 1);
  result.p_value = chi2_p_value(result.statistic, result.freedom);
  result.evidence = "p = " + std::to_string(result.p_value) + ", chi2 = " + std::to_string(result.statistic) + " with " +
                    std::to_string(result.freedom) + " degrees of freedom, density integrates to " + std::to_string(result.expected_total) +
                    "; " + result.evidence;
  return result;
}

}  // namespace steradian::reference
