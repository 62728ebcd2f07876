// Derivatives by the boundary (kernels/integral/slopes.glsl) against dual numbers, and against differences of adaptive quadrature.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/random.h"
#include "integrals/irradiance.h"
#include "integrals/tables/ggx_tables.h"
#include "shapes/polygon.h"
#include "steradian/dual.h"
#include "steradian/polygon_derivatives.h"
#include "steradian/radiance.h"
#include "steradian/reference.h"
#include "support/random_rectangles.h"

namespace steradian::slopes_test {
namespace {

using K = Kernels<double>;
using V = K::vec3;
using R12 = Real<Dual<12>>;
using ByVertex = std::array<Vec3d, 4>;

V kernel(Vec3d v) { return {v.x, v.y, v.z}; }
Vec3d world(V v) { return {v.x.v, v.y.v, v.z.v}; }

// The corners in walk order, seen from the origin.
std::array<Vec3d, 4> corners_of(const PolygonLight& light) {
  return {light.vertices[3], light.vertices[2], light.vertices[1], light.vertices[0]};
}

std::array<Vec3<R12>, 4> seeded(const std::array<Vec3d, 4>& corners) {
  std::array<Vec3<R12>, 4> result;
  for (std::size_t i = 0; i < 4; ++i) {
    result[i] = Vec3<R12>(corners[i].x, corners[i].y, corners[i].z);
    result[i].x.v.d[3 * i] = result[i].y.v.d[3 * i + 1] = result[i].z.v.d[3 * i + 2] = 1.0;
  }
  return result;
}

ByVertex derivatives_of(const Dual<12>& x) {
  ByVertex result;
  for (std::size_t i = 0; i < 4; ++i) result[i] = {x.d[3 * i], x.d[3 * i + 1], x.d[3 * i + 2]};
  return result;
}

double largest_of(const ByVertex& d) { return std::max({length(d[0]), length(d[1]), length(d[2]), length(d[3])}); }
double distance_of(const ByVertex& a, const ByVertex& b) { return largest_of({a[0] - b[0], a[1] - b[1], a[2] - b[2], a[3] - b[3]}); }

// The error as a fraction of the largest derivative. The judge's rounding is 1e-15 of `scale`: where a sliver of the light is above the
// horizon, its terms of order `scale` cancel. Bounds of 1e-12 are therefore for a thousand roundings.
double error_of(const ByVertex& got, const ByVertex& judge, double scale = 1) {
  return distance_of(got, judge) / (largest_of(judge) + 1e-3 * scale);
}

// The sum over the two edges of each vertex. edge(a, b): derivatives by the two ends' directions.
template <class Edge>
ByVertex by_vertices(const std::array<Vec3d, 4>& corners, Edge edge) {
  ByVertex sum{};
  for (std::size_t i = 0; i < 4; ++i) {
    const std::size_t j = (i + 1) % 4;
    const std::pair<Vec3d, Vec3d> d = edge(K().polygon_direction(kernel(corners[i])), K().polygon_direction(kernel(corners[j])));
    sum[i] += d.first / length(corners[i]);
    sum[j] += d.second / length(corners[j]);
  }
  return sum;
}

ByVertex lambert_slopes(const std::array<Vec3d, 4>& corners) {
  return by_vertices(corners, [](V a, V b) {
    const auto s = K().polygon_edge_slopes(a, b);
    return std::pair{world(s.normal * s.by_start), world(s.normal * s.by_end)};
  });
}

Dual<12> lambert_dual(const std::array<Vec3d, 4>& corners) {
  Kernels<Dual<12>> k;
  const auto v = seeded(corners);
  auto walk = k.polygon_begin();
  for (std::size_t i = 0; i < 4; ++i) walk = k.polygon_add_edge(walk, k.polygon_direction(v[i]), k.polygon_direction(v[(i + 1) % 4]));
  return k.polygon_irradiance(walk, k.mask_none()).v;
}

// A rectangle whose plane faces the origin; of every other one, the horizon cuts through.
ggx::Setup rectangle(reference::Random& random, int i) {
  for (;;) {
    ggx::Setup s = ggx::random_rectangle(random, 0.7, random.uniform(0, 70));
    int above = 0;
    for (const Vec3d& v : s.light.vertices) above += v.z > 0;
    if (i % 2 == 0 ? above == 4 : above > 0 && above < 4) return s;
  }
}

}  // namespace

TEST(Slopes, OfAngleOverSineAreTheDerivative) {
  Kernels<Dual<1>> k;
  for (int i = 0; i <= 1000; ++i) {
    const double c = 1 - 1.99 * i / 1000;
    Real<Dual<1>> x(c);
    x.v.d[0] = 1;
    const auto s2 = (1.0 - x) * (1.0 + x);
    const double judge = -k.trig_angle_over_sine(x, s2).v.d[0];
    const auto both = K().trig_angle_over_sine_and_slope(c, (1 - c) * (1 + c));
    EXPECT_EQ(both.x.v, K().trig_angle_over_sine(c, (1 - c) * (1 + c)).v) << c;
    EXPECT_NEAR(both.y.v, judge, 1e-12 * judge) << c;
    const float cf = static_cast<float>(c), s2f = (1 - cf) * (1 + cf);
    const float g = Kernels<float>().trig_angle_over_sine_and_slope(cf, s2f).y.v;
    EXPECT_NEAR(static_cast<double>(g), judge, 1e-5 * judge) << c;
  }
}

TEST(Slopes, OfLambertAreThoseOfDuals) {
  reference::Random random(1);
  double worst = 0;
  for (int i = 0; i < 1000; ++i) {
    const auto corners = corners_of(rectangle(random, i).light);
    const ByVertex judge = derivatives_of(lambert_dual(corners)), got = lambert_slopes(corners);
    worst = std::max(worst, error_of(got, judge));
  }
  std::printf("Lambert, 1000 rects: worst %.1e of the largest derivative\n", worst);
  EXPECT_LT(worst, 1e-12);
}

TEST(Slopes, OfTransformedCosinesAreThoseOfDuals) {
  reference::Random random(2);
  double worst = 0;
  for (int i = 0; i < 1000; ++i) {
    const ggx::Setup s = rectangle(random, i);
    const auto corners = corners_of(s.light);
    const double cosine = random.uniform(0.1, 1), sine = std::sqrt(1 - cosine * cosine), alpha = std::exp(random.uniform(-4, 0));
    const auto lobe = [&]<class S>(Kernels<S> k) {
      const double e[] = {1 + 0.3 * sine, 0.8, 0.2 * sine, -0.3 * sine};
      return k.ltc_from_compact(typename Kernels<S>::vec4(e[0], e[1], e[2], e[3]), alpha, typename Kernels<S>::vec3(sine, 0.0, cosine));
    };
    Kernels<Dual<12>> k;
    const auto dual_lobe = lobe(k);
    const auto v = seeded(corners);
    auto walk = k.ltc_begin();
    for (std::size_t n = 0; n < 4; ++n) {
      const auto a = k.polygon_direction(v[n]), b = k.polygon_direction(v[(n + 1) % 4]);
      walk = k.ltc_add_edge(walk, dual_lobe, a, b, k.ltc_direction(dual_lobe, a), k.ltc_direction(dual_lobe, b));
    }
    const ByVertex judge = derivatives_of(k.ltc_integral(walk, k.mask_none()).v);
    const auto m = lobe(K());
    const ByVertex got = by_vertices(corners, [&](V a, V b) {
      const auto d = K().ltc_edge_slopes(m, a, b);
      return std::pair{world(K().ltc_edge_transform_back(m, a, d.normal * d.by_start)),
                       world(K().ltc_edge_transform_back(m, b, d.normal * d.by_end))};
    });
    worst = std::max(worst, error_of(got, judge, 1 / alpha));
  }
  std::printf("LTC, 1000 rects: worst %.1e of the largest derivative\n", worst);
  EXPECT_LT(worst, 1e-12);
}

namespace {

ByVertex ggx_slopes(const ggx::Setup& s, double smith, int nodes, int pieces, double f0, double f90) {
  const auto view = K().ggx_view(kernel(s.at.view), s.material.alpha_x, s.material.alpha_y);
  return by_vertices(corners_of(s.light), [&](V a, V b) {
    const auto d = K().ggx_edge_slopes(view, a, b, smith, nodes, pieces);
    const auto channel = [&](K::vec2 x) { return K().ggx_radiance(x, f0, f90); };
    return std::pair{world(d.normal * channel(d.by_start)), world(d.normal * channel(d.by_end))};
  });
}

// Differences of fourth order of adaptive quadrature: truncation h^4 / 5 of the fifth derivative, rounding 1e-12 / h.
Vec3d reference_slope(const ggx::Setup& s, std::size_t vertex, double h) {
  Vec3d slope;
  ReferenceOptions options;
  options.relative_error = 1e-12;
  options.absolute_error = 1e-15;
  for (int axis = 0; axis < 3; ++axis) {
    const auto moved = [&](double by) {
      ggx::Setup m = s;
      Vec3d& v = m.light.vertices[vertex];
      (axis == 0 ? v.x : axis == 1 ? v.y : v.z) += by;
      // A quad with one moved vertex is not flat. Two triangles are, and share a diagonal through the neighbours of the vertex.
      double sum = 0;
      for (const std::size_t first : {vertex + 3, vertex + 1}) {
        PolygonLight triangle;
        for (std::size_t k = 0; k < 3; ++k) triangle.vertices.push_back(m.light.vertices[(first + k) % 4]);
        triangle.two_sided = true;
        sum += reference_radiance(prepare_polygon(triangle), m.at, m.material, options).radiance.x;
      }
      return sum;
    };
    (axis == 0 ? slope.x : axis == 1 ? slope.y : slope.z) = (8 * (moved(h) - moved(-h)) - (moved(2 * h) - moved(-2 * h))) / (12 * h);
  }
  return slope;
}

}  // namespace

// The boundary of a quad with one moved vertex is that of two triangles, whose diagonal cancels. 96 rects: the worst stands for the 99th
// percentile.
TEST(Slopes, OfGgxWithShadowingAndFresnelAreDifferencesOfQuadrature) {
  struct Rule {
    int nodes, pieces;
    double median, worst;  // as fractions of the light's largest derivative
  };
  for (const Rule& rule : {Rule{4, 1, 1e-4, 2e-2}, Rule{6, 1, 1e-5, 4e-3}, Rule{8, 4, 1e-10, 4e-3}}) {
    reference::Random random(3);
    std::vector<double> errors;
    for (int i = 0; i < 96; ++i) {
      ggx::Setup s = ggx::random_rectangle(random, i % 3 == 0 ? 0.3 : i % 3 == 1 ? 0.55 : 0.8, random.uniform(5, 75));
      s.material.f0 = {0.2, 0.2, 0.2};
      s.material.f90 = {0.9, 0.9, 0.9};
      const std::size_t vertex = static_cast<std::size_t>(i) % 4;
      const ByVertex got = ggx_slopes(s, 1, rule.nodes, rule.pieces, 0.2, 0.9);
      if (largest_of(got) < 1e-6) continue;
      errors.push_back(length(got[3 - vertex] - reference_slope(s, vertex, 2e-3 * s.material.alpha_x)) / largest_of(got));
    }
    std::sort(errors.begin(), errors.end());
    const double median = errors[errors.size() / 2], worst = errors.back();
    std::printf("GGX, %zu rects, %d x %d nodes: median %.1e, worst %.1e of the largest derivative\n", errors.size(), rule.pieces,
                rule.nodes, median, worst);
    EXPECT_GT(errors.size(), 80u);
    EXPECT_LT(median, rule.median);
    EXPECT_LT(worst, rule.worst);
  }
}

// Lights that cover up to half of the sky, at all views. The derivative by the view has a mean of shadowing and Fresnel inside. Over a
// whole wide light, this mean was wrong by as much as itself. In triangles of half a radian, the specification's 1e-3 holds for nine of
// ten.
TEST(Slopes, OfGgxByTheViewUnderWideLightsAreDifferencesOfQuadrature) {
  reference::Random random(5);
  std::vector<double> errors;
  for (int i = 0; i < 60; ++i) {
    const double size = i % 2 == 0 ? random.uniform(0.5, 3) : 30;
    const Vec3d center{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(0.3, 1.5)};
    const Frame plane = Frame::from_normal(normalized(Vec3d{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)}));
    PolygonLight light;
    light.two_sided = true;
    for (int k = 0; k < 3 + i % 4; ++k) {
      const double angle = 2 * std::numbers::pi * k / (3 + i % 4) + 0.1;
      light.vertices.push_back(center + plane.x * (size * std::cos(angle)) + plane.y * (size * std::sin(angle)));
    }
    const double height = i % 3 == 0 ? random.uniform(0.02, 0.08) : random.uniform(0.2, 1), across = std::sqrt(1 - height * height);
    const double azimuth = random.uniform(0, 6), roughness = random.uniform(0.2, 1);
    const Vec3d view{across * std::cos(azimuth), across * std::sin(azimuth), height};
    Material m{.brdf = Brdf::ggx};
    m.alpha_x = m.alpha_y = roughness * roughness;
    m.f0 = {0.5, 0.5, 0.5};
    const PreparedPolygon prepared = prepare_polygon(light);
    const Frame about = Frame::from_normal(view);
    ReferenceOptions options;
    options.relative_error = 1e-10;
    const double step = 2e-3 * height;  // fourth order: 1e-11 of truncation, 1e-7 of the quadrature over the step
    const auto by_turn_to = [&](Vec3d aside) {
      const auto turned = [&](double angle) {
        return reference_radiance(prepared, {{}, {0, 0, 1}, view * std::cos(angle) + aside * std::sin(angle)}, m, options).radiance.x;
      };
      return (8 * (turned(step) - turned(-step)) - (turned(2 * step) - turned(-2 * step))) / (12 * step);
    };
    const double x = by_turn_to(about.x), y = by_turn_to(about.y), largest = std::hypot(x, y);
    if (largest < 1e-9) continue;
    const Vec3d got = radiance_derivatives(prepared, {{}, {0, 0, 1}, view}, m, Quality::high).view[0];
    errors.push_back(std::hypot(dot(got, about.x) - x, dot(got, about.y) - y) / largest);
  }
  std::sort(errors.begin(), errors.end());
  std::printf("GGX by the view, %zu wide lights: median %.1e, 90 %% %.1e, worst %.1e\n", errors.size(), errors[errors.size() / 2],
              errors[errors.size() * 9 / 10], errors.back());
  EXPECT_GT(errors.size(), 50u);
  EXPECT_LT(errors[errors.size() * 9 / 10], 1e-3);
  EXPECT_LT(errors.back(), 1e-2);
}

// Edges from 1e-4 to 3 long, seen at up to 88 degrees, from the same directions rounded to float. The bound is that of a short edge: its
// direction loses 6e-8 / 1e-4 to rounding.
TEST(Slopes, OfGgxKeepTheirDigitsInFloat) {
  reference::Random random(5);
  std::vector<double> errors;
  for (int i = 0; i < 4000; ++i) {
    ggx::Setup s = ggx::random_rectangle(random, std::exp(random.uniform(std::log(0.15), 0)), random.uniform(0, 88));
    const Vec3d middle = (s.light.vertices[0] + s.light.vertices[2]) * 0.5;
    const double size = std::exp(random.uniform(std::log(1e-3), 0));
    for (Vec3d& v : s.light.vertices) v = middle + (v - middle) * size;
    const auto slopes = [&]<class S>(Kernels<S> k) {
      const auto rounded = [](Vec3d v) {
        const Vec3d u = normalized(v);
        return typename Kernels<S>::vec3(static_cast<float>(u.x), static_cast<float>(u.y), static_cast<float>(u.z));
      };
      const auto view = k.ggx_view(rounded(s.at.view), s.material.alpha_x, s.material.alpha_y);
      ByVertex sum{};
      const auto corners = corners_of(s.light);
      for (std::size_t n = 0; n < 4; ++n) {
        const auto d = k.ggx_edge_slopes(view, rounded(corners[n]), rounded(corners[(n + 1) % 4]), 1.0, 4, 1);
        const auto add = [&](Vec3d& to, const auto& v) { to += Vec3d{v.x.v, v.y.v, v.z.v}; };
        add(sum[n], d.normal * d.by_start.x);
        add(sum[(n + 1) % 4], d.normal * d.by_end.x);
      }
      return sum;
    };
    const ByVertex judge = slopes(Kernels<double>()), got = slopes(Kernels<float>());
    ASSERT_TRUE(std::isfinite(largest_of(got))) << i;
    if (largest_of(judge) > 0) errors.push_back(distance_of(got, judge) / largest_of(judge));
  }
  std::sort(errors.begin(), errors.end());
  const double high = errors[errors.size() * 99 / 100];
  std::printf("GGX in float, %zu rects: median %.1e, 99 %% %.1e, worst %.1e\n", errors.size(), errors[errors.size() / 2], high,
              errors.back());
  EXPECT_LT(high, 1e-3);
}

}  // namespace steradian::slopes_test
