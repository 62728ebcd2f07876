// Pixels whose centres lie on outlines: the frame equals the query, which puts them on one side.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <gtest/gtest.h>
#include <string>

#include "night.h"
#include "plane/exact/random.h"
#include "plane/exact/world.h"
#include "steradian/plane_stage.h"

namespace steradian::plane::on_outlines_test {
namespace {

Picture frame_of(const PlaneScene& scene) { return render_plane(PlaneWorld(scene), {}); }

// Number of pixels on outlines that are off by more than a frame may be.
int pixels_off(const PlaneScene& scene, const Picture& picture, double bound, const std::string& what, int& tried) {
  const PlaneWorld world(scene);
  const World& impl = world.impl();
  int off = 0;
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; x < picture.width; ++x) {
      const Vec2d p{x + 0.5, y + 0.5};
      if (impl.around(p * impl.scale).on.empty()) continue;
      ++tried;
      const Vec3d truth = world.query(p).radiance;
      const Vec3f pixel = picture.at(x, y);
      const double error = std::max({std::fabs(truth.x - static_cast<double>(pixel.x)), std::fabs(truth.y - static_cast<double>(pixel.y)),
                                     std::fabs(truth.z - static_cast<double>(pixel.z))});
      if (!(error <= bound) && ++off <= 2) ADD_FAILURE() << what << ": (" << x << ", " << y << ") is " << pixel.x << ", not " << truth.x;
    }
  return off;
}

}  // namespace

// 5, 12, 13: twelve centres lie on the rim. Eight of them were black.
TEST(PlaneOnOutlines, TheRimOfACircleBesideABoxIsWithinIt) {
  PlaneScene scene;
  scene.width = scene.height = 100;
  scene.bodies = {plane_circle({50.5, 50.5}, 13), plane_polygon({{70, 20}, {90, 20}, {90, 80}, {70, 80}})};
  scene.bodies[0].light.emplace();
  const Picture picture = frame_of(scene);
  for (const auto& [dx, dy] : {std::pair{13, 0}, {12, 5}, {5, 12}, {0, 13}})
    for (int sx : {-1, 1})
      for (int sy : {-1, 1}) EXPECT_FLOAT_EQ(picture.at(50 + sx * dx, 50 + sy * dy).x, 1) << sx * dx << ", " << sy * dy;
}

TEST(PlaneOnOutlines, FramesEqualTheQueryThere) {
  SceneRandom random(41);
  int off = 0, tried = 0;
  for (int s = 0; s < test::by_day_or_night(60, 1000); ++s) {
    PlaneScene scene;
    scene.width = 64;
    scene.height = 48;
    const auto whole = [&](double low, double high) { return std::floor(random.uniform(low, high)); };
    for (int i = 0; i < 5; ++i) {
      const Vec2d c{whole(4, 60) + 0.5, whole(4, 44) + 0.5};
      static constexpr double kRadii[] = {1, 2, 5, 10, 13, 15, 17};
      PlaneBody body = plane_circle(c, kRadii[static_cast<int>(whole(0, 7))]);
      switch ((s + i) % 5) {
        case 0: break;
        case 1: body.y_axis = {0, whole(1, 9)}; break;
        case 2:
          // Axes at right angles with whole components.
          body.x_axis = {whole(2, 9), whole(2, 9)};
          body.y_axis = Vec2d{-body.x_axis.y, body.x_axis.x} * 0.5;
          break;
        case 3:
          body.shape = PlaneBody::Shape::capsule;
          body.contours = {{c, c + Vec2d{whole(-9, 9), s % 2 == 0 ? 0 : whole(-9, 9)}}};
          body.radius = whole(1, 7);
          break;
        default: body = plane_polygon({c, c + Vec2d{whole(2, 20), 0}, c + Vec2d{whole(2, 9), whole(2, 20)}});
      }
      if (i % 2 == 0) {
        PlaneEmission& e = body.light.emplace();
        e.radiance = {1, 0.5, 0.1 * i};
        if (s % 6 == 1) e.range = 30;
        if (s % 6 == 3) e.profile = PlaneProfile::lambert;
        if (s % 6 == 5) e.gradient = PlaneGradient{c, c + Vec2d{9, 4}, {{0, {1, 0, 0}}, {0.5, {0, 1, 0}}, {1, {0, 0.5, 1}}}};
      }
      scene.bodies.push_back(body);
    }
    const Picture picture = frame_of(scene);
    off += pixels_off(scene, picture, 1e-5, "scene " + std::to_string(s), tried);
    if (s % 10 != 0) continue;
    PlaneStage stage(scene);
    EXPECT_TRUE(stage.draw().pixels == picture.pixels) << "the stage of scene " << s;
    stage.move(0, {1, 0});
    EXPECT_TRUE(stage.draw().pixels == frame_of(stage.scene()).pixels) << "the stage of scene " << s << ", moved";
  }
  EXPECT_EQ(off, 0) << "of " << tried;
  std::printf("pixels on outlines: %d of %d are off\n", off, tried);
}

}  // namespace steradian::plane::on_outlines_test
