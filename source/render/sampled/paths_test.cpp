// Paths against closed forms: furnaces, two parallel planes, and a box that no light enters.
#include <gtest/gtest.h>

#include <cmath>

#include "steradian/render.h"
#include "support/boxes.h"

namespace steradian::paths_test {
namespace {

using namespace scene;

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
      const Mean mean = mean_of(picture_of(closed_box(r, true), bounces, 64));
      std::printf("albedo %.1f, %d bounces: %.4f +- %.4f, exactly %.4f\n", static_cast<double>(r), bounces, mean.value, mean.error, truth);
      EXPECT_NEAR(mean.value, truth, 4 * mean.error + 2e-4) << r << " " << bounces;
    }
}

// A box without a light of its own, in the light of a lamp outside: nothing enters.
TEST(Paths, NoLightEntersAClosedBox) {
  Scene scene = closed_box(0.7f, false);
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
