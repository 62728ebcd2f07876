#include "render/direct/profiled_means.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <string>

#include "core/random.h"
#include "integrals/textured/profiled_light.h"
#include "render/tile/tile.h"

namespace steradian::profiled_means_test {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

AreaLight lamp(bool round, bool spot) {
  const auto profile = std::make_shared<LightProfile>();
  for (double v = 0; v <= (spot ? 22.5 : 90); v += spot ? 0.05 : 2.5) profile->vertical.push_back(v);
  if (spot)
    profile->horizontal = {0};
  else
    for (double h = 0; h <= 360; h += 15) profile->horizontal.push_back(h);
  const double rim = std::cos(22.5 * kDegree);
  for (const double h : profile->horizontal)
    for (const double v : profile->vertical) {
      const double c = std::cos(v * kDegree), t = std::clamp((c - rim) / ((1 - rim) * 0.15), 0.0, 1.0);
      profile->candela.push_back(spot ? c * t * t * (3 - 2 * t)
                                      : c * (40 + 200 * std::exp(-(v - 55) * (v - 55) / 300) * (1 + 0.6 * std::cos(2 * h * kDegree))));
    }
  AreaLight light;
  if (round)
    light.shape = Ellipse{{0, 2, 0}, {0.2, 0, 0.05}, {-0.05, 0, 0.15}};
  else
    light.shape = Polygon{{{-0.2, 2, -0.1}, {0.2, 2, -0.1}, {0.2, 2, 0.1}, {-0.2, 2, 0.1}}, {}};
  set_emission(light, profile, {1, 0, 0}, {1, 1, 1});
  return light;
}

}  // namespace

// Packs against adaptive cubature at every point, relative to the brightest mean. The bounds are those of the mean by cells, which
// ProfiledLight.ErrorsAreMeasured holds.
TEST(ProfiledMeans, PacksFollowTheReference) {
  for (const bool round : {false, true})
    for (const bool spot : {false, true})
      for (const double alpha : {0.0, 0.6, 0.25, 0.06}) {
        const AreaLight light = lamp(round, spot);
        const ProfiledLight profiled(light, std::make_shared<const ProfileTable>(*light.emission->profile)), alone(light);
        reference::Random random(31);
        auto tile = std::make_unique<SurfaceTile>();
        alignas(64) TilePlane f0, f90, wanted, candela, found;
        AreaLight even = light;
        even.emission.reset();
        even.radiance = {1, 1, 1};
        constexpr std::size_t kPoints = 64;
        const auto material = [&] {
          Material m;
          if (alpha > 0) m.brdf = Brdf::ggx, m.alpha_x = m.alpha_y = alpha, m.f0 = {0.2, 0.2, 0.2}, m.f90 = {1, 1, 1};
          return m;
        }();
        const auto point = [&](std::size_t i) {
          const auto of = [&](const TileVector& v) { return static_cast<Vec3d>(get(v, i)); };
          return ShadingPoint{of(tile->position), normalized(of(tile->normal)), normalized(of(tile->view))};
        };
        for (std::size_t i = 0; i < kPoints; ++i) {
          // About the rim of the spot, 0.8 m from the axis on the floor.
          const double angle = 2 * std::numbers::pi * random.uniform(), r = 0.6 + 0.4 * random.uniform();
          put(tile->position, i, static_cast<Vec3f>(Vec3d{r * std::cos(angle), 0.1 * random.uniform(), r * std::sin(angle)}));
          put(tile->normal, i, static_cast<Vec3f>(normalized(Vec3d{0.2 * random.uniform(), 1, 0.2 * random.uniform()})));
          put(tile->view, i, static_cast<Vec3f>(normalized(Vec3d{random.uniform() - 0.5, 0.3 + random.uniform(), random.uniform() - 0.5})));
          put(tile->tangent, i, {0, 0, 0});
          tile->alpha_x[i] = tile->alpha_y[i] = static_cast<float>(alpha);
          f0[i] = 0.2f, f90[i] = 1;
          wanted[i] = static_cast<float>(radiance(even, point(i), material).radiance.x);
        }
        Points points = points_of(*tile);
        points.count = kPoints;
        // Many cells judge a narrow lobe: they take the integral of the method as packs do.
        std::array<double, kPoints> want;
        for (std::size_t i = 0; i < kPoints; ++i) {
          const auto integral = static_cast<double>(wanted[i]);
          want[i] = alpha == 0.06 ? alone.seen_by(material, point(i), integral, 4096).x
                                  : alone.reference(material, point(i), {1e-5, 0, 60'000}).radiance.x / integral;
        }
        for (const Simd simd : available_simd()) {
          const ProfiledMeansTable& table = profiled_means_table_for(simd);
          if (alpha > 0)
            table.ggx(profiled, points, {f0.data(), f90.data(), wanted.data()}, {candela.data(), found.data()});
          else
            table.diffuse(profiled, points, wanted.data(), {candela.data(), found.data()});
          double squares = 0, worst = 0, brightest = 0;
          int count = 0;
          for (std::size_t i = 0; i < kPoints; ++i) {
            if (!(found[i] > 0) || !(wanted[i] > 1e-4f)) continue;
            const double error = std::fabs(profiled.radiance_of(static_cast<double>(candela[i])).x - want[i]);
            brightest = std::max(brightest, want[i]);
            squares += error * error;
            worst = std::max(worst, error);
            ++count;
          }
          const double rms = std::sqrt(squares / std::max(count, 1)) / brightest;
          std::printf("%s %s %s alpha %.2f: %d of %zu, rms %.2e worst %.2e\n", name_of(simd), round ? "disk" : "rect",
                      spot ? "spot" : "batwing", alpha, count, kPoints, rms, worst / brightest);
          EXPECT_GT(count, 30);
          EXPECT_LT(rms, 2e-3);
          EXPECT_LT(worst, 1e-2 * brightest);
        }
      }
}

}  // namespace steradian::profiled_means_test
