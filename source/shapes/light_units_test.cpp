#include "steradian/light_units.h"

#include <numbers>

#include <gtest/gtest.h>

#include "steradian/area_light.h"
#include "steradian/ellipse_light.h"
#include "steradian/polygon_light.h"

namespace steradian::light_units_test {
namespace {

// Power that arrives on the walls of a ball about the light: 600 x 300 midpoints.
double power_by_quadrature(const auto& irradiance, double radius) {
  double sum = 0;
  for (int i = 0; i < 300; ++i)
    for (int k = 0; k < 600; ++k) {
      const double z = -1 + 2 * (i + 0.5) / 300, phi = 2 * std::numbers::pi * (k + 0.5) / 600, s = std::sqrt(1 - z * z);
      const Vec3d u{s * std::cos(phi), s * std::sin(phi), z};
      sum += irradiance(u * radius, -u);
    }
  return sum * 4 * std::numbers::pi * radius * radius / (300 * 600);
}

TEST(LightUnits, PowerIsWhatArrives) {
  PolygonLight panel;
  panel.vertices = {{-0.5, -0.25, 0}, {0.5, -0.25, 0}, {0.5, 0.25, 0}, {-0.5, 0.25, 0}};
  const PreparedPolygon prepared = prepare_polygon(panel);
  const double radiance = radiance_from_power(100, 0.5);
  EXPECT_NEAR(power_by_quadrature([&](Vec3d p, Vec3d n) { return radiance * polygon_irradiance(prepared, p, n); }, 2), 100, 0.02);
  EXPECT_DOUBLE_EQ(power_from_radiance(radiance, 0.5), 100);
  // A ball's surface, too, sends to one side: outwards.
  const Ellipsoid ball{{}, {0.1, 0, 0}, {0, 0.1, 0}, {0, 0, 0.1}};
  const double of_ball = radiance_from_power(100, 4 * std::numbers::pi * 0.01);
  EXPECT_NEAR(power_by_quadrature([&](Vec3d p, Vec3d n) { return of_ball * ellipsoid_irradiance(ball, p, n); }, 2), 100, 1e-9);
  EXPECT_DOUBLE_EQ(power_from_intensity(intensity_from_power(100)), 100);
}

TEST(LightUnits, ABlenderPointIsTheSameWithAndWithoutARadius) {
  const double area = 4 * std::numbers::pi * 0.01 * 0.01;
  // The intensity of the ball is its radiance times its visible disk.
  EXPECT_NEAR(light_factor(LightSystem::blender, EmitterKind::sphere, area) * std::numbers::pi * 0.01 * 0.01,
              light_factor(LightSystem::blender, EmitterKind::point), 1e-15);
}

TEST(LightUnits, EverySystemAndKind) {
  for (const LightSystem system : {LightSystem::gltf, LightSystem::three, LightSystem::mitsuba, LightSystem::pbrt})
    for (const EmitterKind kind : {EmitterKind::area, EmitterKind::point, EmitterKind::spot, EmitterKind::directional})
      EXPECT_EQ(light_factor(system, kind, 7), 1);
  EXPECT_EQ(light_factor(LightSystem::blender, EmitterKind::area, 0.25), 1);
  EXPECT_THROW(light_factor(LightSystem::blender, EmitterKind::area, 0), Error);
  EXPECT_THROW(light_factor(LightSystem::usd, EmitterKind::spot), Error);
  EXPECT_THROW(light_factor(LightSystem::three, EmitterKind::sphere), Error);
  EXPECT_EQ(light_system_of("pbrt"), LightSystem::pbrt);
  EXPECT_EQ(emitter_kind_of("directional"), EmitterKind::directional);
  EXPECT_FALSE(light_system_of("povray"));
}

TEST(LightUnits, SunnySixteen) {
  // f/16 at 1/100 s and ISO 100 is the exposure for sunlight: EV 14.6.
  EXPECT_NEAR(ev100_of_camera(16, 0.01, 100), 14.644, 1e-3);
  EXPECT_NEAR(std::exp2(stops_from_ev100(15)) * 1.2 * 32768, 1, 1e-12);
}

}  // namespace
}  // namespace steradian::light_units_test
