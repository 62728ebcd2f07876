// Paths against closed forms: furnaces, two parallel planes, and a box that no light enters.
#include <gtest/gtest.h>

#include <cmath>

#include "steradian/render.h"
#include "support/meshes.h"

namespace steradian::paths_test {
namespace {

using namespace scene;

SurfaceMaterial grey(float albedo) {
  SurfaceMaterial m;
  m.base_color = {albedo, albedo, albedo, 1};
  m.metallic = 0;
  m.specular = 0;
  return m;
}

// The inner sides of a box of half side 1. With `shining`, each side is a light of radiance 1.
Scene box(float albedo, bool shining) {
  Scene scene;
  scene.materials = {grey(albedo)};
  const Vec3d axes[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  for (int a = 0; a < 3; ++a)
    for (const double side : {-1.0, 1.0}) {
      const Vec3d n = axes[a] * side, u = axes[(a + 1) % 3] * side, v = axes[(a + 2) % 3];
      const auto corner = [&](double x, double y) { return n + u * x + v * y; };
      const Vec3d corners[4] = {corner(-1, 1), corner(1, 1), corner(1, -1), corner(-1, -1)};  // seen from inside
      const auto f = [&](int i) { return static_cast<Vec3f>(corners[i]); };
      scene.meshes.push_back(quad_mesh(f(0), f(1), f(2), f(3), 0));
      if (!shining) continue;
      AreaLight light;
      Polygon polygon;
      polygon.vertices = {corners[0], corners[1], corners[2], corners[3]};
      light.shape = polygon;
      light.radiance = {1, 1, 1};
      scene.area_lights.push_back(light);
    }
  scene.bounds_min = {-1, -1, -1};
  scene.bounds_max = {1, 1, 1};
  scene.cameras = {camera_at({0.1, 0.2, 0.6}, {0.1, -0.3, -1}, 1.2)};
  return scene;
}

Picture picture_of(const Scene& scene, int bounces, int spp) {
  RenderOptions options;
  options.width = options.height = 8;
  options.method = "sampled";
  options.spp = spp;
  options.shadows = Shadows::off;
  options.bounces = bounces;
  return render(scene, options);
}

// Mean of a picture's first channel, and the standard error of the mean.
struct Mean {
  double value = 0, error = 0;
};
Mean mean_of(const Picture& picture) {
  Mean mean;
  for (std::size_t i = 0; i < picture.pixels.size(); ++i) {
    mean.value += static_cast<double>(picture.pixels[i].x);
    mean.error += static_cast<double>(picture.layers.at("variance")[i].x);
  }
  const auto n = static_cast<double>(picture.pixels.size());
  return {mean.value / n, std::sqrt(mean.error) / n};
}

}  // namespace

// In a closed box whose sides shine with 1 and reflect a fraction r, the reflected radiance is r + r^2 + ... : to r^(n + 1) after n
// bounces.
TEST(Paths, TheFurnaceIsTheGeometricSeries) {
  for (const float r : {0.3f, 0.8f})
    for (const int bounces : {0, 1, 3, kAllBounces}) {
      double truth = 0, power = 1;
      for (int k = 0; k <= (bounces == kAllBounces ? 400 : bounces); ++k) truth += power *= static_cast<double>(r);
      const Mean mean = mean_of(picture_of(box(r, true), bounces, 64));
      std::printf("albedo %.1f, %d bounces: %.4f +- %.4f, exactly %.4f\n", static_cast<double>(r), bounces, mean.value, mean.error, truth);
      EXPECT_NEAR(mean.value, truth, 4 * mean.error + 2e-4) << r << " " << bounces;
    }
}

// A box without a light of its own, in the light of a lamp outside: nothing enters.
TEST(Paths, NoLightEntersAClosedBox) {
  Scene scene = box(0.7f, false);
  AreaLight lamp;
  lamp.shape = Ellipsoid{{0, 3, 0}, {0.5, 0, 0}, {0, 0.5, 0}, {0, 0, 0.5}};
  lamp.radiance = {100, 100, 100};
  scene.area_lights = {lamp};
  RenderOptions options;
  options.width = options.height = 8;
  options.method = "sampled";
  options.shadows = Shadows::on;
  options.bounces = kAllBounces;
  for (const Vec3f& p : render(scene, options).pixels) EXPECT_EQ(p, (Vec3f{}));
}

}  // namespace steradian::paths_test
