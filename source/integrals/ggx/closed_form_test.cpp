// GGX in closed form against the reference, float against double, packs against both, and all of them on degenerate input.
#include "steradian/closed_form.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "render/direct/lobe_packs.h"
#include "steradian/error.h"
#include "support/random_configurations.h"
#include "support/random_rectangles.h"

namespace steradian::closed_form_test {
namespace {

using ggx::random_rectangle;
using reference::describe;
using reference::Random;
using reference::random_configuration;
using reference::random_direction;

Material random_ggx(Random& random, double least_alpha) {
  Material m;
  m.brdf = Brdf::ggx;
  m.alpha_x = std::pow(10.0, random.uniform(std::log10(least_alpha), 0));
  m.alpha_y = random.uniform() < 0.5 ? m.alpha_x : std::pow(10.0, random.uniform(std::log10(least_alpha), 0));
  m.tangent = random_direction(random);
  return m;
}

constexpr double kRoughness[] = {0.1, 0.25, 0.4, 0.55, 0.7, 0.85};
constexpr double kViews[] = {3, 20, 40, 60, 75, 86};

// Error over signal, both as root mean squares: of all rectangles, and of the worst cell of roughness and view.
struct Grid {
  double all, worst_cell;
};

template <class Evaluate>
Grid relative_rmse(double f0, int per_cell, Evaluate evaluate) {
  Random random(5);
  double error = 0, signal = 0, worst = 0;
  for (double roughness : kRoughness)
    for (double view : kViews) {
      double cell_error = 0, cell_signal = 0;
      for (int i = 0; i < per_cell; ++i) {
        auto s = random_rectangle(random, roughness, view);
        s.material.f0 = {f0, f0, f0};
        const PreparedPolygon light = prepare_polygon(s.light);
        const double truth = reference_radiance(light, s.at, s.material, {1e-6, 1e-9, 100'000}).radiance.x;
        const double e = evaluate(light, s.at, s.material) - truth;
        cell_error += e * e;
        cell_signal += truth * truth;
      }
      error += cell_error;
      signal += cell_signal;
      worst = std::max(worst, std::sqrt(cell_error / cell_signal));
    }
  return {std::sqrt(error / signal), worst};
}

}  // namespace

TEST(GgxClosedForm, WithoutShadowingIsExactInDouble) {
  Random random(5);
  double worst = 0;
  int lit = 0;
  for (int i = 0; i < 400; ++i) {
    const auto c = random_configuration(random);
    Material m = random_ggx(random, 0.01);
    m.shadowing = false;
    const PreparedPolygon light = prepare_polygon(c.light);
    const auto truth = reference_radiance(light, c.at, m, {1e-13, 1e-14, 400'000});
    const double value = exact_ggx_radiance(light, c.at, m).x, error = std::fabs(value - truth.radiance.x);
    // Differences within the reference's own bound cannot be told from an error.
    EXPECT_LE(error, truth.bound + 1e-12 * std::max(1.0, value)) << i << ": " << describe(c, m) << ", value " << value;
    if (truth.bound < 1e-13) worst = std::max(worst, error / std::max(1.0, value));
    lit += value > 1e-6;
  }
  EXPECT_LT(worst, 1e-12) << "where the reference is certain to 1e-13";
  EXPECT_GT(lit, 100);
  std::printf("largest error %.2e, %d of 400 lit\n", worst, lit);
}

TEST(GgxClosedForm, FloatKeepsFourDigitsOfTheLobeOnAHundredThousandQuads) {
  Random random(7);
  double worst = 0;
  int count = 0;
  for (double roughness : {0.1, 0.2, 0.4, 0.7, 1.0})
    for (double view : {0.0, 0.01, 0.5, 5.0, 20.0, 45.0, 65.0, 75.0, 80.0, 85.0})
      for (int i = 0; i < 2000; ++i, ++count) {
        auto s = random_rectangle(random, roughness, view);
        s.material.shadowing = false;
        const PreparedPolygon light = prepare_polygon(s.light);
        const double exact = exact_ggx_radiance(light, s.at, s.material).x;
        const double value = exact_ggx_radiance_float(light, s.at, s.material).x;
        const double error = std::fabs(value - exact) / std::max(1.0, exact);
        ASSERT_LE(error, 1e-4) << "roughness " << roughness << " view " << view << " exact " << exact;
        worst = std::max(worst, error);
      }
  EXPECT_EQ(count, 100'000);
  std::printf("largest error %.2e of the full lobe\n", worst);
}

TEST(GgxClosedForm, NormalQualityHoldsItsErrorOverRoughnessAndView) {
  const auto evaluate = [](const auto& light, const auto& at, const auto& m) { return closed_form_radiance(light, at, m).x; };
  const Grid metal = relative_rmse(1.0, 28, evaluate), dielectric = relative_rmse(0.04, 28, evaluate);
  EXPECT_LE(metal.all, 0.003);
  EXPECT_LE(dielectric.all, 0.005);
  std::printf("relative RMSE of %d rectangles: F0 = 1 %.5f, worst cell %.4f; F0 = 0.04 %.5f, worst cell %.4f\n", 28 * 36, metal.all,
              metal.worst_cell, dielectric.all, dielectric.worst_cell);
}

TEST(GgxClosedForm, HighQualityHoldsItsErrorInEveryCell) {
  const auto evaluate = [](const auto& light, const auto& at, const auto& m) {
    return closed_form_radiance(light, at, m, Quality::high).x;
  };
  const Grid metal = relative_rmse(1.0, 28, evaluate), dielectric = relative_rmse(0.04, 28, evaluate);
  EXPECT_LE(metal.worst_cell, 0.015);
  EXPECT_LE(dielectric.worst_cell, 0.015);
  std::printf("relative RMSE: F0 = 1 %.5f, worst cell %.4f; F0 = 0.04 %.5f, worst cell %.4f\n", metal.all, metal.worst_cell, dielectric.all,
              dielectric.worst_cell);
}

TEST(GgxClosedForm, AnisotropicAndNonConvexLightsKeepTheErrorOfRectangles) {
  Random random(11);
  double error = 0, signal = 0;
  for (int i = 0; i < 600; ++i) {
    auto s = random_rectangle(random, random.uniform(0.2, 0.8), random.uniform(3, 80));
    s.material.alpha_y = s.material.alpha_x * random.uniform(0.25, 1);
    s.material.tangent = random_direction(random);
    if (i % 2 == 0) {  // an L: one corner cut out
      const auto v = s.light.vertices;
      const Vec3d centre = (v[0] + v[2]) * 0.5;
      s.light.vertices = {v[0], v[1], (v[1] + v[2]) * 0.5, centre, (v[2] + v[3]) * 0.5, v[3]};
    }
    const PreparedPolygon light = prepare_polygon(s.light);
    const double truth = reference_radiance(light, s.at, s.material, {1e-6, 1e-9, 100'000}).radiance.x;
    const double e = closed_form_radiance(light, s.at, s.material).x - truth;
    error += e * e;
    signal += truth * truth;
  }
  // Twice the bound of rectangles: inward corners give fans of both signs.
  EXPECT_LE(std::sqrt(error / signal), 0.006);
  std::printf("relative RMSE %.5f\n", std::sqrt(error / signal));
}

TEST(GgxClosedForm, TwoSidedLightIsTheSameFromBehind) {
  Random random(12);
  for (int i = 0; i < 200; ++i) {
    auto s = random_rectangle(random, random.uniform(0.2, 0.9), random.uniform(3, 85));
    auto turned = s.light;
    turned.vertices = {s.light.vertices[3], s.light.vertices[2], s.light.vertices[1], s.light.vertices[0]};
    const double front = closed_form_radiance(prepare_polygon(s.light), s.at, s.material).x;
    EXPECT_EQ(closed_form_radiance(prepare_polygon(turned), s.at, s.material).x, 0.0);
    turned.two_sided = true;
    // The second walk's centre, nodes and weights are those of the first in reverse.
    EXPECT_NEAR(closed_form_radiance(prepare_polygon(turned), s.at, s.material).x, front, 1e-9);
  }
}

TEST(GgxClosedForm, RefusesOtherLobesAndWhatIsNotExact) {
  const auto light = prepare_polygon({{{-1, -1, 1}, {-1, 1, 1}, {1, 1, 1}, {1, -1, 1}}, {}, {1, 1, 1}, false});
  const ShadingPoint at{{0, 0, 0}, {0, 0, 1}, {0, 0, 1}};
  Material m;
  EXPECT_THROW(closed_form_radiance(light, at, m), Error);
  m.brdf = Brdf::ggx;
  EXPECT_THROW(exact_ggx_radiance(light, at, m), Error);
  m.shadowing = false;
  EXPECT_GT(exact_ggx_radiance(light, at, m).x, 0.1);
  m.f0 = {0.5, 0.5, 0.5};
  EXPECT_THROW(exact_ggx_radiance(light, at, m), Error);
}

namespace {

// Degenerate lights: corners on the horizon, in the point, along the view; slivers, repeated and opposite corners.
PolygonLight random_nonsense(Random& random, const ShadingPoint& at) {
  PolygonLight light;
  light.two_sided = true;
  const int vertices = 3 + static_cast<int>(random.bits() % 4);
  const Frame plane = Frame::from_normal(random.uniform() < 0.3 ? at.normal : random_direction(random));
  const double height = random.uniform() < 0.3 ? 0 : std::pow(10.0, random.uniform(-8, 3));
  const Vec3d origin = at.position + plane.z * height;
  const double size = std::pow(10.0, random.uniform(-6, 4));
  for (int i = 0; i < vertices; ++i) {
    const double x = random.uniform(-1, 1) * size, y = random.uniform() < 0.2 ? 0 : random.uniform(-1, 1) * size;
    light.vertices.push_back(origin + plane.x * x + plane.y * y);
    if (random.uniform() < 0.1) light.vertices.push_back(light.vertices.back());
    if (random.uniform() < 0.1) light.vertices.push_back(origin);
  }
  return light;
}

}  // namespace

TEST(GgxClosedForm, IsFiniteAndWithinTheLightForNonsense) {
  Random random(13);
  int evaluated = 0;
  for (int i = 0; i < 100'000; ++i) {
    ShadingPoint at;
    at.normal = random.uniform() < 0.5 ? Vec3d{0, 0, 1} : random_direction(random);
    at.position = random.uniform() < 0.5 ? Vec3d{} : random_direction(random);
    const double z = std::pow(10.0, random.uniform(-4, 0)), turn = random.uniform(-3.2, 3.2);
    at.view = Frame::from_normal(at.normal).to_world({std::sqrt(1 - z * z) * std::cos(turn), std::sqrt(1 - z * z) * std::sin(turn), z});
    Material m = random_ggx(random, 1e-4);
    const double f = random.uniform() < 0.5 ? 1.0 : 0.04;
    m.f0 = m.f90 = {f, f, f};
    PreparedPolygon light;
    try {
      light = prepare_polygon(random_nonsense(random, at));
    } catch (const Error&) {
      continue;  // off its plane, by rounding
    }
    ++evaluated;
    const auto quality = static_cast<Quality>(i % 3);
    const double value = closed_form_radiance(light, at, m, quality).x;
    const double value_float = closed_form_radiance_float(light, at, m, quality).x;
    ASSERT_TRUE(value >= 0 && value <= f * (1 + 1e-12)) << i << ": " << value << " alpha " << m.alpha_x << " view " << z;
    ASSERT_TRUE(value_float >= 0 && value_float <= f * (1 + 1e-6)) << i << ": " << value_float << " alpha " << m.alpha_x << " view " << z;
    m.shadowing = false;  // sends more than it gets at grazing views, but stays finite
    const double exact = exact_ggx_radiance(light, at, m).x, exact_float = exact_ggx_radiance_float(light, at, m).x;
    ASSERT_TRUE(std::isfinite(exact) && exact >= 0 && std::isfinite(exact_float) && exact_float >= 0)
        << i << ": " << exact << ", in float " << exact_float;
  }
  EXPECT_GT(evaluated, 50'000);
  std::printf("%d of 100000 evaluated, seed 13\n", evaluated);
}

TEST(GgxClosedFormPack, AgreesWithDoubleOnEveryInstructionSet) {
  constexpr std::size_t kCount = 256;
  Random random(14);
  for (Simd simd : available_simd())
    for (Quality quality : {Quality::draft, Quality::normal, Quality::high})
      for (int trial = 0; trial < 20; ++trial) {
        auto s = random_rectangle(random, 0.4, 45);
        s.light.two_sided = trial % 2 == 0;
        const PreparedPolygon light = prepare_polygon(s.light);
        std::vector<std::vector<float>> a(14, std::vector<float>(kCount));
        std::vector<ShadingPoint> at(kCount);
        std::vector<Material> materials(kCount);
        const auto put = [&](int first, std::size_t i, Vec3d v) {
          const auto at_plane = [&](int k) -> float& { return a[static_cast<std::size_t>(first + k)][i]; };
          at_plane(0) = static_cast<float>(v.x);
          at_plane(1) = static_cast<float>(v.y);
          at_plane(2) = static_cast<float>(v.z);
        };
        for (std::size_t i = 0; i < kCount; ++i) {
          at[i] = s.at;
          at[i].position = {random.uniform(-0.5, 0.5), random.uniform(-0.5, 0.5), random.uniform(-0.5, 0.5)};
          at[i].view = reference::random_view(random, s.at.normal);
          if (at[i].view.z < 0.1) at[i].view = {0, 0, i % 2 == 0 ? 1.0 : -1.0};
          Material& m = materials[i];
          m.brdf = Brdf::ggx;
          m.alpha_x = random.uniform(0.01, 0.8);
          m.alpha_y = random.uniform(0.01, 0.8);
          m.tangent = random_direction(random);
          put(0, i, at[i].position);
          put(3, i, at[i].normal);
          put(6, i, at[i].view);
          put(9, i, m.tangent);
          a[12][i] = static_cast<float>(m.alpha_x);
          a[13][i] = static_cast<float>(m.alpha_y);
        }
        const auto plane = [&](std::size_t k) { return a[k].data(); };
        const Points points = {kCount,
                               {plane(0), plane(1), plane(2)},
                               {plane(3), plane(4), plane(5)},
                               {plane(6), plane(7), plane(8)},
                               {plane(9), plane(10), plane(11)},
                               plane(12),
                               plane(13)};
        std::vector<float> plain(kCount), fresnel(kCount);
        lobe_packs_for(simd)[methods::Procedure::closed_form](prepare_light(light), points, {{}, {Method::closed_form, quality}},
                                                              {plain.data(), fresnel.data()});
        for (std::size_t i = 0; i < kCount; ++i) {
          const double value = closed_form_radiance(light, at[i], materials[i], quality).x;
          // Float's error of the closed form (1e-4 of the lobe) and that of a node count that rounding may change.
          ASSERT_NEAR(static_cast<double>(plain[i]), value, 1e-3)
              << name_of(simd) << " point " << i << " alpha " << materials[i].alpha_x << "," << materials[i].alpha_y;
          ASSERT_LE(fresnel[i], plain[i]);
          ASSERT_GE(fresnel[i], 0.0f);
        }
      }
}

}  // namespace steradian::closed_form_test
