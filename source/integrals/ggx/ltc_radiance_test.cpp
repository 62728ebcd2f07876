// GGX by tables, through the library's functions.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>

#include "core/random.h"
#include "fit/lobe.h"
#include "integrals/tables/ggx_tables.h"
#include "render/direct/lobe_packs.h"
#include "steradian/error.h"
#include "steradian/ltc.h"
#include "support/random_configurations.h"

namespace steradian::ltc_radiance_test {
namespace {

constexpr LtcMethod kMethods[] = {LtcMethod::classic, LtcMethod::fresnel, LtcMethod::compact, LtcMethod::clipless,
                                  LtcMethod::representative_point};

Material ggx(double roughness) {
  Material m;
  m.brdf = Brdf::ggx;
  m.alpha_x = m.alpha_y = std::max(roughness * roughness, 1e-4);
  return m;
}

PreparedPolygon rectangle(Vec3d centre, Vec3d u, Vec3d v) {
  return prepare_polygon({{centre - u - v, centre + u - v, centre + u + v, centre - u + v}, {}, {1, 1, 1}, true});
}

}  // namespace

// Integral of the table's lobe over a rectangle, by midpoints of n x n cells.
double lobe_over_rectangle(const LtcInverse& inverse, Vec3d centre, Vec3d u, Vec3d v, int n) {
  const Vec3d normal = cross(u, v) * 4.0;  // of the rectangle's area
  double sum = 0;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const Vec3d p = centre + u * ((2 * i + 1.0) / n - 1) + v * ((2 * j + 1.0) / n - 1);
      const double r2 = dot(p, p);
      sum += ltc_evaluate(inverse, p / std::sqrt(r2)) * std::fabs(dot(normal, p)) / (r2 * std::sqrt(r2)) / (n * n);
    }
  return sum;
}

LtcValue look_up(LtcMethod method, double roughness, double cosine) {
  return method == LtcMethod::compact ? ggx_compact_table().look_up(roughness, cosine) : ggx_classic_table().look_up(roughness, cosine);
}

double fresnel_of(double roughness, double cosine, Vec3d centre, Vec3d u, Vec3d v, int n) {
  const LtcValue value = ggx_fresnel_table().look_up(roughness, cosine);
  return value.n_a * lobe_over_rectangle(value.inverse, centre, u, v, n);
}

// Quadrature of the table's own lobe, over lights above the horizon, with Fresnel: the only difference is the quadrature's error.
TEST(LtcRadiance, IsTheTablesLobeOverTheLight) {
  const Vec3d centre{-1, 0.2, 1}, u{0, 0.6, 0}, v{0.3, 0, 0.5};
  const PreparedPolygon light = rectangle(centre, u, v);
  for (LtcMethod method : {LtcMethod::classic, LtcMethod::compact, LtcMethod::fresnel})
    for (double roughness : {0.2, 0.4, 0.7, 1.0})
      for (double cosine : {0.9, 0.6, 0.2})
        for (double f0 : {1.0, 0.04}) {
          Material m = ggx(roughness);
          m.f0 = {f0, f0, f0};
          const LtcValue value = look_up(method, roughness, cosine);
          const auto by_cells = [&](int n) {
            const double lobe = lobe_over_rectangle(value.inverse, centre, u, v, n);
            const double grazing = method == LtcMethod::fresnel ? fresnel_of(roughness, cosine, centre, u, v, n) : value.f_a * lobe;
            return f0 * value.n_a * lobe + (1 - f0) * grazing;
          };
          const double fine = by_cells(400), coarse = by_cells(200);
          const double found = ltc_radiance(method, light, {{}, {0, 0, 1}, {std::sqrt(1 - cosine * cosine), 0, cosine}}, m).x;
          // The rule's error falls fourfold from coarse to fine, so a third of their difference remains. Where the lobe's horizon crosses
          // cells, it falls equally fast, but irregularly.
          EXPECT_NEAR(found, fine, 3 * std::fabs(fine - coarse) + 1e-7) << roughness << " " << cosine << " " << f0;
        }
}

// A bound for any light. The difference of lobe and fit has no mean over the hemisphere except for the table's rounding. So no part of it
// contains more than half of its absolute integral.
TEST(LtcRadiance, IsAsNearAsTheFitsLobe) {
  reference::Random random(27);
  for (double roughness : {0.2, 0.4, 0.7})
    for (double cosine : {0.9, 0.6}) {
      const ShadingPoint at = {{}, {0, 0, 1}, {std::sqrt(1 - cosine * cosine), 0, cosine}};
      const fit::Lobe lobe = fit::ggx_lobe(roughness * roughness, at.view);
      constexpr int kDirections = 1 << 15;
      for (LtcMethod method : {LtcMethod::classic, LtcMethod::compact}) {
        const LtcValue value = look_up(method, roughness, cosine);
        double difference = 0, mean = 0;
        for (int i = 0; i < kDirections; ++i) {
          const double b = i * 0.6180339887498949;
          const Vec3d l = lobe.sample((i + 0.5) / kDirections, b - std::floor(b));
          if (!(l.z > 0)) continue;
          const double d = (value.n_a * ltc_evaluate(value.inverse, l) - lobe.evaluate(l)) / (lobe.pdf(l) * kDirections);
          difference += std::fabs(d);
          mean += d;
        }
        // A lattice of N points that the horizon cuts has an error of about N^(-3/4).
        const double bound = 0.5 * (difference + std::fabs(mean)) + std::pow(kDirections, -0.75);
        double worst = 0;
        for (int i = 0; i < 40; ++i) {
          const PreparedPolygon light = rectangle(lobe.sample(random.uniform(), random.uniform()),
                                                  reference::random_direction(random) * 0.6, reference::random_direction(random) * 0.4);
          const double expected = reference_radiance(light, at, ggx(roughness), {1e-5, 1e-6, 100'000}).radiance.x;
          const double error = std::fabs(ltc_radiance(method, light, at, ggx(roughness)).x - expected);
          EXPECT_LE(error, bound + 1e-5) << roughness << " " << cosine;
          worst = std::max(worst, error);
        }
        std::printf("roughness %.1f, cosine %.1f: largest error %.4f, bound %.4f\n", roughness, cosine, worst, bound);
      }
    }
}

// A light that is smaller than its sphere would have to be to reach the lobe's horizon is not cut, by either method.
TEST(LtcRadiance, ClipsNoLightThatIsSmall) {
  for (double roughness : {0.2, 0.4, 0.7})
    for (double cosine : {0.9, 0.6}) {
      const Vec3d view{std::sqrt(1 - cosine * cosine), 0, cosine}, mirror{-view.x, 0, view.z};
      const Frame frame = Frame::from_normal(mirror);
      const PreparedPolygon light = rectangle(mirror, frame.x * 0.02, frame.y * 0.02);
      const ShadingPoint at = {{}, {0, 0, 1}, view};
      const double clipped = ltc_radiance(LtcMethod::classic, light, at, ggx(roughness)).x;
      EXPECT_GT(clipped, 1e-4);
      EXPECT_NEAR(ltc_radiance(LtcMethod::clipless, light, at, ggx(roughness)).x, clipped, 1e-12) << roughness << " " << cosine;
    }
}

// The assumption holds here, to first order in the light's angular radius.
TEST(RepresentativePoint, IsTheReferenceForASmallLightOnARoughSurface) {
  reference::Random random(26);
  double worst = 0;
  int cases = 0;
  while (cases < 200) {
    const Vec3d to = reference::random_direction(random), view = reference::random_view(random, {0, 0, 1});
    if (to.z < 0.3 || view.z < 0.3) continue;
    ++cases;
    const Frame frame = Frame::from_normal(to);
    const double half_side = 0.01, radius = half_side * std::sqrt(2), solid_angle = 4 * half_side * half_side;
    const PreparedPolygon light = rectangle(to, frame.x * half_side, frame.y * half_side);
    const Material m = ggx(random.uniform(0.7, 1));
    const ShadingPoint at = {{}, {0, 0, 1}, view};
    const double expected = reference_radiance(light, at, m, {1e-6, 1e-10, 400'000}).radiance.x;
    const double found = ltc_radiance(LtcMethod::representative_point, light, at, m).x;
    // The terms are the decrease (alpha/alpha')^2, and the distribution's steepest logarithmic slope 2/alpha over half the radius.
    // Shadowing's slope is below 1/l_z. A tenth more covers the second order: radius/alpha is at most 0.03.
    const double v_dot_h = dot(view, normalized(view + to));
    const double bound =
        1.1 * (2 * std::sqrt(solid_angle / (4 * std::numbers::pi * v_dot_h)) / m.alpha_x + radius / m.alpha_x + radius / (to.z - radius));
    EXPECT_NEAR(found / expected, 1, bound) << "roughness " << std::sqrt(m.alpha_x) << " l_z " << to.z << " v_z " << view.z;
    worst = std::max(worst, std::fabs(found / expected - 1));
  }
  std::printf("largest relative error %.3f\n", worst);
}

// The other extreme: a mirror that reflects the light sends its radiance, at every view.
TEST(RepresentativePoint, OfAMirrorIsTheLightsRadiance) {
  for (double degrees : {0.0, 30.0, 60.0, 80.0, 86.0}) {
    const double t = degrees * std::numbers::pi / 180;
    const Vec3d view = {std::sin(t), 0, std::cos(t)}, mirror = {-view.x, 0, view.z};
    const Frame frame = Frame::from_normal(mirror);
    const double half_side = 0.04;  // wholly above the horizon up to 86 degrees: 0.04 sqrt(2) < cos 86
    const PreparedPolygon light = rectangle(mirror, frame.x * half_side, frame.y * half_side);
    const double found = ltc_radiance(LtcMethod::representative_point, light, {{}, {0, 0, 1}, view}, ggx(0.01)).x;
    // alpha = 1e-4 over the light's disk of half vectors, at least 0.0225; shadowing 1 - (alpha tan t)^2 / 2.
    EXPECT_LE(found, 1 + 1e-9) << degrees;
    EXPECT_GE(found, 1 - 2 * 1e-4 / 0.0225 - 1e-5) << degrees;
  }
}

TEST(LtcRadiance, IsExactlyZeroForALightBelowTheHorizonAndFromBehind) {
  reference::Random random(21);
  for (int i = 0; i < 200; ++i) {
    const Vec3d centre = {random.uniform(-2, 2), random.uniform(-2, 2), random.uniform(-3, -1.01)};
    PreparedPolygon light = rectangle(centre, reference::random_direction(random) * 0.5, reference::random_direction(random) * 0.5);
    const ShadingPoint at = {{}, {0, 0, 1}, reference::random_view(random, {0, 0, 1})};
    const Material m = ggx(random.uniform());
    for (LtcMethod method : {LtcMethod::classic, LtcMethod::compact, LtcMethod::representative_point}) {
      EXPECT_EQ(ltc_radiance(method, light, at, m).x, 0.0);
      EXPECT_EQ(ltc_radiance_float(method, light, at, m).x, 0.0);
    }
    light.two_sided = false;
    const ShadingPoint behind = {light.centroid - light.normal, light.normal, light.normal};
    for (LtcMethod method : kMethods) EXPECT_EQ(ltc_radiance(method, light, behind, m).x, 0.0);
  }
}

TEST(LtcRadiance, IsFiniteAndNotNegativeForEveryLight) {
  reference::Random random(22);
  for (int i = 0; i < 3000; ++i) {
    const reference::Configuration c = reference::random_configuration(random);
    const PreparedPolygon light = prepare_polygon(c.light);
    Material m = ggx(random.uniform());
    m.f0 = {0.04, 0.5, 1};
    for (LtcMethod method : kMethods)
      for (const Vec3d& radiance : {ltc_radiance(method, light, c.at, m), ltc_radiance_float(method, light, c.at, m)}) {
        ASSERT_TRUE(is_finite(radiance)) << c.kind;
        ASSERT_GE(std::min({radiance.x, radiance.y, radiance.z}), 0.0) << c.kind;
      }
  }
}

// The mirror image of a half vector's cancellation: a narrow lobe amplifies the rounding of float by 1 / alpha.
TEST(LtcRadiance, InFloatIsNearDouble) {
  reference::Random random(23);
  double worst = 0;
  for (int i = 0; i < 2000; ++i) {
    const reference::Configuration c = reference::random_configuration(random);
    if (c.kind == "near" || c.kind == "tiny" || c.kind == "huge") continue;  // vertices lose their digits before the test
    const PreparedPolygon light = prepare_polygon(c.light);
    const Material m = ggx(random.uniform(0.2, 1));
    for (LtcMethod method : {LtcMethod::classic, LtcMethod::compact}) {
      const double d = ltc_radiance(method, light, c.at, m).x, f = ltc_radiance_float(method, light, c.at, m).x;
      worst = std::max(worst, std::fabs(d - f));
      // Vertices 5 m away have an error of 4e-7, amplified by 2 / alpha <= 50; twice that for both ends of an edge.
      EXPECT_NEAR(f, d, 4e-5) << c.kind << " roughness " << std::sqrt(m.alpha_x);
    }
  }
  std::printf("largest difference of float and double %.2g\n", worst);
}

TEST(LtcRadiance, IsRotationInvariantAndLinear) {
  reference::Random random(24);
  for (int i = 0; i < 100; ++i) {
    const PreparedPolygon light = rectangle({-0.5, 0.4, 1.2}, {0.4, 0, 0.1}, {0, 0.5, 0});
    const ShadingPoint at = {{}, {0, 0, 1}, normalized(Vec3d{0.7, 0, 0.6})};
    const Frame frame = Frame::from_normal_and_tangent(reference::random_direction(random), reference::random_direction(random));
    PreparedPolygon turned = light;
    for (Vec3d& v : turned.vertices) v = frame.to_world(v);
    turned.normal = frame.to_world(light.normal);
    turned.centroid = frame.to_world(light.centroid);
    turned.radiance = {2, 3, 0};
    const ShadingPoint there = {{}, frame.z, frame.to_world(at.view)};
    for (LtcMethod method : kMethods) {
      const double expected = ltc_radiance(method, light, at, ggx(0.4)).x;
      const Vec3d found = ltc_radiance(method, turned, there, ggx(0.4));
      EXPECT_NEAR(found.x, 2 * expected, 1e-11);
      EXPECT_NEAR(found.y, 3 * expected, 1e-11);
      EXPECT_EQ(found.z, 0);
    }
  }
}

TEST(LtcRadiance, ServesIsotropicGgxOnly) {
  Material m = ggx(0.3);
  EXPECT_TRUE(serves(LtcMethod::classic, m));
  m.alpha_y = 0.5;
  EXPECT_FALSE(serves(LtcMethod::classic, m));
  EXPECT_THROW(ltc_radiance(LtcMethod::classic, rectangle({0, 0, 1}, {1, 0, 0}, {0, 1, 0}), {{}, {0, 0, 1}, {0, 0, 1}}, m), Error);
}

TEST(LtcPacks, AgreeWithTheScalarCallsInEveryInstructionSet) {
  reference::Random random(25);
  constexpr std::size_t kCount = 256;
  std::vector<float> a[10];
  for (std::size_t i = 0; i < kCount; ++i) {
    const Vec3d n = normalized(Vec3d{random.uniform(-.5, .5), random.uniform(-.5, .5), 1}), v = reference::random_view(random, n);
    const double values[10] = {random.uniform(-2, 2), random.uniform(-2, 2), 0, n.x, n.y, n.z, v.x, v.y, v.z, random.uniform(0.2, 1)};
    for (std::size_t k = 0; k < 10; ++k) a[k].push_back(static_cast<float>(values[k]));
  }
  // The light reaches below the floor: both kinds of clipping happen.
  const PreparedPolygon light = rectangle({0.3, 0.8, 0.4}, {0.9, 0, 0.2}, {0, 0.3, 0.8});
  const PackLight pack_light = prepare_light(light);
  std::vector<float> alpha;
  for (const float roughness : a[9]) alpha.push_back(roughness * roughness);
  const auto arrays = [&](int first) { return VectorArrays{a[first].data(), a[first + 1].data(), a[first + 2].data()}; };
  const Points points = {kCount, arrays(0), arrays(3), arrays(6), {}, alpha.data()};
  std::vector<float> irradiance(kCount), specular(kCount), grazing(kCount);
  const LobeRadiance radiance = {specular.data(), grazing.data(), irradiance.data()};
  const std::tuple<LtcMethod, Method, Quality> forms[] = {{LtcMethod::classic, Method::ltc, Quality::normal},
                                                          {LtcMethod::fresnel, Method::ltc, Quality::high},
                                                          {LtcMethod::compact, Method::ltc_compact, Quality::normal}};
  for (Simd simd : available_simd())
    for (const auto& [method, by, quality] : forms) {
      const LtcPackTables tables = ltc_pack_tables(by, quality);
      lobe_packs_for(simd)[methods::Procedure::ltc](pack_light, points, {{}, {by, quality}, &tables}, radiance);
      for (std::size_t i = 0; i < kCount; ++i) {
        const Vec3d p = {a[0][i], a[1][i], a[2][i]}, n = {a[3][i], a[4][i], a[5][i]}, v = {a[6][i], a[7][i], a[8][i]};
        Material m = ggx(a[9][i]);
        const double expected = ltc_radiance(method, light, {p, n, v}, m).x;
        EXPECT_NEAR(specular[i], expected, 1e-4) << name_of(simd) << " " << i << " roughness " << a[9][i];
        EXPECT_NEAR(irradiance[i], polygon_irradiance(light, p, n), 2e-5) << name_of(simd) << " " << i;
        m.f0 = {0, 0, 0};
        EXPECT_NEAR(grazing[i], ltc_radiance(method, light, {p, n, v}, m).x, 1e-4) << name_of(simd) << " " << i;
      }
    }
}

}  // namespace steradian::ltc_radiance_test
