// Maps of light groups against the map of all lights.
#include "bake/light_groups.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/boxes.h"

namespace steradian::light_groups_test {

TEST(LightGroups, MapsAddUpToThatOfAllLights) {
  Scene scene = scene::closed_box(0.5f, false);
  scene.meshes.push_back(scene::ball_mesh({0.2f, -0.5f, 0}, 0.3f, 0, 24, 12));
  const auto add_lamp = [&](const char* name, double x, Vec3d radiance) {
    AreaLight lamp;
    Polygon square;
    square.vertices = {{x - 0.2, 0.9, 0.2}, {x - 0.2, 0.9, -0.2}, {x + 0.2, 0.9, -0.2}, {x + 0.2, 0.9, 0.2}};
    lamp.shape = square;
    lamp.radiance = radiance;
    lamp.name = name;
    scene.area_lights.push_back(lamp);
  };
  add_lamp("desk 1", -0.6, {5, 1, 1});
  add_lamp("desk 2", 0, {1, 5, 1});
  add_lamp("ceiling", 0.6, {1, 1, 5});
  const auto groups = bake::light_groups(scene, {"desk"}, "scene");
  ASSERT_EQ(groups.size(), 2u);
  EXPECT_EQ(groups[0].area, (std::vector<std::uint8_t>{1, 1, 0}));
  EXPECT_EQ(groups[1].area, (std::vector<std::uint8_t>{0, 0, 1}));
  for (const int bounces : {0, 2}) {
    bake::BakeOptions options;
    options.texels = 8;
    options.light.shadows = Shadows::on;
    options.light.quality = Quality::draft;
    options.light.bounces = bounces;
    Budget budget;
    bake::BakeStats stats;
    const bake::LightMap all = bake::bake_map(scene, options, "scene", budget, &stats);
    bake::BakeStats sum_stats;
    options.light.threads = 1;
    double last = 0;
    std::size_t first_half = 0, second_half = 0;
    options.progress = [&](double fraction) {
      EXPECT_GE(fraction, last - 1e-12);
      EXPECT_LE(fraction, 1 + 1e-12);
      last = fraction;
      ++(fraction <= 0.5 ? first_half : second_half);
    };
    const bake::LightMap sum = bake::bake_light_groups(scene, groups, options, "scene", budget, sum_stats);
    ASSERT_EQ(sum.groups.size(), 2u);
    EXPECT_NEAR(last, 1, 1e-12);
    EXPECT_NEAR(static_cast<double>(first_half) / static_cast<double>(second_half), 1, 0.2) << "each group has half of the progress";
    ASSERT_EQ(sum.irradiance.size(), all.irradiance.size());
    double worst = 0, squares = 0, errors = 0;
    for (std::size_t i = 0; i < all.irradiance.size(); ++i) {
      const Vec3f d = sum.irradiance[i] - all.irradiance[i], e = sum.error[i] + all.error[i];
      worst = std::max(worst, static_cast<double>(std::max({std::fabs(d.x), std::fabs(d.y), std::fabs(d.z)})));
      squares += static_cast<double>(dot(d, d));
      errors += static_cast<double>(dot(e, e));
    }
    const auto rms = [&](double sum_of_squares) {
      return std::sqrt(sum_of_squares / (3 * static_cast<double>(all.irradiance.size()))) / stats.mean;
    };
    std::printf("%d bounces: rms %.1e, at most %.1e of the mean; texels say %.1e\n", bounces, rms(squares), worst / stats.mean,
                rms(errors));
    // Texels are not negative, and the rays of bounces fit a plane to each block of places. Neither is linear in the light: the difference
    // is within the error that the texels state.
    EXPECT_LT(squares, errors);
    EXPECT_NEAR(sum_stats.mean, stats.mean, 1e-2 * stats.mean);
  }
}

}  // namespace steradian::light_groups_test
