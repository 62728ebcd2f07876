// One walk for every outline: edges in any order, two integrals at once.
#include "integrals/integrate.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "integrals/ggx/ggx.h"
#include "integrals/ggx/ltc.h"
#include "integrals/irradiance.h"
#include "integrals/phong/phong.h"

namespace steradian::integrate_test {
namespace {

using K = Kernels<double>;

// A light above the horizon, with a hole.
PreparedPolygon light_with_a_hole() {
  return prepare_polygon(
      {{{-1, -1, 2}, {1, -1, 2}, {1, 1, 2}, {-1, 1, 2}}, {{{-0.5, -0.5, 2}, {0.5, -0.4, 2}, {0, 0.5, 2}}}, {1, 1, 1}, true});
}

// Every edge as a contour of its own, in an order that depends on the seed.
PreparedPolygon as_single_edges(const PreparedPolygon& light, unsigned seed) {
  std::vector<std::pair<Vec3d, Vec3d>> edges;
  integrals::walk_contours(
      light.vertices.data(), light.contours.data(), light.contours.size() - 1, [](Vec3d v) { return v; },
      [&](Vec3d a, Vec3d b) { edges.emplace_back(a, b); });
  std::shuffle(edges.begin(), edges.end(), std::mt19937(seed));
  PreparedPolygon result = light;
  result.vertices.clear();
  result.contours = {0};
  for (const auto& [a, b] : edges) {
    result.vertices.insert(result.vertices.end(), {a, b});
    result.contours.push_back(result.vertices.size());
  }
  return result;
}

integrals::LtcLobe<double> a_lobe() {
  K k;
  const K::vec3 view(0.6, 0.0, 0.8);
  return {k.ltc_from_compact({1.0, 1.0, 0.1, 0.05}, 0.3, view), 0.9, 0.1};
}

void expect_the_same_in_any_order(auto&& integral) {
  const PreparedPolygon light = light_with_a_hole();
  const Frame frame{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const Vec3d position{0.3, -0.2, 0};
  const auto shading = integrals::shading_from<double>(light.side_of(position), {0.6, 0.0, 0.8});
  const double expected = integrate(integrals::contours_in<double>(light, frame, position), shading, integral).x.v;
  EXPECT_NE(expected, 0);
  for (unsigned seed = 1; seed <= 5; ++seed) {
    const PreparedPolygon pieces = as_single_edges(light, seed);
    // The sum has seven terms in another order.
    EXPECT_NEAR(integrate(integrals::contours_in<double>(pieces, frame, position), shading, integral).x.v, expected,
                1e-14 + 1e-12 * std::fabs(expected));
  }
}

TEST(Integrate, TakesSingleEdgesInAnyOrder) {
  expect_the_same_in_any_order(integrals::Irradiance<double>());
  expect_the_same_in_any_order(integrals::SolidAngle<double>(K().polygon_direction(K::vec3(0.1, 0.2, 1.0))));
  expect_the_same_in_any_order(integrals::Ltc<double>(a_lobe()));
  integrals::GgxIntegral<double> ggx;
  ggx.alpha_x = ggx.alpha_y = 0.3;
  ggx.quality = Quality::draft;  // the cubature's nodes depend on the order of the edges
  expect_the_same_in_any_order(ggx);
  const integrals::PhongLobe<double> lobe(20);
  integrals::with_phong_share<double>(
      lobe, {}, [](auto share) { expect_the_same_in_any_order(integrals::PhongIntegral<double, decltype(share)>(share, 20, {})); });
}

TEST(Integrate, TwoIntegralsTogetherAreThoseOfTwoWalks) {
  const PreparedPolygon light = light_with_a_hole();
  const auto outline = integrals::contours_in<double>(light, Frame{{1, 0, 0}, {0, 0.6, 0.8}, {0, -0.8, 0.6}}, {0.3, -0.2, 0});
  const auto shading = integrals::shading_from<double>(-1, {0.6, 0.0, 0.8});
  integrals::Irradiance<double> irradiance;
  integrals::Ltc<double> ltc(a_lobe());
  integrals::Together<integrals::Irradiance<double>, integrals::Ltc<double>> both{{}, integrals::Ltc<double>(a_lobe())};
  const auto together = integrate(outline, shading, both);
  EXPECT_EQ(together.first.z.v, integrate(outline, shading, irradiance).z.v);
  EXPECT_EQ(together.second.x.v, integrate(outline, shading, ltc).x.v);
  EXPECT_GT(together.second.x.v, 0);
}

TEST(Integrate, AnUnlitPointGetsNothing) {
  const auto outline = integrals::contours_in<double>(light_with_a_hole(), Frame{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {});
  integrals::Irradiance<double> irradiance;
  EXPECT_EQ(integrate(outline, integrals::shading_from<double>(0, {0.0, 0.0, 1.0}), irradiance).z.v, 0);
}

}  // namespace
}  // namespace steradian::integrate_test
