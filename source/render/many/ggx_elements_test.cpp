// Elements of lights in GGX lobes, against quadrature over the lights: the error must be within its bound.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <random>

#include "render/many/lobe_elements.h"
#include "steradian/radiance.h"

namespace steradian::ggx_elements_test {
namespace {

constexpr std::size_t kPoints = 16;  // one block

struct Block {
  std::array<ShadingPoint, kPoints> at;
  TileVector position{}, normal{}, view{};
  TilePlane alpha{};
  Points points() const {
    return {kPoints, arrays_of(position), arrays_of(normal), arrays_of(view), {}, alpha.data(), alpha.data(), nullptr};
  }
};

using Random = std::mt19937;
double uniform(Random& random, double low, double high) { return low + (high - low) * (static_cast<double>(random()) / 4294967296.0); }

Vec3d direction(Random& random) {
  const double z = uniform(random, -1, 1), a = uniform(random, 0, 2 * std::numbers::pi), s = std::sqrt(1 - z * z);
  return {s * std::cos(a), s * std::sin(a), z};
}

// Rounds to single precision, so that quadrature sees the same point.
Vec3d rounded(Vec3d v) { return static_cast<Vec3d>(static_cast<Vec3f>(v)); }

// Points on a curved patch about the origin, seen from one place.
Block random_block(Random& random, float alpha) {
  Block b;
  const Vec3d eye = Vec3d{0, 0, 0.2} + direction(random) * uniform(random, 1, 4);
  for (std::size_t i = 0; i < kPoints; ++i) {
    const Vec3d position = rounded({uniform(random, -0.2, 0.2), uniform(random, -0.2, 0.2), 0});
    const Vec3d normal = rounded(normalized(Vec3d{position.x, position.y, 1}));
    b.at[i] = {position, normal, rounded(normalized(Vec3d{eye.x, eye.y, std::fabs(eye.z)} - position))};
    const auto put = [i](TileVector& to, Vec3d v) {
      to.x[i] = static_cast<float>(v.x);
      to.y[i] = static_cast<float>(v.y);
      to.z[i] = static_cast<float>(v.z);
    };
    put(b.position, b.at[i].position);
    put(b.normal, b.at[i].normal);
    put(b.view, b.at[i].view);
    b.alpha[i] = alpha;
  }
  return b;
}

// A polygon that faces the patch; its size is a tenth to a hundredth of its distance.
PolygonLight random_light(Random& random) {
  const double distance = uniform(random, 1, 8), size = distance * std::pow(10, uniform(random, -2, -1));
  Vec3d to = direction(random);
  to.z = std::fabs(to.z);
  const Frame frame = Frame::from_normal(normalized(direction(random) * 0.7 - to));
  const Vec3d center = to * distance, x = frame.x * size, y = frame.y * (size * uniform(random, 0.3, 1));
  PolygonLight light;
  light.vertices = {rounded(center - x - y), rounded(center + x - y), rounded(center + x + y)};
  if (random() % 2 == 0) light.vertices.push_back(rounded(center - x + y));
  return light;
}

TEST(GgxElements, AreWithinTheirBoundOfQuadrature) {
  Random random(11);
  double worst = 0;  // ratio of error to bound
  int served = 0, bounds_that_tell = 0;
  for (int round = 0; round < 400; ++round) {
    const auto alpha = static_cast<float>(std::exp(uniform(random, std::log(0.05), 0)));
    const Block block = random_block(random, alpha);
    const AreaLight area = area_light(random_light(random));
    std::vector<PackLight> lights = {prepare_light(prepare_polygon(flat_polygon(area)))};
    lights[0].area = &area;
    lights[0].radiance = {1, 1, 1};
    const lights::FarLights far = lights::prepare_far_lights(lights);
    lights::LobeSums sums{};
    const std::uint32_t number = 0;
    std::uint64_t left = 0;
    ggx_elements_for(active_simd()).add(far, &number, 1, block.points(), {}, 0.5f, sums, &left);
    if (left != 0) continue;

    for (std::size_t i = 0; i < kPoints; i += 5) {
      const auto judge = [&](const char* part, float value, float error, Vec3d f0) {
        Material lobe;
        lobe.brdf = Brdf::ggx;
        lobe.alpha_x = lobe.alpha_y = static_cast<double>(alpha);
        lobe.f0 = f0;
        RadianceOptions options;
        options.method = Method::reference;
        const RadianceResult truth = radiance(area, block.at[i], lobe, options);
        // About thirty roundings of 6e-8, and those of a half vector that the lobe divides by alpha, to the fourth power.
        const double rounding = (2e-6 + 1e-6 / static_cast<double>(alpha)) * truth.radiance.x;
        const double off = std::fabs(static_cast<double>(value) - truth.radiance.x) - truth.bound.value() - rounding;
        EXPECT_LE(off, static_cast<double>(error)) << part << " round " << round << " point " << i << " alpha " << alpha << " value "
                                                   << value << " reference " << truth.radiance.x;
        if (error > 0) worst = std::max(worst, off / static_cast<double>(error));
        ++served;
        if (static_cast<double>(error) < 0.05 * truth.radiance.x) ++bounds_that_tell;
      };
      judge("plain", sums.specular.x[i], sums.specular_error.x[i], {1, 1, 1});
      judge("fresnel", sums.grazing.x[i], sums.grazing_error.x[i], {0, 0, 0});
    }
  }
  std::printf("%d values, largest error / bound %.2f; bound below 5 %% of the value at %d\n", served, worst, bounds_that_tell);
  EXPECT_GT(served, 500);
  EXPECT_GT(bounds_that_tell, served / 4) << "a bound that says nothing would pass";
  EXPECT_GT(worst, 0.05);
}

}  // namespace
}  // namespace steradian::ggx_elements_test
