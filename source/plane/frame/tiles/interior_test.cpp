// Pixels within lights of any outline, into which other shapes reach, against the query.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "plane/exact/world.h"

namespace steradian::plane::interior_test {
namespace {

// A snake that winds around itself, and a comb: from most of their places a chain of their own edges occludes the shapes that reach into
// them.
PlaneScene winding_lights() {
  return load_plane_scene_from_text(
             R"svg(<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 320 200">
  <linearGradient id="g"><stop offset="0" stop-color="#f80"/><stop offset="1" stop-color="#08f"/></linearGradient>
  <path class="light" fill="url(#g)" d="M10 60C60 0 100 0 150 60S240 120 300 60L300 90C240 150 200 150 150 90S60 30 10 90Z"/>
  <path class="light" fill="#ff8" d="M20 120H300V190H280V140H220V190H200V140H140V190H120V140H60V190H20Z"/>
  <rect x="70" y="10" width="12" height="30" transform="rotate(20 76 25)"/>
  <circle cx="150" cy="80" r="9"/><ellipse cx="232" cy="100" rx="14" ry="5"/>
  <line x1="270" y1="70" x2="295" y2="95" stroke="#000"/>
  <circle class="light" fill="#fff" cx="40" cy="60" r="6"/>
  <path d="M100 120v12M210 150v50" stroke="#000" fill="none"/><rect class="light" fill="#0f8" x="30" y="150" width="16" height="9"/>
  <path d="M180 125l20 8" stroke="#000" stroke-width="6" stroke-linecap="round"/>
</svg>)svg",
             "winding lights")
      .scene;
}

}  // namespace

TEST(PlaneInterior, EqualsTheQueryWithinWindingLights) {
  const PlaneScene scene = winding_lights();
  const PlaneWorld world(scene);
  PlaneFrameOptions options;
  options.width = 320;
  options.height = 200;
  const Picture picture = render_plane(world, options);
  int inside = 0, shaded = 0;
  double worst = 0;
  for (int i = 0; i < 320 * 200; i += 31) {
    const int x = i % 320, y = i / 320;
    const Vec2d p{x + 0.5, y + 0.5};
    int light = -1;
    bool dark = false;
    for (std::size_t b = 0; b < scene.bodies.size(); ++b)
      if (contains(scene.bodies[b], p)) {
        if (scene.bodies[b].light)
          light = static_cast<int>(b);
        else
          dark = true;
      }
    if (light < 0 || dark) continue;
    ++inside;
    const Vec3d exact = world.query(p).radiance, own = radiance_at(*scene.bodies[static_cast<std::size_t>(light)].light, p);
    shaded += std::fabs(exact.y - own.y) > 1e-3 ? 1 : 0;
    const Vec3f drawn = picture.at(x, y);
    const Vec3d off = exact - static_cast<Vec3d>(drawn);
    worst = std::max({worst, std::fabs(off.x), std::fabs(off.y), std::fabs(off.z)});
  }
  std::printf("%d pixels within lights, %d of them shaded: largest difference %.1e\n", inside, shaded, worst);
  EXPECT_GT(shaded, 200);
  EXPECT_GT(inside - shaded, 50);
  // Both are in double; the output is a float.
  EXPECT_LE(worst, 2e-7);
}

}  // namespace steradian::plane::interior_test
