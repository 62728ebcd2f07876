#include "steradian/environment.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "scene/turned_environment.h"
#include "steradian/error.h"
#include "support/gltf_test_file.h"

namespace steradian::scene::environment_test {

TEST(Environment, PlacesAndDirectionsAreInverse) {
  for (double u = 0.02; u < 1; u += 0.07)
    for (double v = 0.03; v < 1; v += 0.09) {
      const MapPlace p = place_of(direction_of({u, v}));
      EXPECT_NEAR(p.u, u, 1e-12);
      EXPECT_NEAR(p.v, v, 1e-12);
    }
  EXPECT_NEAR(length(direction_of({0.5, 0.5}) - Vec3d{0, 0, -1}), 0, 1e-12);
  EXPECT_NEAR(length(direction_of({0.75, 0.5}) - Vec3d{1, 0, 0}), 0, 1e-12);
}

TEST(Environment, LooksUpLinearlyAroundTheSeam) {
  Picture map(4, 2);
  for (int i = 0; i < 4; ++i) map.at(i, 0) = map.at(i, 1) = {static_cast<float>(i), 1, 0};
  EXPECT_NEAR(radiance_from(map, direction_of({0.375, 0.5})).x, 1, 1e-5);  // the centre of a texel
  EXPECT_NEAR(radiance_from(map, direction_of({0.5, 0.5})).x, 1.5, 1e-5);  // between two
  EXPECT_NEAR(radiance_from(map, direction_of({0.0, 0.5})).x, 1.5, 1e-5);  // between the last and the first
  EXPECT_NEAR(radiance_from(map, {0, 1, 0}).y, 1, 1e-6);
}

TEST(Environment, RepairsWhatIsNoRadiance) {
  Picture map(4, 2);
  for (Vec3f& p : map.pixels) p = {2, 1, 1};
  map.pixels[0] = {std::numeric_limits<float>::quiet_NaN(), -1, std::numeric_limits<float>::infinity()};
  const std::string path = test_path("map.exr");
  write_picture(map, path);
  const Environment environment = load_environment(path);
  EXPECT_EQ(environment.repaired, 3u);
  EXPECT_EQ(environment.map.pixels[0], (Vec3f{0, 0, 2}));
  for (Vec3f& p : map.pixels) p.x = p.y = p.z = std::numeric_limits<float>::quiet_NaN();
  write_picture(map, path);
  EXPECT_THROW(load_environment(path), Error);
  EXPECT_THROW(load_environment("no_such_map.hdr"), Error);
  EXPECT_THROW(load_environment("map.txt"), Error);
}

// The sky gives a sixth of the default sun's illuminance, and the ground below has albedo 0.2.
TEST(Environment, TheClearSkyLightsTheGroundAsStated) {
  const Picture& sky = clear_sky().map;
  double irradiance = 0;
  for (int j = 0; j < sky.height / 2; ++j)
    for (int i = 0; i < sky.width; ++i) {
      const double top = std::numbers::pi * j / sky.height, bottom = std::numbers::pi * (j + 1) / sky.height;
      const double projected = (std::cos(top) * std::cos(top) - std::cos(bottom) * std::cos(bottom)) / 2 * 2 * std::numbers::pi / sky.width;
      irradiance += (0.2126 * sky.at(i, j).x + 0.7152 * sky.at(i, j).y + 0.0722 * sky.at(i, j).z) * projected;
    }
  EXPECT_NEAR(irradiance, std::numbers::pi / 6, 1e-3);
  EXPECT_NEAR(sky.at(0, sky.height - 1).y, irradiance * 0.2 / std::numbers::pi, 1e-4);
  // The sky is bluer overhead than at the horizon, and brighter towards the sun.
  const Vec3f zenith = radiance_from(sky, {0, 1, 0}), sun = radiance_from(sky, normalized(Vec3d{-0.4, 0.8, 0.6}));
  EXPECT_GT(zenith.z, 2 * zenith.x);
  EXPECT_GT(sun.y, 2 * zenith.y);
}

// A turn by whole columns moves the texels. By -90 degrees, the middle (-z) comes to +x, as Blender and three.js show a map.
TEST(Environment, TurnsCounterClockwiseFromAbove) {
  for (const int columns : {0, 1, 3, 12, -5}) {
    Environment environment{"test", Picture(16, 8), {}, 0};
    for (std::size_t i = 0; i < environment.map.pixels.size(); ++i) environment.map.pixels[i] = {static_cast<float>(i), 1, 0};
    const Picture before = environment.map;
    turn(environment, columns * 22.5);
    for (int j = 0; j < 8; ++j)
      for (int i = 0; i < 16; ++i) EXPECT_EQ(environment.map.at(i, j), before.at((i + columns + 16) % 16, j)) << columns;
  }
  Environment environment{"test", Picture(16, 8), IrradianceCoefficients{}, 0};
  environment.map.at(8, 4) = {1, 1, 1};
  turn(environment, -90);
  EXPECT_EQ(environment.map.at(12, 4).x, 1);
  EXPECT_NEAR(length(environment.irradiance->z - Vec3d{-1, 0, 0}), 0, 1e-12);  // z goes to -x as -z goes to +x
}

// Coefficients of a constant and of a linear radiance. Their irradiances are pi and 2 pi / 3 times the radiance.
TEST(Environment, IrradianceByCoefficientsTurnsWithItsAxes) {
  IrradianceCoefficients c{};
  const double k0 = std::sqrt(1 / (4 * std::numbers::pi)), k1 = std::sqrt(3 / (4 * std::numbers::pi));
  c.rgb[0] = Vec3d{1, 1, 1} * (std::numbers::pi / k0);
  c.rgb[3] = Vec3d{1, 0, 0} * (2 * std::numbers::pi / 3 / k1);  // (1,1): along x
  EXPECT_NEAR(c.at({1, 0, 0}).x, std::numbers::pi * (1 + 2.0 / 3), 1e-12);
  EXPECT_NEAR(c.at({1, 0, 0}).y, std::numbers::pi, 1e-12);
  c.x = {0, 1, 0};
  c.y = {-1, 0, 0};
  EXPECT_NEAR(c.at({0, 1, 0}).x, std::numbers::pi * (1 + 2.0 / 3), 1e-12);
}

}  // namespace steradian::scene::environment_test
