// Pictures under closed meshes that shine evenly, against rays to their faces.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "core/budget.h"
#include "night.h"
#include "scene/emitters/emitters.h"
#include "steradian/render.h"
#include "support/meshes.h"
#include "support/rings.h"
#include "support/z_test.h"

namespace steradian::solid_render_test {
namespace {

using namespace scene;
using namespace image;

// A ring over a floor, a wall and a box. The camera also shows the ring, whose own surface is lit by it.
Scene under_a_ring(float albedo_of_ring) {
  Scene scene;
  SurfaceMaterial wall, ring, glossy;
  wall.base_color = {0.6f, 0.6f, 0.6f, 1};
  wall.metallic = wall.specular = 0;
  glossy = wall;
  glossy.specular = 1;
  glossy.roughness = 0.5f;
  ring = wall;
  ring.base_color = {albedo_of_ring, albedo_of_ring, albedo_of_ring, 1};
  ring.emissive = {3, 2, 1};
  scene.materials = {wall, ring, glossy};
  scene.meshes = {quad_mesh({-3, 0, 3}, {3, 0, 3}, {3, 0, -1.5f}, {-3, 0, -1.5f}, 2),
                  quad_mesh({-3, 0, -1.5f}, {3, 0, -1.5f}, {3, 3, -1.5f}, {-3, 3, -1.5f}, 0),
                  ball_mesh({0.3f, 0.35f, 0.4f}, 0.35f, 0, 16, 8), ring_mesh({0, 1.5, 0}, 0.6, 0.12, 0.7, 1, 20, 8)};
  scene.meshes.push_back(quad_mesh({-0.9f, 0.7f, 0.6f}, {-0.2f, 0.7f, 0.6f}, {-0.2f, 0.7f, 0}, {-0.9f, 0.7f, 0}, 0));
  scene.cameras = {camera_at({0, 1.6, 4}, {0, -0.6, -4})};
  Budget budget;
  add_emitters(scene, budget, "a test");
  return scene;
}

RenderOptions small(Shadows shadows) {
  RenderOptions options;
  options.width = 60;
  options.height = 38;
  options.shadows = shadows;
  return options;
}

double mean_of(const Picture& picture) {
  double sum = 0;
  for (const Vec3f& p : picture.pixels) sum += static_cast<double>(p.x + p.y + p.z) / 3;
  return sum / static_cast<double>(picture.pixels.size());
}

// Rays may estimate the shadows of lamps beside the ring that are dim, while the ring stays one light with one outline.
TEST(SolidRender, KeepsItsOutlineBesideDimLamps) {
  Scene scene = under_a_ring(0.5f);
  for (int i = 0; i < 12; ++i) {
    AreaLight lamp;
    lamp.shape = Ellipse{{-1.5 + 0.25 * i, 2, 1}, {0.05, 0, 0}, {0, 0, 0.05}};
    lamp.two_sided = true;
    lamp.radiance = {1e-3, 1e-3, 1e-3};
    scene.area_lights.push_back(std::move(lamp));
  }
  RenderOptions options = small(Shadows::on);
  RenderStats stats;
  const Picture picture = render(scene, options, &stats);
  EXPECT_EQ(stats.lights, 13u);
  EXPECT_GT(stats.shadows_estimated, 0);
  options.shadow_error = 0;
  const Picture exact = render(scene, options, &stats);
  const std::vector<Vec3f>& bound = picture.layers.at("shadow_bound");
  for (std::size_t i = 0; i < bound.size(); ++i) {
    const float most = std::max({exact.pixels[i].x, exact.pixels[i].y, exact.pixels[i].z}), rounding = 1e-6f * most;
    EXPECT_LE(std::fabs(picture.pixels[i].x - exact.pixels[i].x), bound[i].x + rounding) << i;
    EXPECT_LE(bound[i].x, 1e-3f * most + rounding) << i;
  }
}

// Every pixel agrees with rays, and the picture with that of the single faces.
TEST(SolidRender, AgreesWithTheReferenceAtEveryPixel) {
  const Scene scene = under_a_ring(0.5f);
  RenderStats stats, of_faces;
  RenderOptions options = small(Shadows::on);
  const Picture solid = render(scene, options, &stats);
  const Picture faces = render(scene, small(Shadows::exact), &of_faces);
  EXPECT_EQ(stats.lights, 1u);
  EXPECT_GE(of_faces.lights, 160u);
  options.method = "reference";
  options.target_error = test::by_day_or_night(0.1, 0.05);
  const Picture reference = render(scene, options);
  // The floor's GGX lobe is integrated by cubature: 1.5e-3 rms of its light at normal incidence of 0.04, a tenth of the floor's light.
  const ZTest z = z_test(solid, reference, 2e-4), single = z_test(faces, reference, 2e-4);
  double squares = 0;
  for (std::size_t i = 0; i < solid.pixels.size(); ++i) {
    const Vec3d d = static_cast<Vec3d>(solid.pixels[i]) - static_cast<Vec3d>(faces.pixels[i]);
    squares += dot(d, d) / 3;
  }
  const double rms = std::sqrt(squares / static_cast<double>(solid.pixels.size())) / mean_of(faces);
  std::printf("accepted %.5f, of single faces %.5f; rms to them %.1e\n", z.share(), single.share(), rms);
  EXPECT_GT(z.tested, 3000u);
  EXPECT_GE(z.share(), 0.9975) << "worst " << z.worst;
  EXPECT_LT(rms, 2e-4);
}

// Points in the ring's hole see it in no frame, but by its faces.
TEST(SolidRender, LightsWhatLiesInItsMidst) {
  Scene scene = under_a_ring(0);
  scene.meshes.push_back(ball_mesh({0, 1.5f, 0}, 0.3f, 0, 16, 8));
  scene.meshes.push_back(quad_mesh({-1, 1.5f, 0.3f}, {1, 1.5f, 0.3f}, {1, 1.5f, -0.3f}, {-1, 1.5f, -0.3f}, 0));
  const Picture solid = render(scene, small(Shadows::on)), faces = render(scene, small(Shadows::exact));
  double worst = 0;
  for (std::size_t i = 0; i < solid.pixels.size(); ++i)
    worst = std::max(worst, std::fabs(static_cast<double>(solid.pixels[i].x - faces.pixels[i].x)) / mean_of(faces));
  std::printf("worst difference %.1e of the mean\n", worst);
  EXPECT_LT(worst, 1e-3);  // of the cubature, see above; a face that is missing is 1e-2
}

// With all light, too, the picture's own light comes by the outline. Patches have rays to the faces, which share the rays of a few lights.
TEST(SolidRender, AllLightIsThatOfTheFacesAndOfPaths) {
  const Scene scene = under_a_ring(0.5f);
  RenderOptions options = small(Shadows::on);
  options.width = 30;
  options.height = 19;
  options.bounces = kAllBounces;
  RenderStats stats;
  const Picture solid = render(scene, options, &stats);
  EXPECT_EQ(stats.lights, 1u);
  options.shadows = Shadows::exact;
  const Picture faces = render(scene, options);
  double squares = 0;
  for (std::size_t i = 0; i < solid.pixels.size(); ++i) {
    const Vec3d d = static_cast<Vec3d>(solid.pixels[i]) - static_cast<Vec3d>(faces.pixels[i]);
    squares += dot(d, d) / 3;
  }
  // Direct light differs by 1.2e-4, as above. Light between surfaces is 5.6 %, and 16 rays of each patch leave about 0.5 % of noise in a
  // pixel's part of it, which differs between one light and 160.
  EXPECT_LT(std::sqrt(squares / static_cast<double>(solid.pixels.size())) / mean_of(faces), 4e-4);
  options.shadows = Shadows::on;
  options.method = "reference";
  options.target_error = 0.3;
  const Picture paths = render(scene, options);
  double variance = 0;
  for (const Vec3f& v : paths.layers.at("variance")) variance += static_cast<double>(v.x + v.y + v.z) / 3;  // channels go together
  const double error = std::sqrt(variance) / static_cast<double>(paths.pixels.size()) / mean_of(paths);
  const double ratio = mean_of(solid) / mean_of(paths);
  options.method = "auto";
  options.bounces = 0;
  const Picture direct = render(scene, options);
  std::printf("mean over that of paths %.4f, their standard error %.4f; without bounces %.3f\n", ratio, error,
              mean_of(direct) / mean_of(paths));
  double estimated = 0;
  for (const Vec3f& e : solid.layers.at("bounce_error")) estimated += static_cast<double>(e.x + e.y + e.z) / 3;
  estimated /= static_cast<double>(solid.pixels.size()) * mean_of(paths);
  EXPECT_NEAR(ratio, 1, 4 * error + estimated);
  EXPECT_LT(estimated, 0.02);                         // a third of the light between surfaces, or the test would see nothing
  EXPECT_LT(mean_of(direct) / mean_of(paths), 0.98);  // else the test would see nothing
}

TEST(SolidRender, IsTheSameAtAnyNumberOfThreads) {
  const Scene scene = under_a_ring(0.5f);
  RenderOptions options = small(Shadows::on);
  options.threads = 1;
  const Picture one = render(scene, options);
  options.threads = 2;
  EXPECT_EQ(one.pixels, render(scene, options).pixels);
}

}  // namespace
}  // namespace steradian::solid_render_test
