// The kernels ltc_*: the walk against quadrature of the transformed lobe over the part above both horizons.
#include <algorithm>
#include <array>
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <vector>

#include "core/random.h"
#include "fit/fit.h"
#include "integrals/ggx/ltc_radiance.h"
#include "reference/spherical_region.h"
#include "steradian/kernels.h"
#include "support/random_configurations.h"

namespace steradian::ltc_kernel_test {
namespace {

using namespace fit;

// Gauss-Legendre on [0, 1] by Newton's method on Legendre's polynomial.
struct Rule {
  std::vector<double> x, w;
  explicit Rule(int n) {
    for (int i = 0; i < n; ++i) {
      double t = std::cos(std::numbers::pi * (i + 0.75) / (n + 0.5)), derivative = 1;
      for (int iteration = 0; iteration < 20; ++iteration) {
        double p = 1, previous = 0;
        for (int k = 1; k <= n; ++k) {
          const double next = ((2 * k - 1) * t * p - (k - 1) * previous) / k;
          previous = p;
          p = next;
        }
        derivative = n * (t * p - previous) / (t * t - 1);
        t -= p / derivative;
      }
      x.push_back(0.5 * (1 + t));
      w.push_back(1 / ((1 - t * t) * derivative * derivative));
    }
  }
};

template <class S>
typename Kernels<S>::LtcMatrix matrix(const LtcInverse& m) {
  typename Kernels<S>::LtcMatrix k;
  k.xx = m.xx, k.xz = m.xz, k.yy = m.yy, k.zx = m.zx, k.zz = m.zz;
  return k;
}

template <class S>
double walk(const PreparedPolygon& light, const LtcInverse& inverse, bool reversed = false) {
  Kernels<S> k;
  const auto m = matrix<S>(inverse);
  auto state = k.ltc_begin();
  for (std::size_t c = 0; c + 1 < light.contours.size(); ++c) {
    const std::size_t begin = light.contours[c], n = light.contours[c + 1] - begin;
    for (std::size_t i = 0; i < n; ++i) {
      const Vec3d va = light.vertices[begin + i], vb = light.vertices[begin + (i + 1) % n];
      const auto a = k.polygon_direction({va.x, va.y, va.z}), b = k.polygon_direction({vb.x, vb.y, vb.z});
      state = k.ltc_add_edge(state, m, a, b, k.ltc_direction(m, a), k.ltc_direction(m, b));
    }
  }
  return static_cast<double>(k.ltc_integral(state, Mask<S>(reversed)).v);
}

// Signed fan about a direction above both horizons, over arcs that are cut into short ones. The density is homogeneous of degree -3, so the
// chords' triangles serve as well as the sphere's. It is smooth on all of the upper half space.
double quadrature(const PreparedPolygon& light, const LtcInverse& m) {
  static const Rule rule(40);
  const Vec3d planes[] = {{0, 0, 1}, normalized(Vec3d{m.zx, 0, m.zz})};
  reference::SphericalRegion region;
  region.assign(light, {}, Frame{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, planes, 2);
  const double determinant = m.yy * (m.xx * m.zz - m.xz * m.zx);
  const Vec3d apex = normalized(planes[0] + planes[1]);
  double sum = 0;
  for (const reference::Arc& arc : region.arcs) {
    const Vec3d across = cross(arc.normal, arc.a);
    const auto at = [&](double t) { return arc.a * std::cos(t * arc.angle) + across * std::sin(t * arc.angle); };
    constexpr int kParts = 8;
    for (int part = 0; part < kParts; ++part) {
      const Vec3d a = at(part / double(kParts)), b = at((part + 1) / double(kParts));
      const double volume = dot(cross(a, b), apex);
      double inner = 0;
      for (std::size_t i = 0; i < rule.x.size(); ++i)
        for (std::size_t j = 0; j < rule.x.size(); ++j) {
          const double u = rule.x[i], v = rule.x[j];
          const Vec3d p = apex * (1 - u) + (a * (1 - v) + b * v) * u;
          const Vec3d w = {m.xx * p.x + m.xz * p.z, m.yy * p.y, m.zx * p.x + m.zz * p.z};
          const double d2 = dot(w, w);
          inner += rule.w[i] * rule.w[j] * u * w.z / (d2 * d2);
        }
      sum += volume * inner;
    }
  }
  return sum * determinant / std::numbers::pi;
}

// Tilts, shears and widths as in the fits, except the narrow ones, for which a fixed rule fails.
LtcInverse random_matrix(reference::Random& random) {
  LtcShape shape;
  shape.e11 = random.uniform(0.6, 2.5);
  shape.e02 = random.uniform(-1, 1);
  shape.e20 = random.uniform(-1, 1);
  shape.e00 = random.uniform(0.6, 2.5) + shape.e02 * shape.e20;
  const double z = random.uniform(0.2, 1);
  return ltc_inverse(shape, LobeFrame::mirror, 1.0, view_from_cosine(z));
}

// Stars with deep notches cross the horizons many times; holes do too.
PreparedPolygon random_light(reference::Random& random, int i) {
  const Vec3d z = reference::random_direction(random);
  const Frame frame = Frame::from_normal(z);
  PolygonLight light;
  const Vec3d centre = -z + frame.to_world({random.uniform(-0.7, 0.7), random.uniform(-0.7, 0.7), 0});
  light.vertices = reference::random_star(random, frame, centre, random.uniform(0.3, 2), 3 + i % 9, i % 2 ? 0.2 : 0.9);
  if (i % 3 == 0) {
    light.vertices = reference::random_star(random, frame, centre, 1.5, 8, 0.8);
    light.holes.push_back(reference::random_star(random, frame, centre, 0.45, 7, 0.2));
  }
  light.two_sided = true;
  return prepare_polygon(light);
}

}  // namespace

TEST(LtcWalk, IsTheLobesIntegralOverWhatBothHorizonsLeave) {
  reference::Random random(11);
  int both = 0;
  double worst = 0;
  for (int i = 0; i < 300; ++i) {
    const PreparedPolygon light = random_light(random, i);
    const LtcInverse m = random_matrix(random);
    if (light.side_of({}) <= 0) continue;
    const double expected = quadrature(light, m), found = walk<double>(light, m);
    const auto crosses = [&](Vec3d n) {
      const auto below = [&](const Vec3d& v) { return dot(v, n) < 0; };
      const auto count = std::count_if(light.vertices.begin(), light.vertices.end(), below);
      return count > 0 && count < static_cast<long>(light.vertices.size());
    };
    both += crosses({0, 0, 1}) && crosses({m.zx, 0, m.zz});
    worst = std::max(worst, std::fabs(found - expected));
    EXPECT_NEAR(found, expected, 1e-12) << "light " << i << " m " << m.xx << " " << m.xz << " " << m.yy << " " << m.zx << " " << m.zz;
    EXPECT_NEAR(walk<float>(light, m), expected, 4e-6) << "light " << i;
  }
  std::printf("lights that cross both horizons: %d, largest error %.2g\n", both, worst);
  EXPECT_GT(both, 40);
}

TEST(LtcWalk, GivesExactlyNothingToALightBelowTheHorizon) {
  reference::Random random(12);
  for (int i = 0; i < 300; ++i) {
    PreparedPolygon light = random_light(random, i);
    double top = -1;
    for (const Vec3d& v : light.vertices) top = std::max(top, v.z);
    for (Vec3d& v : light.vertices) v.z -= top + 1e-3;
    const LtcInverse m = random_matrix(random);
    for (bool reversed : {false, true}) {
      EXPECT_EQ(walk<double>(light, m, reversed), 0.0) << i;
      EXPECT_EQ(walk<float>(light, m, reversed), 0.0) << i;
    }
  }
}

TEST(LtcWalk, OfTheWholeSkyIsTheShareAboveTheHorizon) {
  reference::Random random(13);
  for (int i = 0; i < 50; ++i) {
    const LtcInverse m = random_matrix(random);
    // A ceiling so wide that only 1e-5 of the sky is missing.
    const double s = 1e6;
    const PreparedPolygon sky = prepare_polygon({{{-s, -s, 1}, {-s, s, 1}, {s, s, 1}, {s, -s, 1}}, {}, {1, 1, 1}, true});
    EXPECT_NEAR(walk<double>(sky, m), ltc_above_horizon(m), 1e-5);
    EXPECT_NEAR(Kernels<double>{}.ltc_energy_above_horizon(matrix<double>(m)).v, ltc_above_horizon(m), 1e-14);
  }
}

TEST(LtcMatrix, ClassicAndCompactFormsAreTheSameMap) {
  reference::Random random(14);
  Kernels<double> k;
  for (int i = 0; i < 100; ++i) {
    const LtcInverse m = random_matrix(random);
    Kernels<double>::vec4 t;
    t.x = m.xx / m.yy, t.y = m.zx / m.yy, t.z = m.xz / m.yy, t.w = m.zz / m.yy;
    const auto classic = k.ltc_from_classic(t);
    const auto l = k.polygon_direction({random.uniform(-1, 1), random.uniform(-1, 1), random.uniform()});
    const double expected = k.ltc_lobe(matrix<double>(m), l).v;
    EXPECT_NEAR(k.ltc_lobe(classic, l).v, expected, 1e-12 * (1 + expected));
  }
}

// M of the specification, R [alpha e0, 0, alpha e2; 0, alpha e1, 0; alpha e3, 0, 1], times its decoded inverse is a multiple of 1.
TEST(LtcMatrix, CompactDecodesTheInverse) {
  reference::Random random(15);
  for (int i = 0; i < 100; ++i) {
    const double alpha = std::pow(10.0, random.uniform(-4, 0)), cosine = random.uniform(0.01, 1);
    LtcShape e{2, random.uniform(0.5, 2), random.uniform(-0.5, 0.5), random.uniform(-2, 2)};
    const Vec3d v = view_from_cosine(cosine);
    const LtcInverse p = ltc_inverse(e, LobeFrame::mirror, alpha, v);
    const double c = v.z, s = v.x;
    // Rows of R are (c, 0, -s), (0, 1, 0), (s, 0, c).
    const double m00 = c * alpha * e.e00 - s * alpha * e.e20, m02 = c * alpha * e.e02 - s;
    const double m20 = s * alpha * e.e00 + c * alpha * e.e20, m22 = s * alpha * e.e02 + c, m11 = alpha * e.e11;
    const double unit = p.xx * m00 + p.xz * m20;
    EXPECT_GT(unit, 0);
    EXPECT_NEAR(p.zx * m02 + p.zz * m22, unit, 1e-12);
    EXPECT_NEAR(p.yy * m11, unit, 1e-12);
    EXPECT_NEAR(p.xx * m02 + p.xz * m22, 0, 1e-12);
    EXPECT_NEAR(p.zx * m00 + p.zz * m20, 0, 1e-12);
  }
}

TEST(ClippedSphere, IsItsQuadrature) {
  for (double cosine : {-0.9, -0.5, -0.2, 0.0, 0.1, 0.4, 0.8, 1.0})
    for (double f : {0.01, 0.1, 0.36, 0.7, 0.95}) {
      // Cap of sine squared f about an axis of that cosine: integral of max(z, 0), midpoints.
      const int n = 600;
      const double sine = std::sqrt(1 - cosine * cosine), cap = std::sqrt(1 - f);
      double sum = 0;
      for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
          const double h = 1 - (1 - cap) * (i + 0.5) / n, phi = std::numbers::pi * (j + 0.5) / n;
          sum += std::max(h * cosine + std::sqrt(1 - h * h) * std::cos(phi) * sine, 0.0);
        }
      const double expected = sum * 2 * std::numbers::pi * (1 - cap) / (n * n) / (std::numbers::pi * f);
      // The integrand has a kink; the midpoint rule's error there is a few times 1/n^2.
      EXPECT_NEAR(clipped_sphere_form_factor(cosine, f), expected, 2e-5) << cosine << " " << f;
    }
}

TEST(LtcClipless, IsExactForAFullViewAndFiniteForAll) {
  Kernels<double> k;
  const LtcInverse identity;
  const auto m = matrix<double>(identity);
  // For a small light overhead, sphere and polygon of one vector irradiance agree if nothing is cut.
  const std::array<Vec3d, 4> v = {{{-.1, -.1, 1}, {-.1, .1, 1}, {.1, .1, 1}, {.1, -.1, 1}}};
  auto sum = Kernels<double>::vec3(0.0, 0.0, 0.0);
  for (std::size_t i = 0; i < 4; ++i) {
    const auto a = v[i], b = v[(i + 1) % 4];
    sum = k.ltc_clipless_add_edge(sum, k.ltc_direction(m, {a.x, a.y, a.z}), k.ltc_direction(m, {b.x, b.y, b.z}));
  }
  const double clipless = std::fabs(k.ltc_clipless_integral(sum, Mask<double>(sum.z.v < 0)).v);
  const PreparedPolygon light = prepare_polygon({{v[0], v[1], v[2], v[3]}, {}, {1, 1, 1}, true});
  EXPECT_NEAR(clipless, std::fabs(walk<double>(light, identity, light.side_of({}) < 0)), 1e-12);
  EXPECT_EQ(k.ltc_clipless_integral({0.0, 0.0, 0.0}, Mask<double>(false)).v, 0.0);
}

TEST(LtcLayers, KeepTheirEnergyBudget) {
  Kernels<double> k;
  EXPECT_DOUBLE_EQ(k.ltc_multiple_scattering(1.0, 0.5).v * 0.5, 1.0);  // a white mirror of facets loses nothing
  EXPECT_DOUBLE_EQ(k.ltc_multiple_scattering(0.0, 0.5).v, 1.0);
  EXPECT_DOUBLE_EQ(k.ltc_clear_coat(0.7, 0.3, 0.0, 0.2).v, 0.7);
  EXPECT_NEAR(k.ltc_clear_coat(1.0, 0.04, 1.0, 1.0).v, 1.0, 1e-15);  // white on white at the normal
  EXPECT_DOUBLE_EQ(k.ltc_sheen(0.5, 0.0, 0.0, 0.9).v, 0.5);
  EXPECT_DOUBLE_EQ(k.ltc_sheen(1.0, 0.4, 1.0, 0.4).v, 1.0);
  EXPECT_DOUBLE_EQ(k.ltc_specular_scale(0.04, 1.0, 0.9, 0.1).v, 0.04 * 0.9 + 0.96 * 0.1);
  EXPECT_DOUBLE_EQ(k.ltc_specular_with_fresnel_lobe(0.04, 1.0, 0.9, 0.5, 0.1, 0.7).v, 0.04 * 0.45 + 0.96 * 0.07);
}

}  // namespace steradian::ltc_kernel_test
