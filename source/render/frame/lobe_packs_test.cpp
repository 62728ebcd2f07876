// Methods and lobes other than the renderer's usual ones: packs against one point at a time, for every instruction set.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "integrals/methods.h"
#include "integrals/point_light.h"
#include "render/direct/lobe_packs.h"
#include "steradian/ellipse_light.h"
#include "support/random_configurations.h"

namespace steradian::lobe_packs_test {
namespace {

using reference::Random;

constexpr std::size_t kPoints = 512;

struct Cloud {
  std::vector<float> values = std::vector<float>(13 * kPoints);
  float* of(std::size_t plane) { return values.data() + plane * kPoints; }
  Vec3d at(std::size_t plane, std::size_t i) {
    return {static_cast<double>(of(plane)[i]), static_cast<double>(of(plane + 1)[i]), static_cast<double>(of(plane + 2)[i])};
  }
  void put(std::size_t plane, std::size_t i, Vec3d v) {
    of(plane)[i] = static_cast<float>(v.x);
    of(plane + 1)[i] = static_cast<float>(v.y);
    of(plane + 2)[i] = static_cast<float>(v.z);
  }
  Points points() {
    const auto arrays = [&](std::size_t plane) { return VectorArrays{of(plane), of(plane + 1), of(plane + 2)}; };
    return {kPoints, arrays(0), arrays(3), arrays(6), arrays(9), of(12), of(12)};
  }
  ShadingPoint point(std::size_t i) { return {at(0, i), normalized(at(3, i)), normalized(at(6, i))}; }
};

// Points about a light with arbitrary normals and views, so that the horizon often cuts the light.
Cloud any_cloud(Random& random) {
  const auto direction = [&] { return Vec3d{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)}; };
  Cloud cloud;
  for (std::size_t i = 0; i < kPoints; ++i) {
    const Vec3d normal = normalized(direction() + Vec3d{0, 0, 1.2});
    cloud.put(0, i, Vec3d{random.uniform(-2, 2), random.uniform(-2, 2), 0});
    cloud.put(3, i, normal);
    cloud.put(6, i, normalized(direction() + normal * 1.1));
    cloud.put(9, i, direction());
    cloud.of(12)[i] = static_cast<float>(std::exp(random.uniform(-3, 0)));
  }
  return cloud;
}

struct Case {
  std::string name;
  Material lobe;  // for ggx, the width is the point's
  Method method;
  LtcPackTables tables = {};

  void run(const PackLight& light, const Points& points, Simd simd, std::vector<float>& plain, std::vector<float>& fresnel) const {
    lobe_packs_for(simd)[methods::procedure_of(method, lobe.brdf)](light, points, {lobe, {method}, &tables},
                                                                   {plain.data(), fresnel.data()});
  }
};

std::vector<Case> cases() {
  std::vector<Case> all;
  Material ggx;
  ggx.brdf = Brdf::ggx;
  all.push_back({"half-vector ggx", ggx, Method::half_vector});
  all.push_back({"clipless", ggx, Method::ltc_clipless, ltc_pack_tables(Method::ltc_clipless)});
  all.push_back({"representative point", ggx, Method::representative_point});
  Material m;
  m.brdf = Brdf::beckmann;
  m.alpha_x = 0.4;
  m.alpha_y = 0.15;
  m.tangent = {1, 0.3, 0.1};
  all.push_back({"beckmann", m, Method::half_vector});
  m.alpha_x = m.alpha_y = 0.3;
  m.tangent = {};
  all.push_back({"round beckmann", m, Method::half_vector});
  m = {};
  m.brdf = Brdf::blinn_phong;
  m.exponent = 40;
  all.push_back({"blinn-phong", m, Method::half_vector});
  m = {};
  m.brdf = Brdf::phong;
  m.exponent = 25;
  all.push_back({"phong", m, Method::series});
  return all;
}

PackLight round_light(const AreaLight& light) {
  Scene scene;
  scene.area_lights = {light};
  return prepare_lights(scene).front();
}

}  // namespace

// A polygon is the same to both. They differ in the order of float operations, mostly where edges cancel.
TEST(LobePacks, FollowOnePointAtATimeUnderPolygons) {
  Random random(31);
  Cloud cloud = any_cloud(random);
  PolygonLight quad;
  quad.vertices = {{-1, -0.8, 1.22}, {-0.7, 0.9, 1.45}, {1.1, 0.8, 1.8}, {0.9, -1, 1.58}};
  const PreparedPolygon prepared = prepare_polygon(quad);
  const PackLight light = prepare_light(prepared);
  std::vector<float> plain(kPoints), fresnel(kPoints);
  for (const Case& c : cases())
    for (const Simd simd : available_simd()) {
      c.run(light, cloud.points(), simd, plain, fresnel);
      int lit = 0;
      double largest = 0, worst = 0;
      for (std::size_t i = 0; i < kPoints; ++i) {
        Material m = c.lobe;
        if (m.brdf == Brdf::ggx) {
          m.alpha_x = m.alpha_y = static_cast<double>(cloud.of(12)[i]);
          m.f0 = {0.5, 0.5, 0.5};
          m.f90 = {1, 1, 1};
        }
        if (m.tangent == Vec3d{}) m.tangent = cloud.at(9, i);
        const double truth =
            methods::row_of(c.method).polygon(prepared, cloud.point(i), m, {c.method, Quality::normal, Precision::float_}).radiance.x;
        const double p = static_cast<double>(plain[i]), f = static_cast<double>(fresnel[i]);
        const double found = m.brdf == Brdf::ggx ? 0.5 * (p - f) + f : p;
        largest = std::max(largest, truth);
        worst = std::max(worst, std::fabs(found - truth) / (truth + 0.01));
        lit += truth > 1e-3;
      }
      EXPECT_GT(lit, 100) << c.name;
      EXPECT_LT(worst, 2e-3) << c.name << " " << name_of(simd);
      EXPECT_GT(largest, 0.1) << c.name;
    }
}

// Disks and balls: both replace the outline by a polygon, each within 0.14 % of the lobe, but with different corners.
TEST(LobePacks, FollowOnePointAtATimeUnderRoundLights) {
  Random random(32);
  Cloud cloud = any_cloud(random);
  const AreaLight disk{Ellipse{{0, 0, 1.5}, {0, 0.8, 0}, {0.8, 0, 0}}, {1, 1, 1}};
  const PackLight light = round_light(disk);
  std::vector<float> plain(kPoints), fresnel(kPoints);
  for (const Case& c : cases()) {
    if (c.lobe.brdf == Brdf::ggx) continue;
    for (const Simd simd : available_simd()) {
      c.run(light, cloud.points(), simd, plain, fresnel);
      double peak = 0;
      std::vector<double> truth(kPoints);
      for (std::size_t i = 0; i < kPoints; ++i) {
        Material m = c.lobe;
        if (m.tangent == Vec3d{}) m.tangent = cloud.at(9, i);
        const PreparedPolygon seen =
            prepare_polygon(polygon_for_lobe(std::get<Ellipse>(disk.shape), cloud.at(0, i), lobe_axis(m, cloud.point(i)), 64));
        truth[i] = methods::row_of(c.method).polygon(seen, cloud.point(i), m, {c.method, Quality::normal, Precision::float_}).radiance.x;
        peak = std::max(peak, truth[i]);
      }
      for (std::size_t i = 0; i < kPoints; ++i)
        EXPECT_NEAR(static_cast<double>(plain[i]), truth[i], 0.0014 * peak + 2e-3 * truth[i]) << c.name << " " << name_of(simd) << " " << i;
    }
  }
}

// A point's light does not depend on its neighbours in the pack. Next to a point near the rim, others used to get its finer polygon. They
// were up to 6 % brighter or darker than next to another point.
TEST(LobePacks, NeighboursNextToTheRimChangeNothing) {
  Random random(33);
  Cloud cloud = any_cloud(random);
  const AreaLight disk{Ellipse{{0, 0, 0.3}, {0, 0.8, 0}, {0.8, 0, 0}}, {1, 1, 1}};
  for (std::size_t i = 0; i < kPoints; i += 3) {
    const double angle = random.uniform(0, 6.28);
    cloud.put(0, i, Vec3d{0.82 * std::cos(angle), 0.82 * std::sin(angle), 0.28});
  }
  Cloud alone = cloud;  // points next to the rim are moved elsewhere
  for (std::size_t i = 0; i < kPoints; i += 3) alone.put(0, i, Vec3d{0, 0, -3});
  const PackLight light = round_light(disk);
  std::vector<Case> all = cases();
  Material ggx;
  ggx.brdf = Brdf::ggx;
  all.push_back({"closed form", ggx, Method::closed_form});
  std::vector<float> with(kPoints), without(kPoints), fresnel(kPoints);
  for (const Case& c : all)
    for (const Simd simd : available_simd()) {
      c.run(light, cloud.points(), simd, with, fresnel);
      c.run(light, alone.points(), simd, without, fresnel);
      for (std::size_t i = 0; i < kPoints; ++i) {
        if (i % 3 == 0) continue;
        EXPECT_NEAR(with[i], without[i], 1e-5f * (1 + with[i])) << c.name << " " << name_of(simd) << " " << i;
      }
    }
}

// A light without extent is the lobe of the tables in one direction.
TEST(LobePacks, FollowOnePointAtATimeUnderPunctualLights) {
  Random random(33);
  Cloud cloud = any_cloud(random);
  PunctualLight lamp;
  lamp.position = {0.3, -0.2, 1.5};
  PackLight light;
  light.shape = packed::prepare(lamp);
  std::vector<float> plain(kPoints), fresnel(kPoints);
  for (const auto& [method, quality] :
       {std::pair{Method::ltc, Quality::normal}, {Method::ltc, Quality::high}, {Method::ltc_compact, Quality::normal}})
    for (const Simd simd : available_simd()) {
      const LtcPackTables tables = ltc_pack_tables(method, quality);
      lobe_packs_for(simd).punctual_ltc(light, cloud.points(), {{}, {method, quality}, &tables}, {plain.data(), fresnel.data()});
      int lit = 0;
      double worst = 0;
      for (std::size_t i = 0; i < kPoints; ++i) {
        Material m;
        m.brdf = Brdf::ggx;
        m.alpha_x = m.alpha_y = static_cast<double>(cloud.of(12)[i]);
        m.f0 = {0.5, 0.5, 0.5};
        m.f90 = {1, 1, 1};
        const PointLight point = {lamp.position, {1, 1, 1}};
        const double truth = methods::point_light_radiance(point, cloud.point(i), m, methods::row_of(method), {method, quality}).x;
        const double p = static_cast<double>(plain[i]), f = static_cast<double>(fresnel[i]);
        worst = std::max(worst, std::fabs(0.5 * (p - f) + f - truth) / (truth + 0.01));
        lit += truth > 1e-3;
      }
      EXPECT_GT(lit, 100);
      // Single precision, and lobes up to 20 times as narrow as a cosine.
      EXPECT_LT(worst, 1e-4) << name_of(method) << " " << name_of(simd);
    }
}

// Small and large lights flush with the surface, on level planes and on any: rounding of places decides no side, so nothing arrives.
TEST(LobePacks, NothingArrivesFromLightsInThePlaneOfTheSurface) {
  Random random(35);
  for (int i = 0; i < 60; ++i) {
    const Frame plane = i % 2 == 0
                            ? Frame{{1, 0, 0}, {0, 0, -1}, {0, 1, 0}}
                            : Frame::from_normal(normalized(Vec3d{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)}));
    const double scale = std::pow(10, random.uniform(-2, 2));
    const Vec3d middle = Vec3d{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)} * scale;
    const auto in_plane = [&](double x, double y) { return middle + (plane.x * x + plane.y * y) * scale; };
    const double angle = random.uniform(0, 6.3), size = std::pow(10, random.uniform(-4, -0.5)) * scale;
    // A node's rotation in single precision tilts a light by about 1e-9.
    const Vec3d tilt = plane.z * (i % 3 == 0 ? 1e-9 : 0), x = plane.x * std::cos(angle) + plane.y * std::sin(angle) + tilt;
    const Vec3d a = x * size, b = cross(plane.z, x) * (size * random.uniform(0.1, 1)),
                center = in_plane(random.uniform(-1, 1), random.uniform(-1, 1));
    AreaLight flat;
    flat.two_sided = i % 4 < 2;
    if (i % 5 == 0)
      flat.shape = Ellipse{center, a, b};
    else
      flat.shape = Polygon{{center - a - b, center + a - b, center + a + b, center - a + b}, {}};
    const PackLight light = round_light(flat);
    Cloud cloud;
    for (std::size_t k = 0; k < kPoints; ++k) {
      cloud.put(0, k, in_plane(random.uniform(-2, 2), random.uniform(-2, 2)));
      cloud.put(3, k, plane.z);
      cloud.put(6, k, normalized(plane.z + (plane.x * random.uniform(-1, 1) + plane.y * random.uniform(-1, 1)) * 3));
      cloud.put(9, k, plane.x);
      cloud.of(12)[k] = static_cast<float>(std::exp(random.uniform(-4, 0)));
    }
    std::vector<Case> all = cases();
    Material ggx;
    ggx.brdf = Brdf::ggx;
    all.push_back({"closed-form", ggx, Method::closed_form});
    all.push_back({"ltc", ggx, Method::ltc, ltc_pack_tables(Method::ltc)});
    all.push_back({"diffuse", {}, Method::exact});
    std::vector<float> plain(kPoints), fresnel(kPoints);
    for (const Case& c : all) {
      c.run(light, cloud.points(), available_simd()[static_cast<std::size_t>(i) % available_simd().size()], plain, fresnel);
      EXPECT_EQ(*std::max_element(plain.begin(), plain.end()), 0) << c.name << " " << i;
      if (c.lobe.brdf == Brdf::ggx) {
        EXPECT_EQ(*std::max_element(fresnel.begin(), fresnel.end()), 0) << c.name << " " << i;
      }
    }
  }
}

}  // namespace steradian::lobe_packs_test
