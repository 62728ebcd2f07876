// Shadows of pictures, against rays.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "steradian/render.h"
#include "support/judged_pictures.h"
#include "support/meshes.h"
#include "support/z_test.h"

namespace steradian::shadow_render_test {
namespace {

using namespace scene;

using namespace image;

SurfaceMaterial diffuse(float albedo) {
  SurfaceMaterial m;
  m.base_color = {albedo, albedo, albedo, 1};
  m.metallic = 0;
  m.specular = 0;
  return m;
}

void add_box(Scene& scene, Vec3f low, Vec3f high, int material) {
  const auto face = [&](Vec3f a, Vec3f b, Vec3f c, Vec3f d) { scene.meshes.push_back(quad_mesh(a, b, c, d, material)); };
  const auto [x0, y0, z0] = low;
  const auto [x1, y1, z1] = high;
  face({x0, y0, z1}, {x1, y0, z1}, {x1, y1, z1}, {x0, y1, z1});
  face({x1, y0, z0}, {x0, y0, z0}, {x0, y1, z0}, {x1, y1, z0});
  face({x1, y0, z1}, {x1, y0, z0}, {x1, y1, z0}, {x1, y1, z1});
  face({x0, y0, z0}, {x0, y0, z1}, {x0, y1, z1}, {x0, y1, z0});
  face({x0, y1, z1}, {x1, y1, z1}, {x1, y1, z0}, {x0, y1, z0});
  face({x0, y0, z0}, {x1, y0, z0}, {x1, y0, z1}, {x0, y0, z1});
}

// A floor with a standing box, a ball that touches it, a plate in the air and a plate that leans on the box.
Scene still_life() {
  Scene scene;
  scene.materials = {diffuse(0.6f), diffuse(0.4f)};
  scene.meshes = {quad_mesh({-4, 0, 4}, {4, 0, 4}, {4, 0, -4}, {-4, 0, -4}, 0)};
  scene.cameras = {camera_at({0, 2, 3}, {0, -1.8, -3})};
  scene.cameras[0].name = "main";
  add_box(scene, {-0.9f, 0, -0.5f}, {-0.3f, 0.7f, 0.1f}, 1);
  scene.meshes.push_back(ball_mesh({0.4f, 0.35f, 0.1f}, 0.35f, 1, 16, 8));
  scene.meshes.push_back(quad_mesh({0.6f, 1, 0.3f}, {1.2f, 1, 0.2f}, {1.2f, 1.1f, -0.4f}, {0.6f, 1.1f, -0.5f}, 1));
  scene.meshes.push_back(quad_mesh({-0.3f, 0, 0.3f}, {0.1f, 0, 0.3f}, {-0.1f, 0.6f, -0.2f}, {-0.5f, 0.6f, -0.2f}, 1));
  return scene;
}

constexpr Vec3d kCenter{0.3, 2.2, 0.2}, kX{0.5, 0, 0}, kZ{0, 0.1, 0.4};

AreaLight panel() { return {Polygon{{kCenter - kX - kZ, kCenter + kX - kZ, kCenter + kX + kZ, kCenter - kX + kZ}, {}}, {3, 2, 1}}; }
AreaLight disk() { return {Ellipse{kCenter, kX, kZ}, {3, 2, 1}}; }
AreaLight ball() { return {Ellipsoid{kCenter, {0.4, 0, 0}, {0, 0.4, 0}, {0, 0, 0.4}}, {3, 2, 1}}; }
AreaLight tube() { return {Capsule{kCenter - Vec3d{0.6, 0.1, 0}, kCenter + Vec3d{0.6, 0.1, 0}, 0.15}, {3, 2, 1}}; }

RenderOptions small() {
  RenderOptions options;
  options.width = 80;
  options.height = 50;
  options.shadows = Shadows::on;
  return options;
}

// The value at every pixel agrees with rays, contacts and curved meshes' terminators included.
TEST(ShadowRender, AgreesWithTheReferenceAtEveryPixel) {
  for (const AreaLight& light : {panel(), disk(), ball(), tube()}) {
    Scene scene = still_life();
    scene.area_lights = {light};
    const auto [open, analytic, reference] = judged_pictures(scene, small(), 0.02);
    // Round lights use polygons of 24 corners, the reference their surface: 1e-3 of the light at most. That is a larger fraction of the
    // light left in a penumbra.
    const ZTest z = z_test(analytic, reference, std::holds_alternative<Polygon>(light.shape) ? 2e-4 : 5e-3);
    EXPECT_GT(z.tested, 3000u);
    EXPECT_GE(z.share(), 0.9975) << "shape " << light.shape.index() << ", worst " << z.worst;
  }
}

// Lights that geometry enters or stands close to: a globe sunk in a ceiling at three depths, a tube through a wall, a tube whose end stands
// over a shelf, and a tube along a board.
TEST(ShadowRender, AgreesWithTheReferenceUnderLightsThatGeometryEnters) {
  const auto ceiling = [](float height, float half) {
    return quad_mesh({-half, height, -half}, {half, height, -half}, {half, height, half}, {-half, height, half}, 0);
  };
  const AreaLight upright{Capsule{{0.2, 1.1, 0.4}, {0.25, 2, 0.4}, 0.06}, {9, 6, 3}};
  const Mesh wall = quad_mesh({0.4f, 1.5f, -1}, {0.4f, 3, -1}, {0.4f, 3, 1}, {0.4f, 1.5f, 1}, 0);
  const Mesh shelf = quad_mesh({0, 1, 0.2f}, {0.5f, 1, 0.2f}, {0.5f, 0.98f, 0.6f}, {0, 0.98f, 0.6f}, 0);
  struct Case {
    const char* name;
    AreaLight light;
    Mesh mesh;
  };
  const Case cases[] = {{"globe, a quarter out", ball(), ceiling(2, 3)},
                        {"globe, half out", ball(), ceiling(2.2f, 3)},
                        {"globe, three quarters out", ball(), ceiling(2.4f, 3)},
                        {"tube through a wall", tube(), wall},
                        {"tube over a shelf", upright, shelf},
                        {"tube along a board", tube(), ceiling(2.3f, 1)}};
  for (const Case& c : cases) {
    Scene scene = still_life();
    scene.area_lights = {c.light};
    scene.meshes.push_back(c.mesh);
    const auto [open, analytic, reference] = judged_pictures(scene, small(), 0.02);
    const ZTest z = z_test(analytic, reference, 5e-3);
    EXPECT_GT(z.tested, 2000u) << c.name;
    EXPECT_GE(z.share(), 0.9975) << c.name << ", worst " << z.worst;
    std::printf("%s: %zu pixels, share %.5f, worst %.2f\n", c.name, static_cast<std::size_t>(z.tested), z.share(), z.worst);
  }
}

TEST(ShadowRender, LobesUnderPartsOfLightsAgreeWithTheReference) {
  Scene scene = still_life();
  scene.materials[0].specular = 1;
  scene.materials[0].roughness = 0.5f;
  scene.materials[1].metallic = 1;
  scene.materials[1].roughness = 0.4f;
  scene.area_lights = {panel()};
  RenderOptions options = small();
  const Picture analytic = render(scene, options);
  options.method = "reference";
  options.target_error = 0.02;
  // Error of the closed form itself: 0.3 % rms, a few per cent at single points.
  const ZTest z = z_test(analytic, render(scene, options), 0.03);
  EXPECT_GE(z.share(), 0.9975) << "worst " << z.worst;
}

// Points close to a long tube, far from both of its ends, and points beyond an end along its axis. All of them see the tube, and as much of
// it as without shadows if nothing occludes it. A speck of a mesh keeps the tiles off the path without occluders.
TEST(ShadowRender, SeesALongTubeFromRightBesideItAndBeyondItsEnd) {
  Scene scene = still_life();
  scene.meshes.resize(1);
  scene.meshes.push_back(quad_mesh({-0.2f, 0.9f, 0.1f}, {-0.1999f, 0.9f, 0.1f}, {-0.1999f, 0.9f, 0.1001f}, {-0.2f, 0.9f, 0.1001f}, 0));
  const Capsule tubes[] = {
      {{-3, 0.06, 0.3}, {2, 0.06, 0.1}, 0.04}, {{-3, 0.3, 0.3}, {2, 0.4, 0.1}, 0.1}, {{0, 0.3, 0}, {0.1, 1.3, 0}, 0.2}};
  for (const Capsule& tube : tubes) {
    scene.area_lights = {AreaLight{tube, {3, 2, 1}}};
    RenderOptions options = small();
    const Picture shadowed = render(scene, options);
    options.shadows = Shadows::off;
    const Picture open = render(scene, options);
    // A polygon of 24 corners against the outline itself: 1e-3 of the light (docs/shadows.md), whose radiance is 3.7 long.
    for (std::size_t i = 0; i < open.pixels.size(); ++i)
      ASSERT_LT(length(shadowed.pixels[i] - open.pixels[i]), 5e-3f * (1 + length(open.pixels[i]))) << tube.end_a.y << ", " << i;
  }
}

// A ball with few facets and a ball's normals, seen from the side of its terminator.
Scene ball_scene(unsigned columns, unsigned rows) {
  Scene scene = still_life();
  scene.meshes = {ball_mesh({0, 1, 0}, 0.8f, 1, columns, rows)};
  scene.area_lights = {AreaLight{Polygon{{{-2.4, 2.2, -0.2}, {-2.4, 2.2, 0.2}, {-2.5, 1.8, 0.2}, {-2.5, 1.8, -0.2}}, {}}, {80, 60, 40}}};
  return scene;
}

// Counts pixels whose surface faces the light and that lose more than half of it to shadows.
int shadowed_pixels(const Picture& shadowed, const Picture& open) {
  int count = 0;
  for (std::size_t i = 0; i < open.pixels.size(); ++i) count += open.pixels[i].x > 0.01f && shadowed.pixels[i].x < 0.5f * open.pixels[i].x;
  return count;
}

// A ball alone occludes only the light below its own horizon, and the normals give that without any shadow. Its facets occlude more.
TEST(ShadowRender, ASmoothTerminatorIsThatOfTheSurfaceThatNormalsDescribe) {
  const Scene scene = ball_scene(16, 8);
  RenderOptions options = small();
  options.terminator = Terminator::strict;
  const Picture strict = render(scene, options);
  options.terminator = Terminator::smooth;
  const Picture smooth = render(scene, options);
  options.shadows = Shadows::off;
  const Picture open = render(scene, options);
  EXPECT_GT(shadowed_pixels(strict, open), 10);
  EXPECT_EQ(shadowed_pixels(smooth, open), 0);
}

TEST(ShadowRender, ASmoothTerminatorIsTheSameToRays) {
  const Scene scene = ball_scene(16, 8);
  RenderOptions options = small();
  options.terminator = Terminator::smooth;
  const auto [open, analytic, reference] = judged_pictures(scene, options, 0.02);
  const ZTest z = z_test(analytic, reference, 2e-4);
  EXPECT_GT(z.tested, 500u);
  EXPECT_GE(z.share(), 0.9975) << "worst " << z.worst;
}

// A convex ball occludes no light above its triangles' horizons, however far away the light is: as far as those of an environment, float
// coordinates from the light's place have no digits for the triangles of the ball.
TEST(ShadowRender, ABallHasNoSpecksUnderAFarLight) {
  Scene scene;
  scene.materials = {diffuse(0.6f)};
  scene.meshes = {ball_mesh({0.1f, -0.2f, 0.3f}, 1, 0, 64, 32)};
  scene.cameras = {camera_at({0.1, -0.2, 4.3}, {0, 0, -1}, 0.45)};  // the ball fills it
  RenderOptions options = small();
  options.width = options.height = 160;
  for (const double distance : {30.0, 1e3, 1e4, 1e5}) {
    const Vec3d center = Vec3d{0.3, 0.2, 1} * distance, x = Vec3d{0.2, 0, -0.06} * distance, y = Vec3d{0, 0.2, -0.04} * distance;
    scene.area_lights = {{Polygon{{center - x - y, center - x + y, center + x + y, center + x - y}, {}}, {1, 1, 1}}};
    for (const Terminator terminator : {Terminator::strict, Terminator::smooth}) {
      options.terminator = terminator;
      options.shadows = Shadows::off;
      const Picture open = render(scene, options);
      options.shadows = Shadows::on;
      const Picture shadowed = render(scene, options);
      for (int py = 20; py < 140; ++py)
        for (int px = 20; px < 140; ++px) {
          if (std::hypot(px - 79.5, py - 79.5) > 60) continue;
          const Vec3f a = open.at(px, py), b = shadowed.at(px, py);
          EXPECT_GT(length(a), 0.01f);
          // A speck loses all of the light. Parts of the light are sums of roundings of edges, far below a thousandth.
          EXPECT_LT(length(a - b), 1e-3f * length(a)) << distance << " at " << px << ' ' << py;
        }
    }
  }
}

TEST(ShadowRender, GivesTheSameBytesAtAnyNumberOfThreads) {
  Scene scene = still_life();
  scene.area_lights = {panel(), ball()};
  RenderOptions options = small();
  options.threads = 1;
  const Picture one = render(scene, options);
  options.threads = 2;
  EXPECT_EQ(one.pixels, render(scene, options).pixels);
}

TEST(ShadowRender, NothingBetweenChangesNothing) {
  Scene scene = still_life();
  scene.meshes.resize(1);
  scene.area_lights = {panel(), ball()};
  RenderOptions options = small();
  const Picture shadowed = render(scene, options);
  options.shadows = Shadows::off;
  const Picture open = render(scene, options);
  for (std::size_t i = 0; i < open.pixels.size(); ++i)
    ASSERT_LT(length(shadowed.pixels[i] - open.pixels[i]), 1e-5f * (1 + length(open.pixels[i]))) << i;
}

}  // namespace
}  // namespace steradian::shadow_render_test
