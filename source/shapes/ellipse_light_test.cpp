// Round lights: exact irradiance against closed forms and fine polygons; polygons for lobes against finer ones.
#include "steradian/ellipse_light.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "steradian/closed_form.h"
#include "steradian/error.h"
#include "steradian/kernels.h"
#include "steradian/phong.h"
#include "support/random_configurations.h"

namespace steradian::ellipse_light_test {
namespace {

using reference::Random;
using reference::random_direction;

// An ellipsoid or a tilted ellipse with axes 0.3 to 1.1 of a size that subtends 3 to 45 degrees.
Ellipse random_round_light(Random& random, Vec3d direction) {
  const double size = std::tan(random.uniform(3, 45) * std::numbers::pi / 180) * 0.7;
  const Frame f = Frame::from_normal(random_direction(random));
  const auto axis = [&](Vec3d a) { return a * (size * random.uniform(0.3, 1.1)); };
  if (random.uniform() < 0.6) return *silhouette({direction, axis(f.x), axis(f.y), axis(f.z)}, {});
  const Vec3d facing = normalized(random_direction(random) * 0.8 - direction);
  const Frame g = Frame::from_normal(facing);
  return {direction, axis(g.x), axis(g.y)};
}

}  // namespace

TEST(EllipseIrradiance, OfASphereIsItsClosedForm) {
  Random random(1);
  double worst = 0, worst_float = 0;
  for (int i = 0; i < 2000; ++i) {
    const double radius = random.uniform(0.01, 0.95);
    const Vec3d center = random_direction(random), normal = random_direction(random);
    const double cosine = dot(center, normal);
    if (cosine < radius) continue;  // all of it above the horizon
    const double expected = std::numbers::pi * radius * radius * cosine;
    const double value = ellipsoid_irradiance({center, {radius, 0, 0}, {0, radius, 0}, {0, 0, radius}}, {}, normal);
    const auto outline = silhouette({center, {radius, 0, 0}, {0, radius, 0}, {0, 0, radius}}, {});
    worst = std::max(worst, std::fabs(value - expected));
    worst_float = std::max(worst_float, std::fabs(static_cast<double>(ellipse_irradiance_float(*outline, {}, normal)) - expected));
  }
  EXPECT_LT(worst, 1e-12);
  EXPECT_LT(worst_float, 1e-4);
  std::printf("largest error %.2e, in float %.2e\n", worst, worst_float);
}

TEST(EllipseIrradiance, OfADiskOnTheAxisIsItsClosedForm) {
  for (double radius : {0.01, 0.5, 1.0, 3.0, 100.0}) {
    const double expected = std::numbers::pi * radius * radius / (1 + radius * radius);
    EXPECT_NEAR(ellipse_irradiance({{0, 0, 1}, {0, radius, 0}, {radius, 0, 0}}, {}, {0, 0, 1}), expected, 1e-12);
    EXPECT_EQ(ellipse_irradiance({{0, 0, 1}, {radius, 0, 0}, {0, radius, 0}}, {}, {0, 0, 1}), 0.0) << "from behind";
    // An upright disk: half of it is above the horizon, and the other half looks the same.
    const double upright = ellipse_irradiance({{0, 1, 0}, {0, 0, radius}, {radius, 0, 0}}, {}, {0, 0, 1});
    EXPECT_NEAR(upright, ellipse_irradiance({{0, 1, 0}, {0, 0, radius}, {radius, 0, 0}}, {}, {0, 0, -1}), 1e-12);
  }
}

// The cone's axes against the arcs; these ellipses may have the fraction of the rim's distance that float loses.
TEST(EllipseIrradiance, OfAWholeEllipseFollowsFromItsCone) {
  Random random(3);
  Kernels<double> k;
  Kernels<float> kf;
  double worst = 0, worst_float = 0;
  int whole = 0;
  for (int i = 0; i < 4000; ++i) {
    const Ellipse e = random_round_light(random, random_direction(random));
    const double rise = std::hypot(e.x.z, e.y.z);
    if (e.center.z < rise) continue;
    ++whole;
    const auto in = [](auto kernels, Vec3d c, Vec3d a, Vec3d b) {
      using V = typename std::decay_t<decltype(kernels)>::vec3;
      const auto v = [](Vec3d d) { return V(d.x, d.y, d.z); };
      return kernels.ellipse_prepare(v(c), v(a), v(b));
    };
    const auto expected = k.ellipse_irradiance_vector(in(k, e.center, e.x, e.y));
    const auto value = k.ellipse_whole_irradiance_vector(in(k, e.center, e.x, e.y));
    const auto value_float = kf.ellipse_whole_irradiance_vector(in(kf, e.center, e.x, e.y));
    const double size = std::sqrt(dot(expected, expected).v);
    const auto off = [&](double x, double y, double z) { return std::hypot(x - expected.x.v, y - expected.y.v, z - expected.z.v) / size; };
    worst = std::max(worst, off(value.x.v, value.y.v, value.z.v));
    worst_float = std::max(worst_float, off(value_float.x.v, value_float.y.v, value_float.z.v));
  }
  EXPECT_GT(whole, 500);
  EXPECT_LT(worst, 1e-10);
  EXPECT_LT(worst_float, 1e-5);
  std::printf("%d ellipses, largest difference relative to the vector %.2e, in float %.2e\n", whole, worst, worst_float);
}

TEST(EllipseIrradiance, AgreesWithFinePolygonsAcrossTheHorizon) {
  Random random(2);
  double worst = 0, worst_float = 0;
  int cut = 0;
  for (int i = 0; i < 400; ++i) {
    const Ellipse e = random_round_light(random, random_direction(random));
    const Vec3d normal = random_direction(random);
    const auto polygon = [&](int vertices) {
      return polygon_irradiance(prepare_polygon(equal_area_polygon(e, {1, 1, 1}, vertices)), {}, normal);
    };
    // With equal area, the error falls with the square of the number; two numbers give the limit to the third power.
    const double coarse = polygon(1000), fine = polygon(2000), limit = fine + (fine - coarse) / 3;
    const double value = ellipse_irradiance(e, {}, normal);
    worst = std::max(worst, std::fabs(value - limit));
    worst_float = std::max(worst_float, std::fabs(static_cast<double>(ellipse_irradiance_float(e, {}, normal)) - limit));
    const double rise = std::hypot(dot(e.x, normal), dot(e.y, normal));
    cut += std::fabs(dot(e.center, normal)) < rise && value > 1e-6;
  }
  EXPECT_LT(worst, 1e-6);  // (2 pi / 2000)^3 = 3e-8, times the magnification by a narrow ellipse
  EXPECT_LT(worst_float, 1e-4);
  EXPECT_GT(cut, 50);
  std::printf("largest difference %.2e, in float %.2e, %d cut by the horizon\n", worst, worst_float, cut);
}

TEST(EllipsePolygons, PhongLobesHoldTheirError) {
  for (double n : {10.0, 100.0, 1000.0, 5000.0}) {
    Random random(3);
    double worst[3] = {}, even_worst = 0;
    for (int i = 0; i < 200; ++i) {
      const Vec3d direction = normalized(Vec3d{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(0.3, 1)});
      const Ellipse e = random_round_light(random, direction);
      const double aside = random.uniform(0, 1);
      const Vec3d axis = normalized(direction + random_direction(random) * aside * 0.7);
      ShadingPoint at;
      at.normal = {0, 0, 1};
      at.view = {-axis.x, -axis.y, axis.z};
      if (!(axis.z > 0.05)) continue;
      Material m;
      m.brdf = Brdf::phong;
      m.exponent = n;
      const LobeAxis lobe{axis, 1 / std::sqrt(n + 1)};
      const auto radiance = [&](const PolygonLight& light) {
        return phong_radiance(prepare_polygon(light), at, m, {.method = Method::exact}).x;
      };
      const double truth = radiance(equal_area_polygon(e, {1, 1, 1}, 512));
      const int vertices[3] = {8, 12, 16};
      for (int k = 0; k < 3; ++k) worst[k] = std::max(worst[k], std::fabs(radiance(polygon_for_lobe(e, {}, lobe, vertices[k])) - truth));
      even_worst = std::max(even_worst, std::fabs(radiance(equal_area_polygon(e, {1, 1, 1}, 8)) - truth));
    }
    std::printf("n = %4.0f: largest error of the full lobe K = 8 %.5f, 12 %.5f, 16 %.5f; 8 at equal steps %.5f\n", n, worst[0], worst[1],
                worst[2], even_worst);
    EXPECT_LE(worst[0], 0.0075) << "n " << n;
    EXPECT_LE(worst[1], 0.0011) << "n " << n;
    EXPECT_LE(worst[2], worst[0]) << "n " << n;
  }
}

TEST(EllipsePolygons, GgxHoldsItsErrorWithTwelveVertices) {
  Random random(4);
  double worst = 0, sum = 0;
  int count = 0;
  for (int i = 0; i < 300; ++i) {
    const double view = random.uniform(5, 75) * std::numbers::pi / 180;
    ShadingPoint at;
    at.normal = {0, 0, 1};
    at.view = {-std::sin(view), 0, std::cos(view)};
    const Vec3d mirror{std::sin(view), 0, std::cos(view)};
    const Ellipse e = random_round_light(random, normalized(mirror + random_direction(random) * 0.4));
    Material m;
    m.brdf = Brdf::ggx;
    m.alpha_x = m.alpha_y = random.uniform(0.05, 0.4);
    const auto radiance = [&](const PolygonLight& light) { return closed_form_radiance(prepare_polygon(light), at, m, Quality::high).x; };
    const double error =
        std::fabs(radiance(polygon_for_lobe(e, {}, lobe_axis(m, at), 12)) - radiance(equal_area_polygon(e, {1, 1, 1}, 256)));
    worst = std::max(worst, error);
    sum += error * error;
    ++count;
  }
  EXPECT_LE(worst, 0.003);
  std::printf("K = 12: largest error %.5f, rms %.5f\n", worst, std::sqrt(sum / count));
}

// Points beside the rim, inside and outside of it, as close as a thousandth of the radius. The reference is a polygon whose steps are a
// hundredth of the point's distance to the rim.
TEST(EllipsePolygons, HoldTheirErrorNearTheRim) {
  const auto fine = [](Vec3d p) {
    const double beta = std::hypot(std::hypot(p.x, p.y) - 1, p.z) / 3, around = std::atan2(p.y, p.x);
    PolygonLight light;
    for (int k = 0; k < 2400; ++k) {
      const double t = around + 2 * std::atan(beta * std::sinh(std::asinh(100 / beta) * ((k + 0.5) / 1200 - 1)));
      light.vertices.push_back({std::cos(t), std::sin(t), 0});
    }
    return light;
  };
  const Ellipse disk{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  double worst_sharp = 0, worst = 0, worst_beside = 0, largest = 0;
  Random random(9);
  for (const double gap : {0.3, 0.1, 0.02, 0.005, 0.001})
    for (const double side : {1.0, -1.0})
      for (const double alpha : {0.04, 0.1, 0.25, 0.7})
        for (int i = 0; i < 8; ++i) {
          const double around = random.uniform(-std::numbers::pi, std::numbers::pi), radius = 1 + side * gap;
          const Vec3d p{radius * std::cos(around), radius * std::sin(around), gap * std::pow(10, random.uniform(-1.5, 0.5))};
          ShadingPoint at;
          at.position = p;
          at.normal = random_direction(random);
          if (at.normal.z > 0.8) continue;
          const double t = around + random.uniform(-1, 1), r = random.uniform(0.7, 1.1);
          const Vec3d mirror = normalized(Vec3d{r * std::cos(t), r * std::sin(t), 0} - p);
          if (dot(mirror, at.normal) < 0.1) continue;
          at.view = at.normal * (2 * dot(mirror, at.normal)) - mirror;
          Material m;
          m.brdf = Brdf::ggx;
          m.alpha_x = m.alpha_y = alpha;
          m.shadowing = false;
          const double truth = exact_ggx_radiance(prepare_polygon(fine(p)), at, m).x;
          const double value = exact_ggx_radiance(prepare_polygon(polygon_for_lobe(disk, p, lobe_axis(m, at), 12)), at, m).x;
          double& of_kind = alpha < 0.1 ? worst_sharp : worst;
          of_kind = std::max(of_kind, std::fabs(value - truth));
          if (gap < 0.05 && alpha >= 0.1) worst_beside = std::max(worst_beside, std::fabs(value - truth));
          largest = std::max(largest, truth);
        }
  EXPECT_LE(worst_beside, 0.0014);  // as docs/theory/ggx.md states
  EXPECT_LE(worst, 0.0025);         // a tenth of the radius away and more, with the usual 12 corners
  EXPECT_LE(worst_sharp, 0.006);
  EXPECT_GT(largest, 0.9);
  std::printf("largest error of the full lobe %.5f, within 0.05 of the rim %.5f, of alpha 0.04 %.5f\n", worst, worst_beside, worst_sharp);
}

// A disk that stands nearly edge-on, so that its rim is near on one side and the lobe meets it on another; sharp and rough lobes.
TEST(EllipsePolygons, HoldTheirErrorWhereTheLobeMeetsARimThatIsNearElsewhere) {
  Random random(31);
  double worst = 0;
  int near = 0;
  for (int i = 0; i < 400; ++i) {
    const Vec3d direction = normalized(Vec3d{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(0.15, 0.8)});
    const Vec3d mirror = normalized(direction + random_direction(random) * random.uniform(0, 0.3));
    if (!(mirror.z > 0.1)) continue;
    const Vec3d across = normalized(cross(direction, random_direction(random)));
    const Frame plane = Frame::from_normal(normalized(across - direction * std::pow(10.0, random.uniform(-2, -0.3))));
    const double radius = std::pow(10.0, random.uniform(-0.7, 0.5));
    const Ellipse e{direction, plane.x * radius, plane.y * radius};
    ShadingPoint at;
    at.normal = {0, 0, 1};
    at.view = {-mirror.x, -mirror.y, mirror.z};
    Material m;
    m.brdf = Brdf::ggx;
    m.shadowing = false;
    m.alpha_x = m.alpha_y = std::pow(10.0, random.uniform(-1.5, 0));
    const auto radiance = [&](const PolygonLight& light) { return exact_ggx_radiance(prepare_polygon(light), at, m).x; };
    const PolygonLight polygon = polygon_for_lobe(e, {}, lobe_axis(m, at), 32);  // as eval
    near += polygon.vertices.size() > 32;
    const double truth = radiance(equal_area_polygon(e, {1, 1, 1}, 4000));
    worst = std::max(worst, std::fabs(radiance(polygon) - truth) / std::max(truth, 1.0));
  }
  std::printf("%d of 400 near, largest error of the full lobe %.5f\n", near, worst);
  EXPECT_GT(near, 100);
  EXPECT_LE(worst, 0.0014);  // as docs/theory/ggx.md states
}

TEST(EllipsePolygons, RefuseOddNumbersOfVertices) {
  const Ellipse e{{0, 0, 1}, {0, 1, 0}, {1, 0, 0}};
  EXPECT_THROW(polygon_of_equal_steps(e, {}, 7), Error);
  EXPECT_THROW(polygon_for_lobe(e, {}, {{0, 0, 1}, 0.1}, 4), Error);
}

}  // namespace steradian::ellipse_light_test
