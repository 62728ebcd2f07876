// Concave lights that are even, as one emitter, and outlines of many vertices, as one blocker.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

#include "plane/exact/random.h"
#include "plane/frame/runs/convex.h"
#include "steradian/plane.h"

namespace steradian::plane::around_test {
namespace {

constexpr int kWidth = 96, kHeight = 80;

// A ring that is open to the right, of so many edges on each of its two arcs.
std::vector<Vec2d> horseshoe(Vec2d center, double outer, double inner, int count) {
  std::vector<Vec2d> outline;
  for (int k = 0; k <= count; ++k)
    outline.push_back(center + Vec2d{std::cos(0.6 + 5.0 * k / count), std::sin(0.6 + 5.0 * k / count)} * outer);
  for (int k = count; k >= 0; --k)
    outline.push_back(center + Vec2d{std::cos(0.6 + 5.0 * k / count), std::sin(0.6 + 5.0 * k / count)} * inner);
  return outline;
}

PlaneScene scene_of(const std::vector<Vec2d>& outline) {
  PlaneScene scene;
  scene.width = kWidth;
  scene.height = kHeight;
  PlaneBody light = plane_polygon(outline);
  light.light.emplace();
  scene.bodies.push_back(std::move(light));
  return scene;
}

struct Drawn {
  double worst = 0;
  PlaneFrameStats stats;
};

// The largest difference of a frame's pixels from the query.
Drawn draw(const PlaneScene& scene) {
  const PlaneWorld world(scene);
  PlaneFrameOptions options;
  options.width = kWidth;
  options.height = kHeight;
  Drawn drawn;
  const Picture picture = render_plane(world, options, &drawn.stats);
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x)
      drawn.worst = std::max(drawn.worst, std::fabs(static_cast<double>(picture.at(x, y).x) - world.query({x + 0.5, y + 0.5}).radiance.x));
  return drawn;
}

// The bound of frames: docs/theory/plane.md.
constexpr double kBound = 1e-5;

TEST(PlaneAround, AConcaveEvenLightIsOneEmitterToMostTiles) {
  PlaneScene scene = scene_of(horseshoe({40, 40}, 30, 26, 60));
  const Drawn even = draw(scene);
  scene.bodies[0].light->range = 1e4;  // nearly the same light, edge by edge
  const Drawn ranged = draw(scene);
  std::printf("even: off by %.1e, %llu lights on tiles; with a range %llu\n", even.worst,
              static_cast<unsigned long long>(even.stats.tile_lights), static_cast<unsigned long long>(ranged.stats.tile_lights));
  EXPECT_LT(even.worst, kBound);
  EXPECT_LT(even.stats.tile_lights, ranged.stats.tile_lights);
}

TEST(PlaneAround, WhatStandsWithinTheHullOrInAHoleIsSeen) {
  PlaneScene scene = scene_of(horseshoe({40, 40}, 30, 20, 40));
  PlaneBody box = plane_polygon({{44, 36}, {50, 36}, {50, 44}, {44, 44}});
  scene.bodies.push_back(box);  // in the mouth
  EXPECT_LT(draw(scene).worst, kBound);
  // An island of the light in its own mouth, and a hole in its ring.
  scene.bodies.pop_back();
  scene.bodies[0].contours.push_back({{44, 36}, {50, 36}, {50, 44}, {44, 44}});
  scene.bodies[0].contours.push_back({{12, 38}, {18, 38}, {18, 42}, {12, 42}});
  scene.bodies[0].even_odd = true;
  EXPECT_LT(draw(scene).worst, kBound);
}

TEST(PlaneAround, OutlinesOfManyVerticesBlockAsTheirEdgesDo) {
  SceneRandom random(5);
  for (int trial = 0; trial < 6; ++trial) {
    PlaneScene scene = scene_of(horseshoe({24, 24}, 14, 9, 30));
    for (int i = 0; i < 5; ++i) {
      const Vec2d center{random.uniform(10, 90), random.uniform(40, 75)};
      scene.bodies.push_back(plane_polygon(horseshoe(center, random.uniform(4, 9), random.uniform(1, 3), 20)));
    }
    const Drawn drawn = draw(scene);
    EXPECT_LT(drawn.worst, kBound) << trial;
  }
}

TEST(PlaneAround, HullsAndClosedOutlines) {
  const std::vector<Vec2d> hull = hull_around({{0, 0}, {2, 0}, {1, 0}, {1, 1}, {2, 2}, {0, 2}, {1, 2}, {0.5, 0.5}});
  ASSERT_EQ(hull.size(), 4u);  // no point of an edge, none of the inside
  double area = 0;
  for (std::size_t k = 0; k < 4; ++k) area += 0.5 * cross(hull[k], hull[(k + 1) % 4]);
  EXPECT_EQ(area, 4);
  const std::vector<Vec2d> corners = {{0, 0}, {4, 0}, {4, 4}, {2, 1}, {0, 4}};
  std::vector<Curve> curves;
  for (std::size_t k = 0; k < corners.size(); ++k) {
    Curve edge;
    edge.kind = Curve::Kind::segment;
    edge.a = corners[k];
    edge.b = corners[(k + 1) % corners.size()];
    if (k == 2) std::swap(edge.a, edge.b);  // edges may have been reversed
    curves.push_back(edge);
  }
  const std::vector<Chain> closed = closed_outlines(curves.data(), curves.size());
  ASSERT_EQ(closed.size(), 1u);
  EXPECT_EQ(closed[0].count, 5u);
  EXPECT_EQ(closed[0].hull.size(), 4u);
  curves.pop_back();  // an open line has no inside
  EXPECT_TRUE(closed_outlines(curves.data(), curves.size()).empty());
}

}  // namespace
}  // namespace steradian::plane::around_test
