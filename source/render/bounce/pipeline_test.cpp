// The bounce as a whole: sums in float against doubles, culled against unculled, and against path tracing.
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <numbers>

#include "render/bounce/receivers/blue_noise.h"
#include "render/bounce/receivers/filter.h"
#include "render/bounce/receivers/light_receivers.h"
#include "render/bounce/true_light.h"
#include "render/surface/camera_rays.h"
#include "steradian/compare.h"
#include "steradian/render.h"
#include "support/mixed_corner.h"

namespace steradian::indirect::pipeline_test {
namespace {

TEST(IndirectShadowMap, CarriesTheConesFlux) {
  Scene scene = mixed_corner();
  scene.punctual_lights[0].cos_inner = scene.punctual_lights[0].cos_outer + 1e-4;  // no falloff: flux = I 2 pi (1 - cos)
  const RayScene rays(scene);
  for (const int count : {1 << 12, 1 << 16}) {
    const ShadowMap map = make_shadow_map(scene, rays, count);
    double flux = 0;
    for (std::size_t i = 0; i < map.count; ++i) flux += static_cast<double>(map.flux.x[i]);
    // The cone's rim cuts texels: about its circumference over the root of their number.
    EXPECT_NEAR(flux, 10 * 2 * 3.14159265 * (1 - std::cos(0.35)), 10 * 0.38 * 4 / std::sqrt(count)) << count;
    for (std::size_t i = 0; i < map.count; i += 97)
      EXPECT_NEAR(map.area[i], length(cross(map.edge_x[i], map.edge_y[i])) * 4, 1e-4 * map.area[i]);
  }
}

// A horizontal square light of 1 m2 and radiance 2, at height 1, that faces up.
Scene lamp_scene(bool two_sided) {
  Scene scene = mixed_corner();
  scene.punctual_lights.clear();
  scene.meshes.clear();
  AreaLight light;
  light.shape = Polygon{{{-0.5, 1, -0.5}, {-0.5, 1, 0.5}, {0.5, 1, 0.5}, {0.5, 1, -0.5}}, {}};
  light.radiance = {2, 2, 2};
  light.two_sided = two_sided;
  scene.area_lights = {light};
  return scene;
}

double flux_of(const ShadowMap& map) {
  double flux = 0;
  for (std::size_t i = 0; i < map.count; ++i) flux += static_cast<double>(map.flux.x[i]);
  return flux;
}

// In a closed box every ray arrives, with equal flux: the sum is the light's power, except for float's rounding of one ray.
TEST(IndirectShadowMap, AreaLightsCarryTheirPowerIntoAClosedBox) {
  for (const bool two_sided : {false, true}) {
    Scene scene = lamp_scene(two_sided);
    const Vec3f a{-2, -1, -3}, b{3, 4, 2};
    const auto side = [&](Vec3f p, Vec3f q, Vec3f r, Vec3f s) { scene.meshes.push_back(scene::quad_mesh(p, q, r, s, 0)); };
    side({a.x, a.y, b.z}, {b.x, a.y, b.z}, {b.x, a.y, a.z}, a);  // floor
    side({a.x, b.y, a.z}, {b.x, b.y, a.z}, b, {a.x, b.y, b.z});  // lid
    side(a, {b.x, a.y, a.z}, {b.x, b.y, a.z}, {a.x, b.y, a.z});  // the four walls
    side({b.x, a.y, b.z}, {a.x, a.y, b.z}, {a.x, b.y, b.z}, b);
    side({a.x, a.y, b.z}, a, {a.x, b.y, a.z}, {a.x, b.y, b.z});
    side({b.x, a.y, a.z}, {b.x, a.y, b.z}, b, {b.x, b.y, a.z});
    const double power = (two_sided ? 2 : 1) * std::numbers::pi * 2;
    EXPECT_NEAR(flux_of(make_shadow_map(scene, RayScene(scene), 1 << 14)), power, power * 1.2e-7);
  }
}

// Answers single rays in rounds of some rows, and leaves every third open.
class SomeHits final : public FirstHits {
 public:
  explicit SomeHits(const RayScene& scene) : scene_(scene) {}
  std::size_t most() const override { return 700; }
  MapRay* rays(std::size_t count) override {
    rays_.assign(count, {});
    return rays_.data();
  }
  void find(std::size_t count) override {
    ++rounds;
    EXPECT_TRUE(count <= most() || count == 4 * 256) << count;  // a row may be longer
  }
  FirstHit hit(std::size_t ray) const override {
    if (ray % 3 == 0) return {FirstHit::kUnknown, 0};
    RTCRayHit hit;
    if (!scene_.intersect(rays_[ray].origin, rays_[ray].direction, hit)) return {};
    return {hit.hit.geomID, hit.hit.primID};
  }
  int rounds = 0;

 private:
  const RayScene& scene_;
  std::vector<MapRay> rays_;
};

TEST(IndirectShadowMap, IsTheSameByHitsFoundElsewhere) {
  const Scene scene = mixed_corner();
  const RayScene rays(scene);
  for (const int count : {1 << 12, 1 << 16}) {
    SomeHits hits(rays);
    const ShadowMap map = make_shadow_map(scene, rays, count), other = make_shadow_map(scene, rays, count, &hits);
    EXPECT_EQ(hits.rounds, count == 1 << 12 ? 8 : 64);  // rounds of two rows of 256, or of one row of 1024
    ASSERT_EQ(map.count, other.count);
    int unlike = 0;
    for (std::size_t i = 0; i < map.count; ++i)
      unlike += !(length(map.position[i] - other.position[i]) < 1e-5f && map.column[i] == other.column[i] && map.row[i] == other.row[i] &&
                  length(map.flux[i] - other.flux[i]) <= 1e-5f * length(map.flux[i]));
    EXPECT_EQ(unlike, 0) << count;
  }
}

// A lid over the light gets the fraction of power that their form factor gives: directions follow the cosine, places are even.
TEST(IndirectShadowMap, AreaLightsSendALidItsFormFactor) {
  Scene scene = lamp_scene(true);
  const double half = 0.8, height = 0.7;  // the lid's, above the light
  const auto x = static_cast<float>(half), y = static_cast<float>(1 + height);
  scene.meshes.push_back(scene::quad_mesh({-x, y, -x}, {x, y, -x}, {x, y, x}, {-x, y, x}, 0));
  const PreparedPolygon lid =
      prepare_polygon({{{-half, height, -half}, {half, height, -half}, {half, height, half}, {-half, height, half}}, {}, {1, 1, 1}, true});
  double form_factor = 0;  // midpoints of the light: the integrand is smooth, the error of 64 x 64 below 1e-4
  for (int i = 0; i < 64; ++i)
    for (int j = 0; j < 64; ++j)
      form_factor += polygon_irradiance(lid, {(i + 0.5) / 64 - 0.5, 0, (j + 0.5) / 64 - 0.5}, {0, 1, 0}) / std::numbers::pi / (64 * 64);
  const ShadowMap map = make_shadow_map(scene, RayScene(scene), 1 << 14);
  const double share = flux_of(map) / (2 * std::numbers::pi * 2);  // the light has two sides
  // No worse than random rays: 4 sigma of as many coins.
  const double p = 0.5 * form_factor, sigma = std::sqrt(p * (1 - p) / static_cast<double>(map.count));
  std::printf("share of the lid %.5f, half the form factor %.5f, sigma by chance %.5f\n", share, p, sigma);
  EXPECT_NEAR(share, p, 4 * sigma);
}

TEST(IndirectLighting, BlueNoiseHoldsEveryRankOnceAndLittleOfLowFrequencies) {
  std::vector<int> seen(kMaskSide * kMaskSide);
  for (const auto& row : blue_noise())
    for (const float v : row) ++seen[static_cast<std::size_t>(v * kMaskSide * kMaskSide)];
  for (const int n : seen) EXPECT_EQ(n, 1);
  // Means over 8 x 8 blocks of white noise have variance 1/(12 64); the mask's vary far less.
  double variance = 0;
  for (std::size_t by = 0; by < 8; ++by)
    for (std::size_t bx = 0; bx < 8; ++bx) {
      double sum = 0;
      for (std::size_t y = 0; y < 8; ++y)
        for (std::size_t x = 0; x < 8; ++x) sum += static_cast<double>(blue_noise()[8 * by + y][8 * bx + x]);
      variance += std::pow(sum / 64 - 0.5, 2) / 64;
    }
  EXPECT_LT(variance, 0.1 / (12 * 64));
}

// The sum on packs in float equals the sum in double. Fresnel by pair differs: the pack uses it at virtual lights below F0 0.1, as the
// double does.
TEST(IndirectLighting, SumOnPacksIsTheSumInDouble) {
  for (const IndirectMode mode : {IndirectMode::ltc, IndirectMode::ltc_outgoing, IndirectMode::ggx})
    for (const Scene& scene : {metal_corner(), mixed_corner()}) {
      const Difference d = difference(plain_sum(scene, mode, 1 << 12), true_sum(scene, mode, 1 << 12));
      EXPECT_LT(d.relative_l2, 2e-4) << "mode " << static_cast<int>(mode) << ", mean ratio " << d.mean_ratio;
    }
}

// The bounce between two metals, F0 = 1: transformed cosines at both ends against GGX at both ends in double.
TEST(IndirectLighting, TwoGlossyEndsAreNearGgx) {
  for (const float roughness : {0.35f, 0.5f, 0.7f}) {
    const Scene scene = metal_corner(roughness);
    const Picture truth = true_sum(scene, IndirectMode::ggx, 1 << 12);
    const Difference d = difference(true_sum(scene, IndirectMode::ltc, 1 << 12), truth);
    std::cout << "roughness " << roughness << ": relative L2 " << d.relative_l2 << ", energy " << d.mean_ratio << "\n";
    EXPECT_LE(d.relative_l2, 0.10) << roughness;
    EXPECT_NEAR(d.mean_ratio, 1, 0.05) << roughness;
  }
}

// The sum over all virtual lights at every pixel, with a given lobe.
struct Sum {
  Picture picture;
  double seconds;
};
Sum sum_by(const Scene& scene, SumLobe lobe, int lights) {
  const RayScene rays(scene);
  const ShadowMap map = make_shadow_map(scene, rays, lights);
  const RenderOptions o = options(IndirectMode::ltc, lights);
  const CameraRays camera(scene.cameras[0], o.width, o.height);
  Sum sum{Picture(o.width, o.height), 0};
  const auto start = std::chrono::steady_clock::now();
  for (int y = 0; y < o.height; ++y)
    for (int x = 0; x < o.width; ++x) {
      const Vec3f direction = camera.direction(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f);
      RTCRayHit hit;
      if (!rays.intersect(camera.origin(), direction, hit)) continue;
      const Surface s = surface_at(scene, scene.meshes[hit.hit.geomID], hit.hit.primID, hit.hit.u, hit.hit.v, -direction);
      sum.picture.at(x, y) = static_cast<Vec3f>(sum_virtual_lights(map, s, -direction, {lobe}));
    }
  sum.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return sum;
}

// Averaged over the lobe, Schlick's term loses light that a rough dielectric reflects near the horizon, and sends it elsewhere. By pair,
// energy stays within the limit for lobes (3 %), and most of the error vanishes.
TEST(IndirectLighting, DielectricsNeedFresnelByPair) {
  Scene scene = corner(plastic(0.6f, 0.45f), plastic(0.0f, 1.0f));  // a black, rough wall feeds a diffuse floor
  scene.materials[0].specular = 0;
  scene.punctual_lights[0].position = {0.3, 2.2, 1};  // 49 degrees from its normal
  scene.punctual_lights[0].direction = normalized(Vec3d{0, 1.1, 0} - scene.punctual_lights[0].position);
  const Picture truth = sum_by(scene, SumLobe::ggx, 1 << 12).picture;
  const Difference by_pair = difference(sum_by(scene, SumLobe::ltc, 1 << 12).picture, truth);
  const Difference averaged = difference(sum_by(scene, SumLobe::ltc_averaged, 1 << 12).picture, truth);
  std::cout << "dielectric wall, relative L2 and energy: by the pair " << by_pair.relative_l2 << ", " << by_pair.mean_ratio
            << "; averaged over the lobe " << averaged.relative_l2 << ", " << averaged.mean_ratio << "\n";
  EXPECT_NEAR(by_pair.mean_ratio, 1, 0.03);
  EXPECT_LT(averaged.mean_ratio, 0.97);
  EXPECT_LT(by_pair.relative_l2, averaged.relative_l2 / 2);
}

// The literature's slow variant checks the one in use: both give the same light within the fit's error. Without the factor of reciprocity,
// algorithm 1 does not. Algorithm 1 looks up the table for every pair of pixel and light, algorithm 2 for every light and every pixel.
TEST(IndirectLighting, BothAlgorithmsAreTheSameLight) {
  const Scene scene = metal_corner(0.45f);
  constexpr int kLights = 1 << 12;
  const Picture truth = sum_by(scene, SumLobe::ggx, kLights).picture;
  const Sum two = sum_by(scene, SumLobe::ltc, kLights), one = sum_by(scene, SumLobe::ltc_outgoing, kLights);
  const Difference second = difference(two.picture, truth), first = difference(one.picture, truth),
                   raw = difference(sum_by(scene, SumLobe::ltc_outgoing_raw, kLights).picture, truth);
  const auto pixels = static_cast<double>(truth.pixels.size());
  std::cout << "relative L2, energy, look-ups of lights, seconds: algorithm 2 " << second.relative_l2 << ", " << second.mean_ratio << ", "
            << kLights << ", " << two.seconds << "; algorithm 1 " << first.relative_l2 << ", " << first.mean_ratio << ", "
            << pixels * kLights << ", " << one.seconds << "; without its factor " << raw.relative_l2 << ", " << raw.mean_ratio << "\n";
  for (const Difference& d : {first, second}) EXPECT_NEAR(d.mean_ratio, 1, 0.03);  // the limit for lobes
  EXPECT_LT(difference(one.picture, two.picture).relative_l2, first.relative_l2 + second.relative_l2);
  EXPECT_GT(std::fabs(raw.mean_ratio - 1), 0.03);
  EXPECT_GT(raw.relative_l2, first.relative_l2 + second.relative_l2);
}

// The same sets of virtual lights, complete and culled. The mean over seeds is the whole sum, and a seed changes the frame's mean only
// slightly.
TEST(IndirectLighting, CullingKeepsTheMean) {
  for (const IndirectMode mode : {IndirectMode::ltc, IndirectMode::ltc_outgoing, IndirectMode::ggx}) {
    const Scene scene = mode == IndirectMode::ltc ? mixed_corner() : metal_corner();
    RenderOptions o = options(mode, 1 << 12);
    o.indirect.interleave = 4;
    o.indirect.filter = false;
    o.indirect.kept_pairs = 0;
    const Picture whole = bounce(scene, o);
    o.indirect.kept_pairs = 8;
    constexpr int kSeeds = 256;
    std::vector<double> sum(whole.pixels.size()), squares(whole.pixels.size());
    double frame_sum = 0, frame_squares = 0;
    for (int seed = 1; seed <= kSeeds; ++seed) {
      o.seed = static_cast<std::uint64_t>(seed);
      const Picture culled = bounce(scene, o);
      for (std::size_t i = 0; i < sum.size(); ++i) {
        const double v = static_cast<double>(culled.pixels[i].x + culled.pixels[i].y + culled.pixels[i].z);
        sum[i] += v;
        squares[i] += v * v;
      }
      frame_sum += mean(culled);
      frame_squares += mean(culled) * mean(culled);
    }
    int tested = 0, outside = 0;
    for (std::size_t i = 0; i < sum.size(); ++i) {
      const double m = sum[i] / kSeeds, variance = std::max(squares[i] / kSeeds - m * m, 0.0) / (kSeeds - 1);
      const double truth = static_cast<double>(whole.pixels[i].x + whole.pixels[i].y + whole.pixels[i].z);
      if (!(truth > 0)) continue;
      ++tested;
      outside += std::fabs(m - truth) > 3 * std::sqrt(variance) + 1e-4 * truth;
    }
    const double m = frame_sum / kSeeds, deviation = std::sqrt(std::max(frame_squares / kSeeds - m * m, 0.0));
    std::cout << "mode " << static_cast<int>(mode) << ": " << outside << " of " << tested << " pixels beyond 3 sigma; frame mean "
              << m / mean(whole) << " of the whole, deviation from seed to seed " << deviation / mean(whole) << "\n";
    // 0.27 % of normal deviates lie beyond. The estimates are skewed, so a few times that is allowed.
    EXPECT_LE(outside, 0.015 * tested);
    EXPECT_NEAR(m / mean(whole), 1, 3 * deviation / mean(whole) / std::sqrt(kSeeds) + 1e-4);
    EXPECT_LT(deviation / mean(whole), 0.02);
  }
}

// R2: path tracing, which does not use virtual lights.
TEST(IndirectLighting, SumApproachesPathTracing) {
  const Scene scene = mixed_corner();
  RenderOptions o = options(IndirectMode::path, 0);
  o.spp = 512;
  const Picture all = render(scene, o);
  Picture path(all.width, all.height);
  path.pixels = all.layers.at("indirect");
  double noise = 0, light = 0;
  for (std::size_t i = 0; i < path.pixels.size(); ++i) {
    const Vec3f v = all.layers.at("indirect_variance")[i], c = path.pixels[i];
    noise += static_cast<double>(v.x + v.y + v.z);
    light += static_cast<double>(dot(c, c));
  }
  const Difference d = difference(plain_sum(scene, IndirectMode::ggx, 1 << 14), path);
  std::cout << "GGX sum against path tracing: relative L2 " << d.relative_l2 << ", noise " << std::sqrt(noise / light) << ", energy "
            << d.mean_ratio << "\n";
  EXPECT_NEAR(d.mean_ratio, 1, 0.02);
  EXPECT_LT(d.relative_l2, 3 * std::sqrt(noise / light) + 0.05);
}

// A clear coat over black equals a dielectric's lobe of the same roughness. Sheen over black adds light where there is none without it.
TEST(IndirectLighting, PathsSeeCoatAndSheen) {
  RenderOptions o = options(IndirectMode::path, 0);
  o.spp = 16;
  const auto energy = [&](const SurfaceMaterial& floor) {
    const Picture picture = render(corner(floor, plastic(0.7f, 0.5f)), o);
    double sum = 0;
    for (const Vec3f c : picture.layers.at("indirect")) sum += static_cast<double>(c.x + c.y + c.z);
    return sum;
  };
  const SurfaceMaterial dielectric = plastic(0, 0.4f);
  SurfaceMaterial black = dielectric;
  black.specular = 0;
  SurfaceMaterial coated = black, with_sheen = black;
  coated.clearcoat = 1;
  coated.clearcoat_roughness = 0.4f;
  with_sheen.sheen_color = {1, 1, 1};
  with_sheen.sheen_roughness = 0.5f;
  const double none = energy(black), lobe = energy(dielectric) - none;
  EXPECT_GT(lobe, 0);
  EXPECT_NEAR((energy(coated) - none) / lobe, 1, 1e-3);  // the same directions: one lobe, one seed
  EXPECT_GT(energy(with_sheen) - none, 0.1 * lobe);
}

TEST(IndirectLighting, SameBytesAtAnyNumberOfThreads) {
  const Scene scene = mixed_corner();
  RenderOptions o = options(IndirectMode::ltc, 1 << 12);
  o.indirect.shadow_rays = 2;
  o.threads = 1;
  const Picture one = bounce(scene, o);
  o.threads = 2;
  const Picture two = bounce(scene, o);
  EXPECT_TRUE(std::equal(one.pixels.begin(), one.pixels.end(), two.pixels.begin(), [](Vec3f a, Vec3f b) { return a == b; }));
}

// A board between wall and floor: the rays must remove the light that the doubles with visibility lack.
TEST(IndirectLighting, RatioEstimatorFindsTheShadows) {
  Scene scene = mixed_corner();
  scene.meshes.push_back(scene::quad_mesh({-1, 0.35f, 0.1f}, {1, 0.35f, 0.1f}, {1, 0.35f, 0.9f}, {-1, 0.35f, 0.9f}, 0));
  RenderOptions o = options(IndirectMode::ltc, 1 << 12);
  o.indirect.quads = o.indirect.soften = false;
  o.indirect.interleave = 1;
  o.indirect.kept_pairs = 0;
  const Picture lit = bounce(scene, o);
  o.indirect.shadow_rays = 16;
  const Picture shadowed = bounce(scene, o);
  RenderOptions r = options(IndirectMode::ltc, 1 << 12);
  r.method = "reference";
  r.target_error = 1;
  r.indirect.shadow_rays = 1;
  const Picture truth = bounce(scene, r);
  const Difference with = difference(shadowed, truth), without = difference(lit, truth);
  std::cout << "relative L2 with rays " << with.relative_l2 << ", without " << without.relative_l2 << "; energy " << with.mean_ratio << ", "
            << without.mean_ratio << "\n";
  EXPECT_NEAR(with.mean_ratio, 1, 0.02);
  EXPECT_LT(with.relative_l2, 0.3 * without.relative_l2);
}

TEST(IndirectFilter, WeighsAllPlacesOfThePatternAlike) {
  for (const int stride : {2, 4, 8}) {
    const FilterWeights w = filter_weights(stride);
    for (const auto& taps : {w.diffuse, w.glossy, w.sharp})
      for (int phase = 0; phase < stride; ++phase) {
        double sum = 0;
        for (int k = -kFilterReach; k <= kFilterReach; ++k)
          if ((k + 64) % stride == phase) sum += static_cast<double>(taps[k + kFilterReach]);
        EXPECT_NEAR(sum, 1.0 / stride, 1e-6) << stride << " " << phase;
      }
  }
}

}  // namespace
}  // namespace steradian::indirect::pipeline_test
