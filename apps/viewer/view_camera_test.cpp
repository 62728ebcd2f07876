// The camera of the window.
#include <gtest/gtest.h>

#include "support/viewer_session.h"

namespace steradian::view::view_camera_test {
namespace {

TEST(ViewCamera, RaysGoThroughThePixelsThatPointsProjectTo) {
  Session s(room(), small());
  s.wait_until_settled();
  s.camera().orbit(0.1, 0.2);
  s.camera().pan(0.1, -0.3);
  s.camera().look(-0.2, 0.1);
  const Camera c = s.camera().camera();
  EXPECT_NEAR(dot(c.x, c.y), 0, 1e-15);
  EXPECT_NEAR(length(cross(c.x, c.y) - c.z), 0, 1e-14);
  for (const Vec2d p : {Vec2d{0.5, 0.5}, Vec2d{80, 45}, Vec2d{159.5, 3}}) {
    const Ray r = ray_through(c, p, 160, 90);
    const auto back = project(c, r.origin + r.direction * 3, 160, 90);
    ASSERT_TRUE(back);
    EXPECT_NEAR(length(*back - p), 0, 1e-10);
  }
  EXPECT_FALSE(project(c, c.position + c.z, 160, 90)) << "behind";
}

TEST(ViewCamera, OrbitsAboutItsTargetAndDoesNotTurnOver) {
  Camera c;
  c.position = {0, 0, 5};
  ViewCamera v(c, 5);
  v.orbit(0.25, 0.1);
  EXPECT_NEAR(length(v.target()), 0, 1e-14);
  EXPECT_NEAR(length(v.camera().position), 5, 1e-14);
  for (int i = 0; i < 50; ++i) v.orbit(0, 0.3);
  EXPECT_GT(v.camera().y.y, 0) << "up stays up";
  EXPECT_GT(v.camera().position.y, 4.9);
}

}  // namespace
}  // namespace steradian::view::view_camera_test
