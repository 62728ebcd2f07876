// All light against closed forms that know nothing of patches.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <memory>
#include <numbers>

#include "steradian/area_light.h"
#include "steradian/environment.h"
#include "steradian/render.h"
#include "support/boxes.h"

namespace steradian::radiosity_test {
namespace {

using namespace scene;

RenderOptions all_light(int side, Quality quality) {
  RenderOptions options;
  options.width = options.height = side;
  options.shadows = Shadows::on;
  options.quality = quality;
  options.bounces = kAllBounces;
  return options;
}

// Reflected radiance at a place that a camera at a distance sees alone: the mean of 16 pixels.
double reflected_at(Scene scene, Vec3d place, Vec3d outwards, double* error) {
  scene.cameras = {camera_at(place + outwards, -outwards, 1e-4)};
  const Picture picture = render(scene, all_light(4, Quality::high));
  double sum = 0;
  *error = 0;
  for (std::size_t i = 0; i < picture.pixels.size(); ++i) {
    sum += static_cast<double>(picture.pixels[i].x);
    *error += static_cast<double>(picture.layers.at("bounce_error")[i].x + picture.layers.at("bounce_bound")[i].x);
  }
  *error /= static_cast<double>(picture.pixels.size());
  return sum / static_cast<double>(picture.pixels.size());
}

}  // namespace

// Two squares of side 1 at a distance of 1. The lower one emits 1.
TEST(RadiosityJudges, OfTwoSquares) {
  Scene scene;
  scene.materials = {grey(0.8f)};
  scene.meshes = {quad_mesh({0, 0, 1}, {1, 0, 1}, {1, 0, 0}, {0, 0, 0}, 0), quad_mesh({0, 1, 0}, {1, 1, 0}, {1, 1, 1}, {0, 1, 1}, 0)};
  AreaLight light;
  Polygon square;
  square.vertices = {{0, 0, 1}, {1, 0, 1}, {1, 0, 0}, {0, 0, 0}};
  light.shape = square;
  light.radiance = {1, 1, 1};
  scene.area_lights = {light};
  scene.bounds_min = {0, 0, 0};
  scene.bounds_max = {1, 1, 1};
  struct Place {
    const char* name;
    Vec3d at, outwards;
    double truth;
  };
  constexpr double kIn = 1e-4;  // of the corners: the light changes by 0.2 of itself a metre at most
  const Vec3d up{0, 0.5, 0};
  // Solutions of the integral equation by Gauss' rule of 14 x 14 nodes, converged to 1e-13.
  const Place places[] = {{"floor's centre", {0.5, 0, 0.5}, up, 0.0320750788611},
                          {"floor's corner", {kIn, 0, kIn}, up, 0.0182308142211},
                          {"ceiling's centre", {0.5, 1, 0.5}, -up, 0.1967633282008},
                          {"ceiling's corner", {kIn, 1, kIn}, -up, 0.1137780665405}};
  for (const Place& place : places) {
    double error = 0;
    const double ours = reflected_at(scene, place.at, place.outwards, &error);
    std::printf("%s: %.7f, off by %.1e, estimated error %.1e\n", place.name, ours, std::fabs(ours - place.truth), error);
    EXPECT_NEAR(ours, place.truth, 1e-4);
  }
}

// A lamp in the middle of a part of a sphere lights it evenly. Each place of a sphere sees all others alike, so a part of the area A
// receives its reflected light evenly: u = r A / (4 pi R^2 - r A) of the direct light.
TEST(RadiosityJudges, OfSpheresAndTheirCaps) {
  constexpr unsigned kColumns = 64, kRows = 32;
  for (const unsigned rows : {kRows, kRows / 2, kRows / 4}) {
    Scene scene;
    constexpr float kReflectance = 0.6f;
    scene.materials = {grey(kReflectance)};
    Mesh cap = ball_mesh({0, 0, 0}, 1, 0, kColumns, kRows);
    cap.indices.erase(cap.indices.begin(), cap.indices.end() - static_cast<std::ptrdiff_t>(6 * kColumns * rows));
    scene.meshes = {cap};
    PunctualLight lamp;
    scene.punctual_lights = {lamp};
    scene.bounds_min = {-1, -1, -1};
    scene.bounds_max = {1, 1, 1};
    scene.cameras = {camera_at({0.01, 0.01, 0.01}, {0.1, -1, 0.2}, 0.8)};
    const Picture picture = render(scene, all_light(16, Quality::draft));
    double direct = 0, indirect = 0, error = 0;
    for (std::size_t i = 0; i < picture.pixels.size(); ++i) {
      indirect += static_cast<double>(picture.layers.at("indirect")[i].x);
      direct += static_cast<double>(picture.pixels[i].x - picture.layers.at("indirect")[i].x);
      error += static_cast<double>(picture.layers.at("bounce_error")[i].x + picture.layers.at("bounce_bound")[i].x);
    }
    const double fraction = (1 - std::cos(std::numbers::pi * rows / kRows)) / 2, r = static_cast<double>(kReflectance);
    const double truth = r * fraction / (1 - r * fraction);
    std::printf("%.3f of a sphere: %.5f of the direct light, truth %.5f, estimated error %.4f\n", fraction, indirect / direct, truth,
                error / direct);
    EXPECT_NEAR(indirect / direct, truth, error / direct + 2e-3 * truth);
  }
}

// Things that reflect all light, under a sky of radiance 1, cannot be told from the sky.
TEST(RadiosityJudges, OfWhiteThingsUnderAWhiteSky) {
  Scene scene;
  scene.materials = {grey(1)};
  scene.meshes = {quad_mesh({-2, 0, 2}, {2, 0, 2}, {2, 0, -2}, {-2, 0, -2}, 0), ball_mesh({0.7f, 0.5f, 0}, 0.5f, 0, 48, 24),
                  quad_mesh({-1, 0.6f, 0.5f}, {0, 0.6f, 0.5f}, {0, 0.6f, -0.5f}, {-1, 0.6f, -0.5f}, 0),
                  quad_mesh({-1, 0, -0.5f}, {0, 0, -0.5f}, {0, 0.6f, -0.5f}, {-1, 0.6f, -0.5f}, 0)};
  scene.environment = std::make_shared<const Environment>(white_environment());
  scene.bounds_min = {-2, 0, -2};
  scene.bounds_max = {2, 1, 2};
  scene.cameras = {camera_at({0, 1.2, 3.5}, {0, -0.3, -1}, 0.7)};
  const Picture picture = render(scene, all_light(24, Quality::draft));
  double sum = 0, squares = 0, estimated = 0;
  for (std::size_t i = 0; i < picture.pixels.size(); ++i) {
    const double off = static_cast<double>(picture.pixels[i].x) - 1;
    sum += off;
    squares += off * off;
    estimated += std::pow(static_cast<double>(picture.layers.at("bounce_error")[i].x), 2);
  }
  const auto pixels = static_cast<double>(picture.pixels.size());
  const double mean = sum / pixels, rms = std::sqrt(squares / pixels);
  std::printf("mean off by %.1e, rms %.4f, estimated rms %.4f\n", mean, rms, std::sqrt(estimated / pixels));
  // Half of the pixels show surfaces. Were their errors independent, the mean's would be a 17th of the rms.
  EXPECT_NEAR(mean, 0, 4 * rms / 17);
  EXPECT_LT(rms, std::sqrt(estimated / pixels));
}

}  // namespace steradian::radiosity_test
