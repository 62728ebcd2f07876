// Exchange areas of unobstructed pairs against published constants, the dilogarithm form and laws that hold for any pair.
#include "exchange/pairs/pair.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "exchange/pairs/edge_pair.h"
#include "exchange/pairs/gauss_rules.h"
#include "steradian/error.h"
#include "support/exchange_faces.h"

namespace steradian::exchange::pair_test {
namespace {

constexpr double kPi = std::numbers::pi;

PlaneElement parallelogram(Vec3d corner, Vec3d a, Vec3d b) {
  return make_element({corner, corner + a, corner + a + b, corner + b}, {}, "element");
}
PlaneElement triangle(Vec3d a, Vec3d b, Vec3d c) { return make_element({a, b, c}, {}, "element"); }

struct KnownPair {
  std::string name;
  PlaneElement from, to;
  double factor;  // from the first to the second
};

KnownPair facing(double x, double y, double distance, double factor) {
  return {"C-11 " + std::to_string(x) + " x " + std::to_string(y) + " x " + std::to_string(distance),
          parallelogram({0, 0, 0}, {x, 0, 0}, {0, y, 0}), parallelogram({0, 0, distance}, {0, y, 0}, {x, 0, 0}), factor};
}
// A floor of width `w` and a wall of height `h` at `degrees` to it, with an edge of length 1 in common.
KnownPair hinged(double h, double w, double degrees, double factor) {
  const double angle = degrees * kPi / 180;
  return {"common edge, " + std::to_string(degrees) + " degrees", parallelogram({0, 0, 0}, {1, 0, 0}, {0, w, 0}),
          parallelogram({0, 0, 0}, {0, h * std::cos(angle), h * std::sin(angle)}, {1, 0, 0}), factor};
}

// Constants of 30-digit arithmetic; the names C-11, C-13 and C-14 are those of Howell's catalogue of configuration factors.
std::vector<KnownPair> known_pairs() {
  const Vec3d o{}, x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1}, a{1, 1, 1}, b{1, -1, -1}, c{-1, 1, -1}, d{-1, -1, 1};
  return {facing(1, 1, 1, 0.1998248956983873830416),
          facing(2, 3, 1, 0.4755764365329529199),
          facing(10, 10, 1, 0.8269945223972565779),
          facing(0.1, 0.1, 1, 0.003162056838757601625),
          hinged(1, 1, 90, 0.2000437760754031542396),
          hinged(2, 0.5, 90, 0.3146010820239230480),
          {"C-13", parallelogram(o, x, y), parallelogram({2, 1, 1}, y, x), 0.01052032998247644364},
          hinged(1, 1, 30, 0.6190283230908032534),
          hinged(1, 1, 120, 0.08661500111827605883),
          {"corner tetrahedron, right to right", triangle(o, x, y), triangle(o, y, z), (3 - std::sqrt(3.0)) / 6},
          {"corner tetrahedron, right to slanted", triangle(o, x, y), triangle(x, z, y), 1 / std::sqrt(3.0)},
          {"regular tetrahedron", triangle(a, c, b), triangle(a, b, d), 1.0 / 3},
          {"skew triangles", triangle(o, x * 2.0, y), triangle({0, 0, 1}, {1, 2, 2}, {3, 1, 1}), 0.163354185067206912314},
          {"square over a corner", parallelogram({0, 0, 0.5}, y * 0.5, x * 0.5), parallelogram(o, x, y), 0.4152532835771467354}};
}

TEST(ExchangeArea, HasThePublishedFactors) {
  for (const KnownPair& k : known_pairs())
    for (const double eps : {1e-4, 1e-6, 1e-10, 1e-14}) {
      const ExchangeArea there = exchange_area(k.from, k.to, eps), back = exchange_area(k.to, k.from, eps);
      for (const ExchangeArea& h : {there, back}) {
        const double factor = h.value / k.from.area, error = std::fabs(factor - k.factor);
        // The constants are rounded to double.
        EXPECT_LE(error, h.error / k.from.area + 0x1p-53) << k.name << " at eps " << eps;
        EXPECT_LE(h.error, std::max(eps, 1e-12) * h.value) << k.name;
        if (eps == 1e-14) {
          EXPECT_LE(error, 1e-12 * k.factor) << k.name;
        }
      }
    }
}

// The closed form with dilogarithms, in long double: the oracle for edges in general position.
using Extended = long double;
using Complex = std::complex<Extended>;

Complex dilogarithm(Complex z) {
  const Extended pi = std::numbers::pi_v<Extended>;
  if (z == Complex(1)) return pi * pi / 6;
  if (z.real() > Extended(0.5)) return -dilogarithm(Complex(1) - z) + pi * pi / 6 - std::log(z) * std::log(Complex(1) - z);
  // Bernoulli's numbers over factorials: the series in u = -ln(1 - z).
  static const std::vector<Extended> coefficients = [] {
    std::vector<Extended> bernoulli, result;
    for (int n = 0; n <= 48; ++n) {
      Extended b = n == 0 ? 1 : 0, binomial = 1;
      for (int k = 0; k < n; ++k) {
        b -= binomial * bernoulli[static_cast<std::size_t>(k)] / static_cast<Extended>(n - k + 1);
        binomial = binomial * static_cast<Extended>(n - k) / static_cast<Extended>(k + 1);
      }
      bernoulli.push_back(b);
    }
    Extended factorial = 1;
    for (int n = 0; n <= 48; ++n) {
      factorial *= static_cast<Extended>(n + 1);
      result.push_back(bernoulli[static_cast<std::size_t>(n)] / factorial);
    }
    return result;
  }();
  const Complex u = -std::log(Complex(1) - z);
  Complex power = u, sum = 0;
  for (const Extended c : coefficients) {
    sum += c * power;
    power *= u;
  }
  return sum;
}

Extended along_corner(Extended x, Extended l, Extended h, Extended sine) {
  const Extended d = std::fabs(x) * sine, q = std::sqrt(h * h + d * d), r2 = h * h + d * d + l * l;
  Extended s = x / 4 * (l * std::log(r2) - 3 * l + 2 * q * std::atan(l / q));
  const Extended k = d / h, angle = std::atan2(l, d), m = 1 / ((std::sqrt(1 + k * k) + k) * (std::sqrt(1 + k * k) + k));
  const Complex turn = std::polar(Extended(1), 2 * angle);
  const Extended u = 2 * angle * std::asinh(k) - dilogarithm(-m * turn).imag() + dilogarithm(-turn).imag();
  s += (x < 0 ? -1 : 1) * h * h / (4 * sine) * u;
  return s;
}

Extended dilogarithm_form(Vec3d p0, Vec3d p1, Vec3d q0, Vec3d q1) {
  const Extended a = static_cast<Extended>(length(p1 - p0)), b = static_cast<Extended>(length(q1 - q0));
  const Vec3d u = normalized(p1 - p0), v = normalized(q1 - q0), n = cross(u, v), w = q0 - p0;
  const Extended c = static_cast<Extended>(dot(u, v)), sine2 = static_cast<Extended>(dot(n, n)), sine = std::sqrt(sine2);
  const Extended h = static_cast<Extended>(std::fabs(dot(w, n))) / sine;
  const Extended x0 = -static_cast<Extended>(dot(cross(w, v), n)) / sine2, y0 = -static_cast<Extended>(dot(cross(w, u), n)) / sine2;
  const auto corner = [&](Extended x, Extended y) { return along_corner(x, y - c * x, h, sine) + along_corner(y, x - c * y, h, sine); };
  return corner(x0 + a, y0 + b) - corner(x0 + a, y0) - corner(x0, y0 + b) + corner(x0, y0);
}

TEST(EdgePair, AgreesWithTheDilogarithmForm) {
  std::mt19937 random(45);
  double worst = 0;
  for (int i = 0; i < 2000; ++i) {
    const Vec3d p0 = random_place(random), p1 = random_place(random), q0 = random_place(random), q1 = random_place(random);
    const double sine = length(cross(normalized(p1 - p0), normalized(q1 - q0)));
    if (sine < 0.1 || length(p1 - p0) < 0.1 || length(q1 - q0) < 0.1) continue;
    const LogIntegral j = integrate_log(p0, p1, q0, q1, 1e-15);
    // The oracle's input is rounded to double: directions by 2^-53, lengths from the feet by the extent over the sine squared.
    const double oracle = 64 * 0x1p-53 / (sine * sine);
    const double error = std::fabs(j.value - static_cast<double>(dilogarithm_form(p0, p1, q0, q1)));
    worst = std::max(worst, error - j.error - oracle);
    EXPECT_LE(error, j.error + oracle) << i << ": " << j.value;
  }
  RecordProperty("worst", std::to_string(worst));
}

TEST(EdgePair, ClosedFormsAgreeWithPanels) {
  // Panels down to 1e-9 of the edge serve every pair, so that they judge the closed forms for edges in contact.
  const Vec3d o{}, x{1, 0, 0}, tilted = normalized(Vec3d{0.3, 0.8, 0});
  const auto by_panels = [](Vec3d p0, Vec3d p1, Vec3d q0, Vec3d q1) {
    // Out of the plane by a little more than what counts as contact.
    const Vec3d off{0, 0, 1e-12};
    return integrate_log(p0, p1, q0 + off, q1 + off * 1.5, 1e-14).value;
  };
  EXPECT_NEAR(meeting_log_integral(o, x, o, tilted), by_panels(o, x, o, tilted), 1e-11);
  EXPECT_NEAR(meeting_log_integral(o, x, tilted, o), by_panels(o, x, tilted, o), 1e-11);
  EXPECT_NEAR(meeting_log_integral(o, x, x * 0.5, x * 0.5 + tilted), by_panels(o, x, x * 0.5, x * 0.5 + tilted), 1e-11);
  EXPECT_NEAR(meeting_log_integral(o, x, x * 3.0, x * 3.0 + tilted), by_panels(o, x, x * 3.0, x * 3.0 + tilted), 1e-11);
  EXPECT_NEAR(parallel_log_integral(o, x, o, x), by_panels(o, x, o, x), 1e-11);
  EXPECT_NEAR(parallel_log_integral(o, x, x, o), by_panels(o, x, x, o), 1e-11);
  EXPECT_NEAR(parallel_log_integral(o, x, x * 0.3, x * 2.0), by_panels(o, x, x * 0.3, x * 2.0), 1e-11);
  EXPECT_NEAR(parallel_log_integral(o, x, x * 2.0, x * 0.3), by_panels(o, x, x * 2.0, x * 0.3), 1e-11);
}

TEST(ExchangeArea, ClosesRandomTetrahedra) {
  std::mt19937 random(7);
  for (int i = 0; i < 2000; ++i) {
    Vec3d v[4];
    for (Vec3d& p : v) p = random_place(random);
    if (dot(cross(v[1] - v[0], v[2] - v[0]), v[3] - v[0]) < 0) std::swap(v[0], v[1]);
    const PlaneElement faces[4] = {triangle(v[0], v[1], v[2]), triangle(v[0], v[3], v[1]), triangle(v[1], v[3], v[2]),
                                   triangle(v[2], v[3], v[0])};
    for (int f = 0; f < 4; ++f) {
      double sum = 0, error = 0;
      for (int g = 0; g < 4; ++g) {
        if (g == f) continue;
        const ExchangeArea h = exchange_area(faces[f], faces[g], 1e-12);
        sum += h.value;
        error += h.error;
      }
      EXPECT_LE(std::fabs(sum - faces[f].area), error + 1e-15 * faces[f].area) << "tetrahedron " << i << ", face " << f;
    }
  }
}

TEST(ExchangeArea, IsTheSumOverPartsAndKeepsItsScale) {
  std::mt19937 random(11);
  for (int i = 0; i < 200; ++i) {
    const PlaneElement a = parallelogram(random_place(random), random_place(random), random_place(random));
    const PlaneElement b = parallelogram(random_place(random), random_place(random), random_place(random));
    const ExchangeArea whole = exchange_area(a, b, 1e-10);
    ExchangeArea parts;
    const Vec3d through = a.centroid + (a.half_a + a.half_b) * 0.1, across = cross(a.normal, a.half_a + a.half_b * 0.3);
    for (const int side : {1, -1}) {
      const ExchangeArea part = exchange_area(cut_element(a, through, normalized(across), side), b, 1e-10);
      parts.value += part.value;
      parts.error += part.error;
    }
    EXPECT_LE(std::fabs(whole.value - parts.value), whole.error + parts.error + 1e-15) << i;
    for (const double scale : {1e-6, 1e6}) {
      const auto scaled = [scale](const PlaneElement& e) {
        std::vector<Vec3d> corners;
        for (const Vec3d& v : e.contours[0]) corners.push_back(v * scale);
        return make_element(corners, {}, "element");
      };
      const ExchangeArea s = exchange_area(scaled(a), scaled(b), 1e-10);
      EXPECT_LE(std::fabs(s.value / (scale * scale) - whole.value), whole.error + s.error / (scale * scale) + 1e-15) << i;
    }
  }
}

// The kernel by rays of Gauss rules far away, with a hole: a polygon that no product serves.
TEST(ExchangeArea, TakesHoles) {
  const Vec3d x{1, 0, 0}, y{0, 1, 0};
  const PlaneElement outer = parallelogram({0, 0, 0}, x, y), hole = parallelogram({0.25, 0.25, 0}, x * 0.5, y * 0.5);
  const PlaneElement ring = make_element(outer.contours[0], {hole.contours[0]}, "ring");
  const PlaneElement above = parallelogram({0.1, 0.2, 0.7}, y, x);
  EXPECT_DOUBLE_EQ(ring.area, 0.75);
  const ExchangeArea all = exchange_area(outer, above, 1e-12), inner = exchange_area(hole, above, 1e-12),
                     r = exchange_area(ring, above, 1e-12);
  EXPECT_LE(std::fabs(r.value - (all.value - inner.value)), r.error + all.error + inner.error);
}

TEST(ExchangeArea, IsZeroBehindAndInThePlane) {
  const Vec3d x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};
  const PlaneElement floor = parallelogram({0, 0, 0}, x, y), beside = parallelogram({1, 0, 0}, x, y),
                     below = parallelogram({0, 0, -1}, y, x);
  EXPECT_EQ(exchange_area(floor, beside, 1e-10).value, 0);
  EXPECT_EQ(exchange_area(floor, below, 1e-10).value, 0);
  EXPECT_EQ(exchange_area(floor, parallelogram({0, 0, 1}, x, y), 1e-10).value, 0);  // faces away
  // A wall that passes through the plane of the floor counts with its upper half.
  const PlaneElement wall = parallelogram({0, 0, -1}, z * 2.0, x), half = parallelogram({0, 0, 0}, z, x);
  const ExchangeArea cut = exchange_area(floor, wall, 1e-12), upper = exchange_area(floor, half, 1e-12);
  EXPECT_NEAR(cut.value, upper.value, cut.error + upper.error);
}

TEST(ExchangeArea, ProductBoundHolds) {
  std::mt19937 random(3);
  for (int i = 0; i < 300; ++i) {
    const Vec3d way = normalized(random_place(random));
    const PlaneElement a =
        i % 2 ? parallelogram({}, random_place(random), random_place(random)) : triangle({}, random_place(random), random_place(random));
    const Vec3d corner = way * 6.0;
    const PlaneElement b = parallelogram(corner, random_place(random), random_place(random));
    const PlaneElement front = in_front_of(a, b), other = in_front_of(b, a);
    if (front.area != a.area || other.area != b.area) continue;
    const double exact = exchange_by_product(a, b, 6).value;
    for (int m = 1; m < 5; ++m) {
      const ExchangeArea h = exchange_by_product(a, b, m);
      EXPECT_LE(std::fabs(h.value - exact), h.error) << i << " with " << m;
    }
  }
}

TEST(GaussRules, IntegratePowers) {
  for (int n = 1; n <= kMostNodes; ++n)
    for (int power = 0; power < 2 * n; ++power) {
      double sum = 0;
      for (std::size_t i = 0; i < gauss_rule(n).node.size(); ++i) sum += gauss_rule(n).weight[i] * std::pow(gauss_rule(n).node[i], power);
      EXPECT_NEAR(sum, 1.0 / (power + 1), 4e-16) << n << " nodes, power " << power;
    }
}

TEST(PlaneElement, RefusesWhatIsNoPlanePolygon) {
  const Vec3d o{}, x{1, 0, 0}, y{0, 1, 0};
  EXPECT_THROW(make_element({o, x}, {}, "face"), Error);
  EXPECT_THROW(make_element({o, x, x * 2.0}, {}, "face"), Error);
  EXPECT_THROW(make_element({o, x, {1, 1, 0.1}, y}, {}, "face"), Error);
  EXPECT_THROW(make_element({o, x, {1, NAN, 0}}, {}, "face"), Error);
  EXPECT_THROW(make_element({o, x, {1, 1e60, 0}}, {}, "face"), Error);
  EXPECT_THROW(make_element({o, x * 1e-60, y * 1e-60}, {}, "face"), Error);
  EXPECT_TRUE(is_bent({o, x, {1, 1, 0.1}, y}));
  EXPECT_FALSE(is_bent({o, x, {1, 1, 1e-7}, y}));
}

}  // namespace
}  // namespace steradian::exchange::pair_test
