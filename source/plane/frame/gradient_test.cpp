// Gradients with stops up to 1e8 times brighter than others: no pixel is negative.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <gtest/gtest.h>
#include <numbers>

#include "night.h"
#include "plane/exact/on_curve.h"
#include "plane/exact/random.h"
#include "plane/exact/world.h"

namespace steradian::plane::gradient_test {

// Lines, boxes, ellipses and capsules, behind blockers.
TEST(PlaneGradientFrames, AreNotNegativeBesideMuchBrighterStops) {
  SceneRandom random(12);
  int negative = 0, off = 0, tried = 0;
  float least = 0;
  for (int s = 0; s < test::by_day_or_night(60, 600); ++s) {
    PlaneScene scene;
    scene.width = 96;
    scene.height = 64;
    const Vec2d c{random.uniform(20, 76), random.uniform(15, 49)};
    const auto v = [&](double r) { return Vec2d{random.uniform(-r, r), random.uniform(-r, r)}; };
    PlaneBody body = plane_circle(c, random.uniform(2, 12));
    if (s % 5 == 1) body.y_axis = body.y_axis * 0.4;
    if (s % 5 == 2) body.shape = PlaneBody::Shape::capsule, body.contours = {{c, c + v(20)}}, body.radius = 3;
    if (s % 5 == 3) body.shape = PlaneBody::Shape::polyline, body.contours = {{c, c + v(20), c + v(20)}};
    if (s % 5 == 4) body = plane_polygon({c, c + v(20), c + v(20)});
    PlaneEmission& e = body.light.emplace();
    e.profile = static_cast<PlaneProfile>(s % 3);
    if (s % 4 == 3) e.range = random.uniform(10, 60);
    PlaneGradient& gradient = e.gradient.emplace(PlaneGradient{c + v(12), c + v(12), {}});
    const double ratio = std::pow(10, random.uniform(0, 8));
    for (int i = 0; i < 5; ++i) {
      const double radiance = i % 2 == s % 2 ? ratio : 1 - i % 3;
      gradient.stops.push_back({0.25 * i, {std::max(radiance, 0.0), 1, ratio - std::max(radiance, 0.0)}});
    }
    scene.bodies = {body, plane_polygon({c + v(30), c + v(30), c + v(30)}), plane_circle(c + v(30), 4)};
    const PlaneWorld world(scene);
    const Picture picture = render_plane(world, {});
    for (int y = 0; y < picture.height; ++y)
      for (int x = 0; x < picture.width; ++x) {
        const Vec3f pixel = picture.at(x, y);
        const float low = std::min({pixel.x, pixel.y, pixel.z});
        ++tried;
        negative += low < 0;
        least = std::min(least, low);
        if ((x + y) % 7 != 0) continue;
        const Vec3d truth = world.query({x + 0.5, y + 0.5}).radiance;
        const double error = std::max({std::fabs(truth.x - static_cast<double>(pixel.x)), std::fabs(truth.y - static_cast<double>(pixel.y)),
                                       std::fabs(truth.z - static_cast<double>(pixel.z))});
        // A frame's own bound. Places are rounded to 2^-25 of a tile of 16 pixels, twice, and 1/r with them.
        double bound = 1e-5 * std::max({ratio, 2.0, truth.x, truth.y, truth.z});
        if (e.profile == PlaneProfile::inverse) {
          double nearest = 1e300;
          for (std::size_t k = 0; k < world.impl().first_curve[1]; ++k)
            nearest =
                std::min(nearest, distance_to(world.impl().curves[k], Vec2d{x + 0.5, y + 0.5} * world.impl().scale) / world.impl().scale);
          bound *= 3 + 0.1 / nearest;
        }
        if (!(error <= bound) && ++off <= 3) ADD_FAILURE() << "scene " << s << ", (" << x << ", " << y << ") is off by " << error / bound;
      }
  }
  EXPECT_EQ(negative, 0) << "of " << tried << ", the least " << least;
  EXPECT_EQ(off, 0);
  std::printf("gradients: %d of %d pixels negative, the least %.1e, %d off\n", negative, tried, static_cast<double>(least), off);
}

}  // namespace steradian::plane::gradient_test
