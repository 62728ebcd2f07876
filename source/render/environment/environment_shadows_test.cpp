// Shadows of an environment: open and closed scenes exactly, and generated scenes against the reference and the stated error.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/random.h"
#include "night.h"
#include "steradian/area_light.h"
#include "steradian/render.h"
#include "support/meshes.h"
#include "support/random_configurations.h"

namespace steradian::environment_shadows_test {
namespace {

using namespace scene;

std::shared_ptr<const Environment> shared(Environment environment) { return std::make_shared<const Environment>(std::move(environment)); }

// A map without bright spots: a few soft waves of colour.
Environment random_map(reference::Random& random) {
  Environment environment;
  environment.name = "waves";
  environment.map = Picture(128, 64);
  const Vec3d a = random_direction(random), b = random_direction(random), c = random_direction(random);
  for (int j = 0; j < environment.map.height; ++j)
    for (int i = 0; i < environment.map.width; ++i) {
      const Vec3d d = direction_of({(i + 0.5) / environment.map.width, (j + 0.5) / environment.map.height});
      environment.map.at(i, j) = static_cast<Vec3f>(Vec3d{1 + dot(a, d), 1 + 0.8 * dot(b, d), 1.2 + std::sin(3 * dot(c, d))});
    }
  return environment;
}

// A box from the floor upwards, turned about its axis.
void add_box(Scene& scene, Vec3d center, Vec3d half, double turn, int material) {
  const auto corner = [&](double x, double y, double z) {
    return static_cast<Vec3f>(center + Vec3d{std::cos(turn) * x * half.x + std::sin(turn) * z * half.z, y * half.y,
                                             -std::sin(turn) * x * half.x + std::cos(turn) * z * half.z});
  };
  scene.meshes.push_back(quad_mesh(corner(-1, -1, 1), corner(1, -1, 1), corner(1, 1, 1), corner(-1, 1, 1), material));
  scene.meshes.push_back(quad_mesh(corner(1, -1, -1), corner(-1, -1, -1), corner(-1, 1, -1), corner(1, 1, -1), material));
  scene.meshes.push_back(quad_mesh(corner(1, -1, 1), corner(1, -1, -1), corner(1, 1, -1), corner(1, 1, 1), material));
  scene.meshes.push_back(quad_mesh(corner(-1, -1, -1), corner(-1, -1, 1), corner(-1, 1, 1), corner(-1, 1, -1), material));
  scene.meshes.push_back(quad_mesh(corner(-1, 1, 1), corner(1, 1, 1), corner(1, 1, -1), corner(-1, 1, -1), material));
  scene.meshes.push_back(quad_mesh(corner(-1, -1, -1), corner(1, -1, -1), corner(1, -1, 1), corner(-1, -1, 1), material));
}

SurfaceMaterial diffuse() {
  SurfaceMaterial m;
  m.metallic = 0;
  m.specular = 0;
  return m;
}

// Boxes and a ball on a floor, of diffuse, metal and dielectric materials.
Scene random_scene(reference::Random& random) {
  Scene scene = floor_scene(diffuse(), 3, {0.3, 1.8, 3});
  for (int k = 0; k < 3; ++k) {
    SurfaceMaterial m;
    m.base_color = {static_cast<float>(random.uniform(0.3, 0.9)), 0.7f, 0.6f, 1};
    m.metallic = random.uniform() < 0.5 ? 1 : 0;
    m.roughness = static_cast<float>(random.uniform(0.25, 1));
    scene.materials.push_back(m);
  }
  for (int k = 1; k <= 2; ++k) {
    const double height = random.uniform(0.1, 0.7);
    add_box(scene, {random.uniform(-1, 1), height, random.uniform(-1, 0.7)}, {random.uniform(0.1, 0.6), height, random.uniform(0.1, 0.6)},
            random.uniform(0, 3), k);
  }
  const auto radius = static_cast<float>(random.uniform(0.2, 0.5));
  scene.meshes.push_back(
      ball_mesh({static_cast<float>(random.uniform(-1, 1)), radius, static_cast<float>(random.uniform(-0.6, 1))}, radius, 3, 48, 24));
  scene.bounds_min = {-3, 0, -3};
  scene.bounds_max = {3, 1.4, 3};
  return scene;
}

Picture picture_of(const Scene& scene, const std::string& method, Shadows shadows, RenderStats* stats = nullptr) {
  RenderOptions options;
  options.width = 40;
  options.height = 24;
  options.background = false;
  options.shadows = shadows;
  options.method = method;
  options.terminator = Terminator::smooth;
  options.target_error = 0.006;
  return render(scene, options, stats);
}

double mean_luminance(const Picture& picture) {
  double sum = 0;
  for (const Vec3f& p : picture.pixels) sum += luminance(static_cast<Vec3d>(p));
  return sum / static_cast<double>(picture.pixels.size());
}

// Root of the mean square difference of two pictures over the mean of the second, without the noise that its variance tells.
double error_of(const Picture& picture, const Picture& reference) {
  double square = 0, noise = 0;
  const std::vector<Vec3f>& variance = reference.layers.at("variance");
  for (std::size_t i = 0; i < picture.pixels.size(); ++i) {
    const double d = luminance(static_cast<Vec3d>(picture.pixels[i]) - static_cast<Vec3d>(reference.pixels[i]));
    const Vec3d weights = {luminance({1, 0, 0}), luminance({0, 1, 0}), luminance({0, 0, 1})};
    square += d * d;
    noise += dot(static_cast<Vec3d>(variance[i]), weights * weights);
  }
  return std::sqrt(std::max(square - noise, 0.0) / static_cast<double>(picture.pixels.size())) / mean_luminance(reference);
}

}  // namespace

// Nothing is in the way of a convex body: its light is that without shadows, bit for bit.
TEST(EnvironmentShadows, AConvexBodyKeepsItsLight) {
  Scene scene;
  scene.materials = {diffuse()};
  scene.meshes = {ball_mesh({0, 0, 0}, 1, 0, 48, 24)};
  scene.bounds_min = {-1, -1, -1};
  scene.bounds_max = {1, 1, 1};
  scene.cameras = {camera_at({0, 0.4, 4}, {0, -0.1, -1}, 0.55)};
  reference::Random random(1);
  scene.environment = shared(random_map(random));
  RenderStats stats;
  const Picture with = picture_of(scene, "auto", Shadows::on, &stats), without = picture_of(scene, "auto", Shadows::off);
  EXPECT_GT(mean_luminance(with), 0.1);
  EXPECT_EQ(with.pixels, without.pixels);
  EXPECT_EQ(stats.environment_shadow_error, 0);
}

TEST(EnvironmentShadows, NoLightEntersAClosedBox) {
  for (const bool metal : {false, true}) {
    Scene scene;
    SurfaceMaterial m = diffuse();
    m.metallic = metal ? 1 : 0;
    scene.materials = {m};
    add_box(scene, {0, 0, 0}, {1, 1, 1}, 0.3, 0);
    scene.bounds_min = {-2, -2, -2};
    scene.bounds_max = {2, 2, 2};
    scene.cameras = {camera_at({0.1, 0.2, 0.5}, {0, -0.1, -1}, 1)};
    scene.environment = shared(white_environment());
    EXPECT_EQ(mean_luminance(picture_of(scene, "auto", Shadows::on)), 0) << metal;
    EXPECT_GT(mean_luminance(picture_of(scene, "auto", Shadows::off)), 0.1) << metal;
  }
}

// The family: any boxes, balls, materials and maps. The error over all pixels is within twice what is stated (the halves of a lattice are
// not independent), and the error of the cones.
TEST(EnvironmentShadows, AnySceneAgreesWithTheReferenceWithinTheStatedError) {
  reference::Random random(41);
  double worst = 0;
  const int scenes = test::by_day_or_night(4, 60);
  for (int k = 0; k < scenes; ++k) {
    Scene scene = random_scene(random);
    scene.environment = k % 3 == 0 ? shared(clear_sky()) : k % 3 == 1 ? shared(white_environment()) : shared(random_map(random));
    RenderStats stats;
    const Picture picture = picture_of(scene, "auto", Shadows::on, &stats), estimate = picture_of(scene, "reference", Shadows::on);
    const double error = error_of(picture, estimate), stated = 2 * stats.environment_shadow_error + stats.specular_residual;
    const double without = error_of(picture_of(scene, "auto", Shadows::off), estimate);
    std::printf("scene %d: error %.2f %%, stated %.2f %% of shadows and %.2f %% of cones; without shadows %.1f %%\n", k, 100 * error,
                100 * stats.environment_shadow_error, 100 * stats.specular_residual, 100 * without);
    worst = std::max(worst, error / stated);
    EXPECT_LT(error, stated) << k;
    EXPECT_GT(without, 2 * error) << k;
  }
  std::printf("%d scenes: worst %.2f of the stated error\n", scenes, worst);
}

}  // namespace steradian::environment_shadows_test
