// Tests of a tile's bounds against lights, compared with points within the bounds.
#include "render/lights/light_bounds.h"

#include <gtest/gtest.h>

#include <random>

namespace steradian::light_bounds_test {
namespace {

struct Random {
  std::mt19937 bits{20};
  float in(float low, float high) { return std::uniform_real_distribution<float>(low, high)(bits); }
  Vec3f in(Vec3f low, Vec3f high) { return {in(low.x, high.x), in(low.y, high.y), in(low.z, high.z)}; }
  Vec3f vector(float size) { return in({-size, -size, -size}, {size, size, size}); }
};

PackLight polygon(Random& random) {
  const auto corner = [&](float size) { return static_cast<Vec3d>(random.vector(size)); };
  const Vec3d middle = corner(3), x = corner(1), y = corner(1);
  AreaLight light;
  light.shape = Polygon{{middle - x - y, middle + x - y, middle + x + y, middle - x + y}, {}};
  light.radiance = {1, 1, 1};
  Scene scene;
  scene.area_lights.push_back(light);
  return prepare_lights(scene).front();
}

PackLight disk(Random& random) {
  const auto vector = [&](float size) { return static_cast<Vec3d>(random.vector(size)); };
  AreaLight light;
  light.shape = Ellipse{vector(3), vector(1), vector(1)};
  light.radiance = {1, 1, 1};
  Scene scene;
  scene.area_lights.push_back(light);
  return prepare_lights(scene).front();
}

// The least height above a surface's horizon, and the visibility of the lit side.
struct Looked {
  float least = INFINITY;
  bool lit = false;
};
Looked look(const PackLight& light, Vec3f p, Vec3f n) {
  Looked looked;
  const auto add = [&](Vec3f v) { looked.least = std::min(looked.least, dot(v - p, n)); };
  if (const auto* outline = std::get_if<packed::FloatPolygon>(&light.shape)) {
    for (const Vec3f& v : outline->vertices) add(v);
    looked.lit = dot(p - outline->point, outline->normal) > 0;
  } else {
    const auto& d = std::get<packed::FloatDisk>(light.shape);
    for (float t = 0; t < 6.3f; t += 0.1f) add(d.point + d.x * std::cos(t) + d.y * std::sin(t));
    looked.lit = dot(p - d.point, d.normal) > 0;
  }
  return looked;
}

TEST(LightBounds, WhatIsSeenWholeIsSoByEverySurface) {
  Random random;
  int whole = 0, seen_whole_by_all = 0;
  for (int i = 0; i < 4000; ++i) {
    const PackLight light = i % 2 == 0 ? polygon(random) : disk(random);
    SurfaceBounds bounds;
    bounds.positions.low = random.vector(3);
    bounds.positions.high = bounds.positions.low + random.in({0, 0, 0}, {0.5f, 0.5f, 0.5f});
    bounds.normals.low = random.vector(1);
    bounds.normals.high = bounds.normals.low + random.in({0, 0, 0}, {0.2f, 0.2f, 0.2f});
    const bool says = sees_whole(light, bounds);
    bool all = true;
    for (int k = 0; k < 64; ++k) {
      const Looked looked =
          look(light, random.in(bounds.positions.low, bounds.positions.high), random.in(bounds.normals.low, bounds.normals.high));
      const bool sees = looked.lit && looked.least > -1e-5f;
      ASSERT_TRUE(sees || !says) << "light " << i << ", height " << looked.least;
      all = all && sees;
    }
    whole += says;
    seen_whole_by_all += all;
    EXPECT_TRUE(!says || reaches(light, bounds));
  }
  std::printf("%d of %d that 64 points of the bounds see whole are known to be\n", whole, seen_whole_by_all);
  EXPECT_GT(2 * whole, seen_whole_by_all);  // interval bounds lose some lights, but not most
}

TEST(LightBounds, ARoundLightThatCountsAsLargerIsNoLongerSeenWhole) {
  Scene scene;
  AreaLight light;
  light.shape = Ellipse{{0, 1, 0}, {0.5, 0, 0}, {0, 0.5, 0.0}};  // upright, its lowest point half a metre up
  light.radiance = {1, 1, 1};
  scene.area_lights.push_back(light);
  const PackLight disk = prepare_lights(scene).front();
  SurfaceBounds floor;
  floor.positions.low = {-1, 0, 1};
  floor.positions.high = {1, 0, 2};
  floor.normals.low = floor.normals.high = {0, 1, 0};
  EXPECT_TRUE(sees_whole(disk, floor));
  EXPECT_TRUE(sees_whole(disk, floor, 1.9f));
  EXPECT_FALSE(sees_whole(disk, floor, 2.1f));
  floor.positions.low.z = -1;  // some of it is behind the light
  EXPECT_FALSE(sees_whole(disk, floor));
}

}  // namespace
}  // namespace steradian::light_bounds_test
