// Rays through solids of glass, against Snell's law, and a white furnace.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>

#include "core/random.h"
#include "night.h"
#include "render/surface/passed_rays.h"
#include "render/surface/surface_pack.h"
#include "steradian/environment.h"
#include "steradian/render.h"
#include "support/meshes.h"

namespace steradian::passed_rays_test {
namespace {

using namespace scene;

SurfaceMaterial glass(float ior) {
  SurfaceMaterial m;
  m.base_color = {1, 1, 1, 1};
  m.metallic = 0;
  m.roughness = 0;
  m.ior = ior;
  m.transmission = 1;
  m.solid = true;
  return m;
}

// The faces of a prism over a polygon in x and y that runs counter-clockwise, from z = -5 to 5, seen from outside.
void add_prism(Scene& scene, const std::vector<Vec3f>& base, int material) {
  const auto at = [](Vec3f p, float z) { return Vec3f{p.x, p.y, z}; };
  for (std::size_t i = 0, j = base.size() - 1; i < base.size(); j = i++)
    scene.meshes.push_back(quad_mesh(at(base[j], 5), at(base[j], -5), at(base[i], -5), at(base[i], 5), material));
  for (std::size_t i = 1; i + 1 < base.size(); ++i)
    for (const float z : {-5.0f, 5.0f}) {
      const Vec3f a = at(base[0], z), b = at(base[i], z), c = at(base[i + 1], z);
      z > 0 ? scene.meshes.push_back(quad_mesh(a, b, c, c, material)) : scene.meshes.push_back(quad_mesh(a, c, b, b, material));
    }
}

// Rays begin again off each face, by (M + 2 |p|) 2^-19 for coordinates up to M: at most this in the scenes of the slabs.
constexpr float kOffset = 27 * 0x1p-19f;

struct Passed {
  Vec3f origin, direction, share;
  std::vector<PassedRays::Ways::Aside> asides;
};

// The ray beyond all solids.
Passed pass(const Scene& scene, Vec3f origin, Vec3f direction, PassedRays::Rough rough = PassedRays::Rough::sharp) {
  const RayScene rays(scene);
  const MipMaps maps(scene.images);
  const HitShading shading{surface_packs_for(active_simd()), Terminator::strict, &maps, {{1e-3f, 0, 0}, {0, 1e-3f, 0}, {0, 0, -1}}};
  const PassedRays passed(scene, rays, shading, {}, rough);
  const auto ways = std::make_unique<PassedRays::Ways>();
  const auto tile = std::make_unique<SurfaceTile>();
  for (std::size_t i = 0; i < kTilePixels; ++i) put_nothing(*tile, i);
  clear_kinds(*tile);
  direction = normalized(direction);
  RTCRayHit hit;
  EXPECT_TRUE(rays.intersect(origin, direction, hit));
  put_surface(*tile, 0, surface_at(scene, scene.meshes[hit.hit.geomID], hit.hit.primID, hit.hit.u, hit.hit.v, -direction), -direction);
  TilePlane distances{};
  distances[0] = hit.ray.tfar;
  PassedRays::begin(distances, *ways);
  passed.look_through(*tile, *ways);
  const Passed result{get(ways->origin, 0), get(ways->direction, 0), get(ways->shares, 0), ways->asides};
  EXPECT_TRUE(ways->bent[0] != 0 || result.share == Vec3f{});
  return result;
}

void expect_near(Vec3f a, Vec3f b, float tolerance) {
  EXPECT_LT(length(a - b), tolerance) << a.x << " " << a.y << " " << a.z << " for " << b.x << " " << b.y << " " << b.z;
}

}  // namespace

TEST(Glass, ASlabShiftsARay) {
  Scene scene;
  scene.materials = {glass(1.5f)};
  add_prism(scene, {{-4, 0, 0}, {4, 0, 0}, {4, 1, 0}, {-4, 1, 0}}, 0);
  for (const float angle : {0.0f, 0.3f, 0.8f, 1.2f}) {
    const Vec3f direction{std::sin(angle), -std::cos(angle), 0};
    const Vec3f from = Vec3f{0, 1, 0} - direction * 2;
    const Passed ray = pass(scene, from, direction);
    expect_near(ray.direction, direction, 1e-6f);
    const float inner = std::asin(std::sin(angle) / 1.5f);
    const float t = -ray.origin.y / ray.direction.y;  // to the lower face
    EXPECT_NEAR(ray.origin.x + t * ray.direction.x, std::tan(inner), 2 * kOffset * std::tan(angle) + 1e-6f) << angle;
    // One face reflects; what the other reflects counts as leaving.
    const float reflected = 0.04f + 0.96f * std::pow(1 - std::cos(angle), 5.0f);
    EXPECT_NEAR(ray.share.x, 1 - reflected, 2e-3f) << angle;
  }
}

// Fresnel's fractions for each direction of polarisation, by the angles before and behind.
double fresnel(double before, double behind) {
  const double across = std::sin(before - behind) / std::sin(before + behind),
               along = std::tan(before - behind) / std::tan(before + behind);
  return (across * across + along * along) / 2;
}

TEST(Glass, ASlabSendsBackWhatItsFacesReflectWithin) {
  Scene scene;
  scene.materials = {glass(1.5f)};
  add_prism(scene, {{-9, 0, 0}, {9, 0, 0}, {9, 1, 0}, {-9, 1, 0}}, 0);
  for (const float angle : {0.3f, 0.8f, 1.2f}) {
    const Vec3f direction{std::sin(angle), -std::cos(angle), 0};
    const Passed ray = pass(scene, Vec3f{0, 1, 0} - direction * 2, direction, PassedRays::Rough::blurred);
    const double a = static_cast<double>(angle), inner = std::asin(std::sin(a) / 1.5), r = fresnel(a, inner);
    const double enters = 1 - (0.04 + 0.96 * std::pow(1 - std::cos(a), 5));
    EXPECT_NEAR(static_cast<double>(ray.share.x), enters * (1 - r), 1e-5) << angle;
    ASSERT_FALSE(ray.asides.empty());
    const PassedRays::Ray& back = ray.asides[0].ray;
    expect_near(back.direction, {direction.x, -direction.y, 0}, 1e-5f);
    const float t = (1 - back.origin.y) / back.direction.y;  // to the upper face
    EXPECT_NEAR(static_cast<double>(back.origin.x + t * back.direction.x), 2 * std::tan(inner), 4e-4) << angle;
    // The next ray holds enters r^2 (1 - r). It leaves with this one if it is of less than a hundredth.
    const bool goes_on = enters * r * r > 1e-2;
    EXPECT_NEAR(static_cast<double>(back.weight.x), goes_on ? enters * r * (1 - r) : enters * r, 1e-5) << angle;
    double sum = static_cast<double>(ray.share.x);
    for (const PassedRays::Ways::Aside& aside : ray.asides) sum += static_cast<double>(aside.ray.weight.x);
    EXPECT_NEAR(sum, enters, 1e-5) << angle;
  }
}

TEST(Glass, APrismReflectsAllBeyondTheCriticalAngle) {
  Scene scene;
  scene.materials = {glass(1.5f)};
  add_prism(scene, {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, 0);
  // In through the left face, reflected by the slanted one at 45 degrees, out through the lower face.
  const Passed ray = pass(scene, {-1, 0.4f, 0}, {1, 0, 0});
  expect_near(ray.direction, {0, -1, 0}, 1e-6f);
  EXPECT_NEAR(ray.origin.x, 0.6f, 1e-5f);
  scene.materials = {glass(1.3f)};  // the critical angle is 50.3 degrees: it leaves through the slanted face
  const float out = std::asin(1.3f * std::sin(std::numbers::pi_v<float> / 4)) - std::numbers::pi_v<float> / 4;
  expect_near(pass(scene, {-1, 0.4f, 0}, {1, 0, 0}).direction, {std::cos(out), -std::sin(out), 0}, 1e-5f);
}

TEST(Glass, ABallBendsARayTwiceByTheSameAngle) {
  Scene scene;
  scene.materials = {glass(1.5f)};
  scene.meshes.push_back(ball_mesh({0, 0, 0}, 1, 0, 1024, 512));
  for (const float height : {0.0f, 0.3f, 0.6f, 0.9f}) {
    const Passed ray = pass(scene, {-3, height, 0.0f}, {1, 0, 0});
    const float turn = 2 * (std::asin(height) - std::asin(height / 1.5f));
    // The facets' corners are 3e-3 apart, and normals between them are interpolated.
    expect_near(ray.direction, {std::cos(turn), -std::sin(turn), 0}, 1e-4f);
  }
}

TEST(Glass, AbsorbsByTheLengthOfTheWay) {
  Scene scene;
  SurfaceMaterial green = glass(1.0f);
  green.specular = 0;
  green.attenuation_color = {0.25f, 0.81f, 1};
  green.attenuation_distance = 2;
  scene.materials = {green};
  add_prism(scene, {{-4, 0, 0}, {4, 0, 0}, {4, 1, 0}, {-4, 1, 0}}, 0);
  expect_near(pass(scene, {0, 2, 0}, {0, -1, 0}).share, {0.5f, 0.9f, 1}, 1e-5f);
  expect_near(pass(scene, {0, 2, 0}, {std::sqrt(3.0f), -1, 0}).share, {0.25f, 0.81f, 1}, 1e-5f);
  scene.materials[0].base_color = {0.5f, 1, 1, 1};  // once for the solid
  expect_near(pass(scene, {0, 2, 0}, {0, -1, 0}).share, {0.25f, 0.9f, 1}, 1e-5f);
}

TEST(Glass, InGlassBendsByTheRatioOfTheIndices) {
  Scene scene;
  scene.materials = {glass(1.2f), glass(1.6f)};
  add_prism(scene, {{-9, 0, 0}, {9, 0, 0}, {9, 3, 0}, {-9, 3, 0}}, 0);
  add_prism(scene, {{-8, 1, 0}, {8, 1, 0}, {8, 2, 0}, {-8, 2, 0}}, 1);
  const Vec3f direction{0.6f, -0.8f, 0};
  const Passed ray = pass(scene, Vec3f{0, 3, 0} - direction, direction);
  expect_near(ray.direction, direction, 1e-5f);
  const float outer = std::asin(0.6f / 1.2f), inner = std::asin(0.6f / 1.6f);
  EXPECT_NEAR(ray.origin.x - ray.origin.y / ray.direction.y * ray.direction.x, 2 * std::tan(outer) + std::tan(inner), 4 * kOffset * 0.75f);
}

// Light of radiance 1 from everywhere: a solid that absorbs nothing is invisible, up to what the environment's light of its gloss is off.
TEST(Glass, VanishesInAWhiteFurnace) {
  Scene scene;
  scene.materials = {glass(1.5f)};
  scene.meshes.push_back(ball_mesh({0, 0, 0}, 1, 0, 96, 48));
  scene.meshes.push_back(ball_mesh({0.5f, 1.2f, -1}, 0.5f, 0, 96, 48));
  scene.environment = std::make_shared<const Environment>(white_environment());
  scene.cameras = {camera_at({0, 0.3, 4}, {0, 0, -1}, 0.9)};
  scene.bounds_min = {-1, -1, -1.5};
  scene.bounds_max = {1, 1.7, 1};
  for (Mesh& mesh : scene.meshes) mesh.casts_shadow = false;
  RenderOptions options;
  options.width = 96;
  options.height = 64;
  const auto expect_nothing = [&](const Scene& s) {
    double worst = 0;
    for (const Vec3f& p : render(s, options).pixels) worst = std::max(worst, std::fabs(static_cast<double>(p.y) - 1));
    EXPECT_LT(worst, 2e-3) << options.bounces;
  };
  expect_nothing(scene);
  Scene one = scene;
  one.meshes.pop_back();
  options.bounces = kAllBounces;  // with rays that are reflected within
  expect_nothing(one);
  options.bounces = 0;
  for (Mesh& mesh : scene.meshes) mesh.material = 1;  // the balls are in the picture
  scene.materials.push_back(SurfaceMaterial{});
  scene.materials.back().base_color = {0, 0, 0, 1};
  EXPECT_LT(render(scene, options).at(48, 40).y, 0.5f);
}

// Any camera and any mesh: finite pictures, and an end.
TEST(Glass, StandsDegenerateSolids) {
  reference::Random random(5);
  Scene scene;
  scene.materials = {glass(1.5f), glass(1.01f), glass(30), glass(1)};
  scene.materials[2].attenuation_distance = 1e-30f;
  scene.materials[2].attenuation_color = {0, 1, 0.5f};
  const auto number = [&] { return static_cast<float>(2 * random.uniform() - 1); };
  for (int i = 0; i < 40; ++i) {  // loose, crossing triangles, some without area
    const auto corner = [&] { return Vec3f{number(), number(), number()}; };
    const Vec3f a = corner(), b = i % 7 == 0 ? a : corner();
    scene.meshes.push_back(quad_mesh(a, b, corner(), corner(), i % 4));
  }
  scene.meshes.push_back(ball_mesh({0, 0, 0}, 2, 0, 16, 8));  // the camera is in it
  scene.cameras = {camera_at({0.1, 0.2, 1.2}, {0, 0, -1}, 1.2)};
  scene.environment = std::make_shared<const Environment>(white_environment());
  RenderOptions options;
  options.width = options.height = test::by_day_or_night(20, 48);
  options.quality = test::by_day_or_night(Quality::draft, Quality::normal);
  for (const float roughness : {0.0f, 0.1f, 0.5f, 1.0f}) {
    for (std::size_t i = 0; i < 4; ++i) {
      scene.materials[i].roughness = roughness;
      scene.materials[i].solid = i % 2 == 0 || roughness == 0;
    }
    options.bounces = roughness > 0 ? kAllBounces : 0;
    for (const Vec3f& p : render(scene, options).pixels) ASSERT_TRUE(is_finite(p) && p.x >= 0) << roughness;
  }
}

}  // namespace steradian::passed_rays_test
