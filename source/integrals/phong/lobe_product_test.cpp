// Products of cosine lobes: the exact double-axis moment, and one lobe instead of many, against cubature.
#include <cmath>
#include <fstream>
#include <gtest/gtest.h>
#include <numbers>
#include <string>

#include "integrals/integrate.h"
#include "integrals/phong/exact_moment.h"
#include "integrals/phong/phong.h"
#include "paths.h"
#include "steradian/phong.h"
#include "support/adversarial_quads.h"

namespace steradian::lobe_product_test {
namespace {

using K = Kernels<double>;
using reference::Random;

std::string formatted(const char* pattern, double x) {
  char text[64];
  std::snprintf(text, sizeof text, pattern, x);
  return text;
}

K::vec3 to_kernel(Vec3d v) { return {v.x, v.y, v.z}; }
Vec3d from_kernel(K::vec3 v) { return {v.x.v, v.y.v, v.z.v}; }

// The integral of f over the directions of a triangle fan about the origin, by subdivided midpoint cubature of degree
// 5 on each planar triangle: independent of every boundary form.
template <class F>
double over_triangle(Vec3d a, Vec3d b, Vec3d c, int depth, const F& f) {
  if (depth > 0) {
    const Vec3d ab = (a + b) * 0.5, bc = (b + c) * 0.5, ca = (c + a) * 0.5;
    return over_triangle(a, ab, ca, depth - 1, f) + over_triangle(ab, b, bc, depth - 1, f) + over_triangle(ca, bc, c, depth - 1, f) +
           over_triangle(ab, bc, ca, depth - 1, f);
  }
  // Radon's rule with seven nodes.
  constexpr double kA = 0.059715871789769820, kB = 0.79742698535308732, kWa = 0.13239415278850618, kWb = 0.12593918054482715;
  const Vec3d normal = cross(b - a, c - a);
  const auto at = [&](double u, double v, double w) {
    const Vec3d p = a * u + b * v + c * w;
    const double d2 = dot(p, p);
    return f(p / std::sqrt(d2)) * std::fabs(dot(normal, p)) / (2 * d2 * std::sqrt(d2));
  };
  double sum = 0.225 * at(1.0 / 3, 1.0 / 3, 1.0 / 3);
  const double a2 = (1 - kA) / 2, b2 = (1 - kB) / 2;
  sum += kWa * (at(kA, a2, a2) + at(a2, kA, a2) + at(a2, a2, kA));
  sum += kWb * (at(kB, b2, b2) + at(b2, kB, b2) + at(b2, b2, kB));
  return sum;
}

template <class F>
double over_quad(const std::vector<Vec3d>& v, int depth, const F& f) {
  return over_triangle(v[0], v[1], v[2], depth, f) + over_triangle(v[0], v[2], v[3], depth, f);
}

// A convex quad in front of the origin, all above the horizon z = 0, near the direction `towards`.
std::vector<Vec3d> quad_near(Random& random, Vec3d towards, double size) {
  const Frame frame = Frame::from_normal(towards);
  std::vector<Vec3d> v;
  for (int i = 0; i < 4; ++i) {
    const double angle = std::numbers::pi / 2 * (i + 0.6 * random.uniform());
    v.push_back(towards + frame.to_world({size * std::cos(angle), size * std::sin(angle), 0}));
  }
  return v;
}

PreparedPolygon light_towards_origin(const std::vector<Vec3d>& v) {
  PolygonLight light;
  light.vertices = v;
  light.two_sided = true;
  return prepare_polygon(light);
}

// (n + 1) times the moment of an outline about z by quadrature, in walk order in either direction.
double sum_about_z(const std::vector<K::vec3>& v, double n) {
  K k;
  double sum = 0;
  for (std::size_t i = 0; i < v.size(); ++i) {
    const auto edge = k.moment_edge(v[i], v[(i + 1) % v.size()], K::vec3(0.0, 0.0, 1.0));
    sum += k.moment_edge_share(edge, integrate_front(edge, n).moment).v;
  }
  return std::fabs(sum);
}

struct Lobe {
  Vec3d axis;
  double n;
};

K::LobeProduct summed(const std::vector<Lobe>& lobes, K::vec3 about) {
  K k;
  auto p = k.lobe_product_begin(about);
  for (const Lobe& lobe : lobes) p = k.lobe_product_add(p, to_kernel(lobe.axis), lobe.n);
  return p;
}

K::LobeProduct at_peak(const std::vector<Lobe>& lobes, int newton_steps) {
  K k;
  Vec3d start{};
  for (const Lobe& lobe : lobes) start += lobe.axis * lobe.n;
  auto about = to_kernel(normalized(start));
  for (int i = 0; i < newton_steps; ++i) about = k.lobe_product_newton(summed(lobes, about));
  return summed(lobes, about);
}

double product_at(const std::vector<Lobe>& lobes, Vec3d u) {
  double value = 1;
  for (const Lobe& lobe : lobes) value *= std::pow(std::fmax(dot(u, lobe.axis), 0.0), lobe.n);
  return value;
}

}  // namespace

TEST(DoubleAxis, AgreesWithCubature) {
  Random random(30);
  double worst = 0;
  for (int i = 0; i < 60; ++i) {
    static constexpr double kExponents[] = {1, 1.5, 2, 3, 5, 7.3, 8, 10, 20, 60};
    const double n = kExponents[i % 10];
    const Vec3d axis = reference::random_view(random, {0, 0, 1}), other = reference::random_direction(random);
    Vec3d towards = normalized(axis + reference::random_direction(random) * 0.3);
    towards.z = std::fabs(towards.z) + 0.7;  // above the horizon with the whole quad
    towards = normalized(towards);
    const std::vector<Vec3d> v = quad_near(random, towards, 0.4);
    const double truth = over_quad(v, 6, [&](Vec3d u) { return std::pow(std::fmax(dot(u, axis), 0.0), n) * dot(u, other); });
    const double exact = double_axis_moment(light_towards_origin(v), {0, 0, 0}, {0, 0, 1}, axis, other, n);
    const double full = 2 * std::numbers::pi / (n + 1);
    // Degree 5 on triangles of 0.4/64: the next term is of order (sqrt(n) 0.01)^6; the clamp's kink at n = 1 costs
    // the square of that size.
    const double bound = n < 2 ? 2e-5 : n < 4 ? 1e-7 : 1e-8;
    EXPECT_NEAR(exact, truth, bound * full) << i << ": n = " << n;
    worst = std::max(worst, std::fabs(exact - truth) / full);
  }
  std::printf("double axis against cubature: largest %.1e of the full lobe\n", worst);
}

TEST(DoubleAxis, KernelsInConstantTimeAreClose) {
  Random random(31);
  K k;
  double worst = 0, worst_cosines = 0;
  for (int i = 0; i < 5000; ++i) {
    const auto c = moment::adversarial_quad(random);
    const double n = i % 5 == 0 ? 1 + 7 * random.uniform() : c.n;
    const PreparedPolygon light = prepare_polygon(c.light);
    const Frame frame = Frame::from_normal(c.at.normal);
    const Vec3d axis = c.at.normal * (2 * dot(c.at.normal, c.at.view)) - c.at.view;
    const double exact = double_axis_moment(light, c.at.position, c.at.normal, axis, c.at.normal, n);
    const auto r = to_kernel(frame.to_local(axis));
    const K::vec3 up(0.0, 0.0, 1.0);
    const integrals::PhongLobe<double> lobe(n - 1);
    const int low = n < 8;
    const double sum =
        integrals::sum_over_edges<double>(integrals::contours_in<double>(light, frame, c.at.position), [&](const K::vec3& a,
                                                                                                           const K::vec3& b) {
          const auto edge = k.moment_edge(a, b, r);
          const auto cosines = k.moment_cosine_front(edge, n, low);
          const double half_circle = integrate_front(edge, n - 1).power.v;
          worst_cosines = std::max(worst_cosines, std::fabs(cosines.v - half_circle) * std::sqrt(n));
          const auto share = lobe.share<Method::series, Quality::normal>(a, b, r);
          return k.moment_double_axis_share(a, b, r, up, share, cosines);
        }).v;
    if (light.side_of(c.at.position) == 0) continue;
    const double value = light.side_of(c.at.position) > 0 ? sum / (n + 2) : 0;
    worst = std::max(worst, std::fabs(value - exact) * (n + 2) / (2 * std::numbers::pi));
  }
  std::printf("double axis by the series: largest %.1e of the full lobe; cosines times sqrt(n): %.1e\n", worst, worst_cosines);
  EXPECT_LT(worst, 1.3e-3 + 1e-4);  // the series', and the cosines' 1e-4 an edge at most
  EXPECT_LT(worst_cosines, 4e-4);   // 9e-5 of a half circle's integral, which is below 2.6/sqrt(n)
}

TEST(LobeProduct, ClosedFormOfTwoIsTheMaximum) {
  Random random(32);
  K k;
  for (int i = 0; i < 1000; ++i) {
    const Vec3d a = reference::random_direction(random);
    const double gamma = random.uniform(0.01, 1.4);
    const Vec3d b = Frame::from_normal(a).to_world({std::sin(gamma), 0, std::cos(gamma)});
    const double na = std::exp(random.uniform(0, 7)), nb = std::exp(random.uniform(0, 7));
    const auto peak = k.lobe_product_peak_of_two(to_kernel(a), na, to_kernel(b), nb);
    const auto p = summed({{a, na}, {b, nb}}, peak);
    // At the maximum the slope of the logarithm is 0; the scale is the sum of its parts' sizes.
    EXPECT_LT(std::hypot(p.slope.x.v, p.slope.y.v), 1e-12 * p.total.v * (1 + std::tan(gamma))) << i;
  }
}

TEST(LobeProduct, NewtonFindsThePeakOfThree) {
  Random random(33);
  double worst[3] = {0, 0, 0};
  for (int i = 0; i < 2000; ++i) {
    const Frame frame = Frame::from_normal(reference::random_direction(random));
    std::vector<Lobe> lobes;
    for (int j = 0; j < 3; ++j) {
      const double away = 25 * std::numbers::pi / 180 * random.uniform(), turn = 2 * std::numbers::pi * random.uniform();
      lobes.push_back({frame.to_world({std::sin(away) * std::cos(turn), std::sin(away) * std::sin(turn), std::cos(away)}),
                       std::exp(random.uniform(0, std::log(1000.0)))});
    }
    K k;
    const Vec3d peak = from_kernel(k.lobe_product_isotropic(at_peak(lobes, 8)).axis);
    for (int steps = 1; steps <= 3; ++steps) {
      const Vec3d found = from_kernel(k.lobe_product_isotropic(at_peak(lobes, steps)).axis);
      worst[steps - 1] = std::max(worst[steps - 1], length(cross(found, peak)) * 180 / std::numbers::pi);
    }
  }
  std::printf("peak of three lobes: %.2g, %.2g, %.2g degrees off after 1, 2, 3 steps\n", worst[0], worst[1], worst[2]);
  EXPECT_LT(worst[0], 1.0);
  EXPECT_LT(worst[1], 0.02);
  EXPECT_LT(worst[2], 1e-5);
}

// Two lobes over random quads against cubature: the table of docs/theory/moments.md, row by row and digit by digit.
TEST(LobeProduct, TwoLobesAsOne) {
  struct Row {
    double n1, n2, degrees;
  };
  const Row rows[] = {{1, 10, 30},   {1, 10, 60},    {1, 100, 30},   {1, 100, 80},   {10, 10, 60},
                      {10, 100, 60}, {100, 100, 30}, {100, 100, 60}, {100, 1000, 80}};
  std::ifstream file(test::kSourceDir + "/docs/theory/moments.md");
  const std::string page((std::istreambuf_iterator<char>(file)), {});
  K k;
  for (const Row& row : rows) {
    Random random(34);
    const double gamma = row.degrees * std::numbers::pi / 180;
    const std::vector<Lobe> lobes = {{{0, 0, 1}, row.n1}, {{std::sin(gamma), 0, std::cos(gamma)}, row.n2}};
    const auto p = summed(lobes, k.lobe_product_peak_of_two(to_kernel(lobes[0].axis), row.n1, to_kernel(lobes[1].axis), row.n2));
    const auto one = k.lobe_product_isotropic(p);
    const auto stretched = k.lobe_product_anisotropic(p);
    // The common way: spherical Gaussians multiplied.
    const Vec3d weighted = lobes[0].axis * row.n1 + lobes[1].axis * row.n2;
    const double sg_n = length(weighted), sg_scale = std::exp(sg_n - row.n1 - row.n2);
    const Vec3d sg_axis = normalized(weighted), peak = from_kernel(one.axis);
    // The full lobe over a pyramid about the peak that is as wide as the hemisphere.
    const Frame frame = Frame::from_normal(peak);
    const double wide = 40;
    const std::vector<Vec3d> all = {peak + frame.to_world({-wide, -wide, 0}), peak + frame.to_world({wide, -wide, 0}),
                                    peak + frame.to_world({wide, wide, 0}), peak + frame.to_world({-wide, wide, 0})};
    // In gnomonic coordinates the lobe is a small spot: the quads are halved towards the middle.
    double full = 0;
    std::vector<Vec3d> outer = all;
    for (int ring = 0; ring < 10; ++ring) {
      std::vector<Vec3d> inner;
      for (const Vec3d& v : outer) inner.push_back(peak + (v - peak) * 0.5);
      const auto f = [&](Vec3d u) { return product_at(lobes, u); };
      for (std::size_t i = 0; i < 4; ++i) {
        const std::size_t j = (i + 1) % 4;
        full += over_triangle(outer[i], outer[j], inner[j], 4, f) + over_triangle(outer[i], inner[j], inner[i], 4, f);
      }
      outer = inner;
    }
    full += over_quad(outer, 3, [&](Vec3d u) { return product_at(lobes, u); });
    const double ours = one.scale.v * 2 * std::numbers::pi / (one.exponent.v + 1);
    const double sg = sg_scale * 2 * std::numbers::pi / (sg_n + 1);
    double worst_sg = 0, worst_one = 0, worst_stretched = 0;
    const double width = 1 / std::sqrt(one.exponent.v);
    for (int i = 0; i < 12; ++i) {
      const Vec3d towards = normalized(peak + frame.to_world({width * random.uniform(-1, 1), width * random.uniform(-1, 1), 0}));
      const std::vector<Vec3d> quad = quad_near(random, towards, width * random.uniform(0.5, 2.5));
      const double truth = over_quad(quad, 5, [&](Vec3d u) { return product_at(lobes, u); });
      std::vector<K::vec3> about_sg, about_one, about_stretched;
      const Frame sg_frame = Frame::from_normal(sg_axis);
      for (const Vec3d& v : quad) {
        about_sg.push_back(k.polygon_direction(to_kernel(sg_frame.to_local(v))));
        about_one.push_back(k.polygon_direction(to_kernel(frame.to_local(v))));
        about_stretched.push_back(k.polygon_direction(k.lobe_product_stretch(stretched, to_kernel(v))));
      }
      const auto error = [&](const std::vector<K::vec3>& v, double scale, double n) {
        return std::fabs(scale * sum_about_z(v, n) / (n + 1) - truth) / full;
      };
      worst_sg = std::max(worst_sg, error(about_sg, sg_scale, sg_n));
      worst_one = std::max(worst_one, error(about_one, one.scale.v, one.exponent.v));
      worst_stretched = std::max(worst_stretched, error(about_stretched, stretched.scale.v, stretched.exponent.v));
    }
    const auto gaussian = [](const char* pattern, double share) {
      return share > 100 ? std::string("useless") : formatted(pattern, 100 * share) + " %";  // 1e16 times too bright
    };
    const std::string text = formatted("| %g, ", row.n1) + formatted("%g, ", row.n2) + formatted("%g | ", row.degrees) +
                             gaussian("%+.3g", sg / full - 1) + formatted(" | %+.2g %% | ", 100 * (ours / full - 1)) +
                             gaussian("%.3g", worst_sg) + formatted(" | %.2g %% | ", 100 * worst_one) +
                             formatted("%.2g %% |\n", 100 * worst_stretched);
    EXPECT_NE(page.find(text), std::string::npos) << "the page lacks " << text;
    EXPECT_LE(worst_one, worst_sg);
  }
}

}  // namespace steradian::lobe_product_test
