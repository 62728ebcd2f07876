// The light of point and spot lights against the formulas of KHR_lights_punctual.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/random.h"
#include "steradian/kernels.h"
#include "steradian/vector.h"

namespace steradian::punctual_test {
namespace {

TEST(Punctual, FallsOffByDistanceRangeAndCone) {
  using K = Kernels<double>;
  K k;
  reference::Random random(1);
  int lit = 0, dark = 0;
  for (int i = 0; i < 2000; ++i) {
    const Vec3d p{random.uniform(-2, 2), random.uniform(-2, 2), random.uniform(-2, 2)};
    const Vec3d at{random.uniform(-2, 2), random.uniform(-2, 2), random.uniform(-2, 2)};
    const Vec3d axis = normalized(Vec3d{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(0.1, 1)});
    const double inner = random.uniform(0.3, 0.6), outer = inner + random.uniform(0.1, 0.9);
    const bool spot = i % 3 != 0, limited = i % 2 == 0;
    const double range = random.uniform(1, 4), scale = 1 / (std::cos(inner) - std::cos(outer));
    K::PunctualSource light;
    light.position = {at.x, at.y, at.z};
    light.direction = {axis.x, axis.y, axis.z};
    light.inverse_range2 = limited ? 1 / (range * range) : 0;
    light.spot_scale = spot ? scale : 0;
    light.spot_offset = spot ? -std::cos(outer) * scale : 1;
    const auto found = k.punctual_incident(light, {p.x, p.y, p.z});
    const Vec3d to = at - p;
    const double distance = length(to), angle = std::acos(std::clamp(-dot(axis, to) / distance, -1.0, 1.0));
    double expected = 1 / (distance * distance);
    if (limited) expected *= std::clamp(1 - std::pow(distance / range, 4), 0.0, 1.0);
    if (spot) expected *= std::pow(std::clamp((std::cos(angle) - std::cos(outer)) * scale, 0.0, 1.0), 2);
    EXPECT_NEAR(found.irradiance.v, expected, 1e-12 / (distance * distance));
    EXPECT_NEAR(length(Vec3d{found.direction.x.v, found.direction.y.v, found.direction.z.v} - to / distance), 0, 1e-14);
    (expected > 0 ? lit : dark) += 1;
  }
  EXPECT_GT(lit, 200);
  EXPECT_GT(dark, 200);
}

}  // namespace
}  // namespace steradian::punctual_test
