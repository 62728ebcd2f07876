// Properties of a frame besides its light: its aspect, its occluders, its layers, and equal results with any number of threads.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "steradian/plane.h"
#include "support/plane_families.h"

namespace steradian::plane::frame_picture_test {

TEST(PlaneFrame, IsTheSameAtAnyNumberOfThreads) {
  const PlaneWorld world(make_plane_family(8, 2));
  PlaneFrameOptions options;
  options.width = 600;
  options.height = 300;
  options.threads = 1;
  const Picture one = render_plane(world, options);
  options.threads = 0;
  const Picture all = render_plane(world, options);
  for (std::size_t i = 0; i < one.pixels.size(); ++i) ASSERT_EQ(one.pixels[i], all.pixels[i]) << i;
}

// A picture of another shape shows the scene whole, or cut off, but never stretched unless stretching is requested.
TEST(PlaneFrame, KeepsTheAspectOfSvg) {
  const auto scene = [](const std::string& aspect) {
    return load_plane_scene_from_text("<svg viewBox='0 0 100 100' preserveAspectRatio='" + aspect +
                                          "'><circle class='light' fill='#fff' cx='50' cy='50' r='20'/></svg>",
                                      "aspect.svg")
        .scene;
  };
  const auto lit = [](const PlaneScene& s) {
    PlaneFrameOptions options;
    options.width = 80;
    options.height = 40;
    const Picture picture = render_plane(PlaneWorld(s), options);
    int first = 80, last = -1, above = 40, below = -1;
    for (int y = 0; y < 40; ++y)
      for (int x = 0; x < 80; ++x)
        if (picture.at(x, y).x == 1)
          first = std::min(first, x), last = std::max(last, x), above = std::min(above, y), below = std::max(below, y);
    return std::array<int, 4>{first, last, above, below};
  };
  EXPECT_EQ(lit(scene("none")), (std::array<int, 4>{24, 55, 12, 27}));
  EXPECT_EQ(lit(scene("")), (std::array<int, 4>{32, 47, 12, 27})) << "a pixel is 2.5 units, 50 of them to either side";
  EXPECT_EQ(lit(scene("xMinYMid meet")), (std::array<int, 4>{12, 27, 12, 27}));
  EXPECT_EQ(lit(scene("xMidYMid slice")), (std::array<int, 4>{24, 55, 4, 35})) << "a pixel is 1.25 units";
}

TEST(PlaneFrame, DrawsOccludersInTheirColourOrLeavesThemClear) {
  PlaneScene scene;
  scene.width = scene.height = 32;
  scene.bodies = {plane_circle({4, 4}, 3), plane_polygon({{10, 10}, {20.5, 10}, {20.5, 30}, {10, 30}}),
                  plane_polygon({{15, 10}, {25, 10}, {25, 20}, {15, 20}})};
  scene.bodies[0].light.emplace();
  scene.bodies[1].color = {1, 0, 0};
  scene.bodies[2].color = {0, 1, 0};
  const PlaneWorld world(scene);
  PlaneFrameOptions options;
  const Picture black = render_plane(world, options);
  options.aa = 4;
  options.occluders = PlaneOccluders::fill;
  const Picture fill = render_plane(world, options);
  options.occluders = PlaneOccluders::clear;
  const Picture clear = render_plane(world, options);
  EXPECT_EQ(black.at(12, 25), (Vec3f{}));
  EXPECT_EQ(fill.at(12, 25), (Vec3f{1, 0, 0}));
  EXPECT_EQ(fill.at(17, 15), (Vec3f{0, 1, 0})) << "the last is on top";
  const auto alpha = [&](int x, int y) { return clear.layers.at("alpha")[static_cast<std::size_t>(32 * y + x)].x; };
  EXPECT_EQ(alpha(12, 25), 0);
  EXPECT_EQ(alpha(20, 25), 0.5f) << "a pixel half covered";
  EXPECT_EQ(alpha(28, 4), 1);
  EXPECT_GT(clear.at(28, 4).x, 0);
}

TEST(PlaneFrame, MomentsPointTowardsTheLight) {
  PlaneScene scene;
  scene.width = scene.height = 40;
  scene.bodies.push_back(plane_circle({20, 20}, 3));
  scene.bodies.back().light.emplace();
  PlaneFrameOptions options;
  options.moments = true;
  const Picture picture = render_plane(PlaneWorld(scene), options);
  // A disk of radius r at distance d covers angles of sine up to r / d: the mean of the direction over the circle is r / (pi d) towards it.
  for (int y = 0; y < 40; ++y)
    for (int x = 0; x < 40; ++x) {
      const Vec2d to = Vec2d{20, 20} - Vec2d{x + 0.5, y + 0.5};
      const double d2 = dot(to, to);
      if (d2 < 9) continue;  // inside
      const auto i = static_cast<std::size_t>(40 * y + x);
      EXPECT_NEAR(static_cast<double>(picture.layers.at("moment_x")[i].x), 3 * to.x / (M_PI * d2), 1e-7) << x << " " << y;
      EXPECT_NEAR(static_cast<double>(picture.layers.at("moment_y")[i].x), 3 * to.y / (M_PI * d2), 1e-7) << x << " " << y;
    }
}

}  // namespace steradian::plane::frame_picture_test
