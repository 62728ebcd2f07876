// Environments: the parts against their integrals, and pictures against the reference, which samples the map itself.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/random.h"
#include "lobes/ggx_energy.h"
#include "night.h"
#include "render/environment/environment_light.h"
#include "steradian/area_light.h"
#include "steradian/render.h"
#include "support/meshes.h"
#include "support/random_configurations.h"
#include "support/z_test.h"

namespace steradian::environment_test {
namespace {

using namespace environment;
using namespace scene;
constexpr int kSide = 24;               // side of the pictures
constexpr double kTargetError = 0.008;  // error of the reference: smaller errors are lost in its noise

// A smooth, coloured map of all degrees up to 4 or so.
Picture smooth_map(int width) {
  Picture map(width, width / 2);
  for (int j = 0; j < map.height; ++j)
    for (int i = 0; i < map.width; ++i) {
      const Vec3d d = direction_of({(i + 0.5) / map.width, (j + 0.5) / map.height});
      map.at(i, j) = static_cast<Vec3f>(Vec3d{1 + 0.5 * d.x + 0.4 * d.y * d.z, 0.6 + 0.5 * d.y, 0.5 + 0.3 * d.z * d.z * d.z * d.z});
    }
  return map;
}

// A dark room with a window and a lamp.
Picture room_map() {
  Picture map = smooth_map(256);
  for (int j = 0; j < map.height; ++j)
    for (int i = 0; i < map.width; ++i) {
      map.at(i, j) *= 0.2f;
      if (i >= 60 && i < 80 && j >= 40 && j < 60) map.at(i, j) = {20, 22, 30};
      const Vec3d d = direction_of({(i + 0.5) / map.width, (j + 0.5) / map.height});
      if (dot(d, normalized(Vec3d{0.5, 0.7, 0.3})) > 0.995) map.at(i, j) = {50, 40, 30};
    }
  return map;
}

Vec3d irradiance_by_texels(const DirectionGrid& grid, Vec3d normal) {
  Vec3d sum{};
  for (int j = 0; j < grid.map.height; ++j)
    for (int i = 0; i < grid.map.width; ++i)
      sum += static_cast<Vec3d>(grid.map.at(i, j)) * (std::max(dot(grid.center(i, j), normal), 0.0) * grid.solid_angle(j));
  return sum;
}

// A ball of triangles with smooth normals, radius 1 about the origin.
Mesh ball() {
  Mesh mesh;
  constexpr int kAround = 128, kDown = 64;
  for (int j = 0; j <= kDown; ++j)
    for (int i = 0; i <= kAround; ++i) {
      const double theta = std::numbers::pi * j / kDown, phi = 2 * std::numbers::pi * i / kAround;
      const Vec3f p = static_cast<Vec3f>(Vec3d{std::sin(theta) * std::cos(phi), std::cos(theta), -std::sin(theta) * std::sin(phi)});
      mesh.positions.push_back(p);
      mesh.normals.push_back(p);
    }
  for (std::uint32_t j = 0; j < kDown; ++j)
    for (std::uint32_t i = 0; i < kAround; ++i) {
      const std::uint32_t a = j * (kAround + 1) + i, c = a + kAround + 1;
      mesh.indices.insert(mesh.indices.end(), {a, c, a + 1, a + 1, c, c + 1});
    }
  return mesh;
}

Scene ball_in(Picture map, SurfaceMaterial material) {
  Scene scene;
  scene.materials = {std::move(material)};
  scene.meshes = {ball()};
  scene.bounds_min = {-1, -1, -1};
  scene.bounds_max = {1, 1, 1};
  Camera camera;
  camera.position = {0, 0, 4};
  camera.yfov = 0.55;
  scene.cameras = {camera};
  Environment environment;
  environment.name = "test";
  environment.map = std::move(map);
  scene.environment = std::make_shared<const Environment>(std::move(environment));
  return scene;
}

SurfaceMaterial white_diffuse() {
  SurfaceMaterial m;
  m.metallic = 0;
  m.specular = 0;
  return m;
}

SurfaceMaterial metal(float roughness) {
  SurfaceMaterial m;
  m.roughness = roughness;
  return m;
}

Picture picture_of(const Scene& scene, const std::string& method, RenderStats* stats = nullptr) {
  RenderOptions options;
  options.width = options.height = kSide;
  options.method = method;
  options.background = false;
  options.target_error = kTargetError;
  return render(scene, options, stats);
}

// Root of the sum of squared differences, relative to that of the reference.
double relative_l2(const Picture& a, const Picture& reference) {
  double difference = 0, square = 0;
  for (std::size_t i = 0; i < a.pixels.size(); ++i) {
    const Vec3d d = static_cast<Vec3d>(a.pixels[i]) - static_cast<Vec3d>(reference.pixels[i]);
    difference += dot(d, d);
    square += dot(static_cast<Vec3d>(reference.pixels[i]), static_cast<Vec3d>(reference.pixels[i]));
  }
  return std::sqrt(difference / square);
}

}  // namespace

// Quadrature of P_l(x) max(x, 0) 2 pi over [0, 1].
TEST(EnvironmentHarmonics, CosineCoefficientsAreTheIntegrals) {
  for (int l = 0; l <= 10; ++l) {
    double sum = 0;
    constexpr int kSteps = 200000;
    for (int i = 0; i < kSteps; ++i) {
      const double x = (i + 0.5) / kSteps;
      double before = 1, at = x;
      for (int k = 2; k <= l; ++k) {
        const double next = ((2 * k - 1) * x * at - (k - 1) * before) / k;
        before = at;
        at = next;
      }
      sum += (l == 0 ? 1 : at) * x;
    }
    EXPECT_NEAR(cosine_coefficient(l), 2 * std::numbers::pi * sum / kSteps, 1e-9) << "degree " << l;
  }
}

TEST(EnvironmentHarmonics, AreOrthonormal) {
  DirectionGrid grid{Picture(128, 64)};
  std::vector<double> gram(81 * 81);
  for (int j = 0; j < 64; ++j)
    for (int i = 0; i < 128; ++i) {
      const auto y = harmonics_at(grid.center(i, j));
      for (std::size_t a = 0; a < 81; ++a)
        for (std::size_t b = 0; b <= a; ++b) gram[a * 81 + b] += y[a] * y[b] * grid.solid_angle(j);
    }
  // The midpoint rule in 64 rows: (16 pi / 64)^2 / 24 of products of degree 16.
  for (std::size_t a = 0; a < 81; ++a)
    for (std::size_t b = 0; b <= a; ++b) EXPECT_NEAR(gram[a * 81 + b], a == b ? 1.0 : 0.0, 0.026) << a << " " << b;
}

TEST(EnvironmentHarmonics, IrradianceIsWithinItsResidual) {
  reference::Random random(3);
  for (const Picture& map : {smooth_map(128), room_map()}) {
    const DirectionGrid grid{map};
    const HarmonicIrradiance harmonics(grid);
    double square = 0, mean = 0;
    constexpr int kNormals = 400;
    for (int i = 0; i < kNormals; ++i) {
      const Vec3d n = random_direction(random);
      const double exact = luminance(irradiance_by_texels(grid, n)), d = luminance(harmonics.at(n)) - exact;
      square += d * d / kNormals;
      mean += exact / kNormals;
    }
    const double rms = std::sqrt(square) / mean;
    std::printf("rms %.4f %%, said %.4f %%\n", 100 * rms, 100 * harmonics.residual());
    // An rms of 400 normals is within a tenth of itself; the sum over texels is itself a midpoint rule: 1e-4 of the mean.
    EXPECT_NEAR(rms, harmonics.residual(), 0.2 * rms + 2e-4);
  }
}

TEST(EnvironmentSplit, SpotsAndRestAreTheMap) {
  const DirectionGrid grid{room_map()};
  const SplitMap split = split_bright_spots(grid);
  ASSERT_EQ(split.spots.size(), 2u);
  EXPECT_GT(split.share, 0.5);
  // The irradiance of both together is the map's, up to the 1/64 by which the polygons' edges are located in their texels.
  reference::Random random(5);
  for (int i = 0; i < 50; ++i) {
    const Vec3d n = random_direction(random);
    Vec3d sum = irradiance_by_texels(split.rest, n);
    for (const PolygonLight& spot : split.spots) {
      const PreparedPolygon prepared = prepare_polygon(spot);
      EXPECT_GT(prepared.side_of({0, 0, 0}), -1);
      sum += spot.radiance * polygon_irradiance(prepared, {0, 0, 0}, n);
    }
    const Vec3d exact = irradiance_by_texels(grid, n);
    EXPECT_NEAR(luminance(sum), luminance(exact), 0.003 * luminance(irradiance_by_texels(grid, normalized(Vec3d{0.3, 0.7, 0.3})))) << i;
  }
}

TEST(EnvironmentSplit, LeavesASmoothMapAlone) {
  EXPECT_TRUE(split_bright_spots(DirectionGrid{smooth_map(128)}).spots.empty());
  EXPECT_TRUE(split_bright_spots(DirectionGrid{Picture(16, 8)}).spots.empty());
}

// The bright strips of the family: arcs of any width and length about any axis, up to whole rings, crosses of two, and rings of texels
// around the poles. Their radiance is 20 to 60 times that of the rest.
Picture strips_map(reference::Random& random) {
  Picture map(256, 128);
  const int arcs = 1 + static_cast<int>(random.uniform() * 2.999);
  struct Arc {
    Vec3d axis, start;
    double height, width, length;
  };
  std::vector<Arc> family;
  for (int k = 0; k < arcs; ++k) {
    const Vec3d axis = random.uniform() < 0.3 ? Vec3d{0, 1, 0} : random_direction(random);
    const Frame frame = Frame::from_normal(axis);
    family.push_back({axis, frame.x, random.uniform(-0.7, 0.7), random.uniform(0.03, 0.1), random.uniform(0.5, 6.5)});
  }
  const double bright = random.uniform(20, 60);
  for (int j = 0; j < map.height; ++j)
    for (int i = 0; i < map.width; ++i) {
      const Vec3d d = direction_of({(i + 0.5) / map.width, (j + 0.5) / map.height});
      map.at(i, j) = static_cast<Vec3f>(Vec3d{0.5, 0.4 + 0.1 * d.y, 0.5});
      for (const Arc& arc : family) {
        const double angle = std::atan2(dot(d, cross(arc.axis, arc.start)), dot(d, arc.start)) + std::numbers::pi;
        if (std::fabs(dot(d, arc.axis) - arc.height) < arc.width / 2 && angle < arc.length)
          map.at(i, j) = static_cast<Vec3f>(Vec3d{1, 0.9, 0.7} * bright);
      }
    }
  return map;
}

double power_of(const DirectionGrid& grid, bool signs) {
  double power = 0;
  for (int j = 0; j < grid.map.height; ++j)
    for (int i = 0; i < grid.map.width; ++i) {
      const double l = luminance(static_cast<Vec3d>(grid.map.at(i, j)));
      power += (signs ? l : std::fabs(l)) * grid.solid_angle(j);
    }
  return power;
}

double solid_angle_of(const PolygonLight& light) {
  double sum = 0;
  const auto& v = light.vertices;
  for (std::size_t i = 1; i + 1 < v.size(); ++i) {
    const Vec3d a = normalized(v[0]), b = normalized(v[i]), c = normalized(v[i + 1]);
    sum += 2 * std::atan2(dot(a, cross(b, c)), 1 + dot(a, b) + dot(b, c) + dot(c, a));
  }
  return std::fabs(sum);
}

// Strips of any shape become at most 48 lights, and the lights and the rest are the map.
TEST(EnvironmentSplit, StripsOfAnyShapeBecomeLights) {
  reference::Random random(17);
  double mean_rest = 0, worst_error = 0;
  std::size_t most = 0;
  const int maps = test::by_day_or_night(12, 200);
  for (int k = 0; k < maps; ++k) {
    const DirectionGrid grid{strips_map(random)};
    const SplitMap split = split_bright_spots(grid);
    ASSERT_FALSE(split.spots.empty()) << k;
    most = std::max(most, split.spots.size());
    double power = power_of(split.rest, true);
    for (const PolygonLight& spot : split.spots) power += luminance(spot.radiance) * solid_angle_of(spot);
    // Texels are floats: 2^-24 of the brightest each, and their errors are independent.
    worst_error = std::max(worst_error, std::fabs(power / power_of(grid, true) - 1));
    // Light that the polygons miss or send too much, over the map's.
    const double dim = 0.45 * 4 * std::numbers::pi;
    const double rest = (power_of(split.rest, false) - dim) / power_of(grid, true);
    mean_rest += rest / maps;
  }
  std::printf("%d maps: at most %zu lights, energy within %.1e, rest %.3f of the map\n", maps, most, worst_error, mean_rest);
  EXPECT_LE(most, 48u);
  EXPECT_LT(worst_error, 1e-5);
  EXPECT_LT(mean_rest, 0.5);
}

TEST(EnvironmentFilter, BlursByTheStatedWidthAndKeepsConstants) {
  Picture even(64, 32);
  for (Vec3f& p : even.pixels) p = {1, 2, 3};
  const FilteredMap flat{DirectionGrid{even}};
  reference::Random random(7);
  for (int i = 0; i < 200; ++i) {
    const Vec3f m = flat.mean(static_cast<Vec3f>(random_direction(random)), static_cast<float>(random.uniform(0, 1)));
    EXPECT_NEAR(m.x, 1, 1e-5);
    EXPECT_NEAR(m.z, 3, 1e-5);
  }
  // A harmonic of degree 2 retains exp(-l (l + 1) w^2 / 2) = exp(-3 w^2) of itself under a Gaussian of that width.
  Picture map(512, 256);
  for (int j = 0; j < map.height; ++j)
    for (int i = 0; i < map.width; ++i) {
      const Vec3d d = direction_of({(i + 0.5) / map.width, (j + 0.5) / map.height});
      map.at(i, j).x = static_cast<float>(3 * d.y * d.y - 1);
    }
  const FilteredMap filtered{DirectionGrid{map}};
  for (const float w : {0.02f, 0.05f, 0.1f, 0.2f, 0.3f}) {
    double worst = 0;
    for (int i = 0; i < 200; ++i) {
      const Vec3d d = random_direction(random);
      worst = std::max(worst, std::fabs(filtered.mean(static_cast<Vec3f>(d), w).x - std::exp(-3.0 * w * w) * (3 * d.y * d.y - 1)));
    }
    std::printf("width %.2f: worst %.4f of 2\n", static_cast<double>(w), worst);
    // The bound holds for an amplitude of 2. Linear interpolation between widths a factor of two apart: 0.75 w^2. An octahedron's texels
    // differ in length by up to 1.7, and so does the variance that interpolation adds, (0.83 w)^2 / 6 in the mean: 3 (1.7^2 - 1) 0.116
    // w^2. At an edge of the octahedron, with texels of up to 1.7 times 0.83 w: a quarter of one times the slope, which is 3 at most.
    EXPECT_LT(worst, 2 * 1.41 * w * w + 1.06 * w) << w;
  }
}

// The sampler's density integrates to 1, and its samples find the map's power.
TEST(EnvironmentSampling, DensityAndSamplesAgree) {
  const EnvironmentSampler sampler{DirectionGrid{room_map()}};
  reference::Random random(11);
  double density = 0;
  Vec3d power{};
  constexpr int kSamples = 200000;
  for (int i = 0; i < kSamples; ++i) {
    density += sampler.pdf(random_direction(random)) * 4 * std::numbers::pi / kSamples;
    const double u = random.uniform(), v = random.uniform();
    const Vec3d d = sampler.sample(u, v);
    power += sampler.radiance(d) / sampler.pdf(d) / double{kSamples};
  }
  Vec3d exact{};
  const DirectionGrid grid{room_map()};
  for (int j = 0; j < grid.map.height; ++j)
    for (int i = 0; i < grid.map.width; ++i) exact += static_cast<Vec3d>(grid.map.at(i, j)) * grid.solid_angle(j);
  // Five standard errors: the density varies by a factor of 50 over 1 % of the sphere, the quotient by at most 3.
  EXPECT_NEAR(density, 1, 5 * 5 / std::sqrt(double{kSamples}));
  EXPECT_NEAR(luminance(power) / luminance(exact), 1, 5 * 0.5 / std::sqrt(double{kSamples}));
}

TEST(EnvironmentRender, AWhiteFurnaceHidesAWhiteBall) {
  const Scene scene = ball_in(white_environment().map, white_diffuse());
  const Picture picture = picture_of(scene, "auto"), estimate = picture_of(scene, "reference");
  for (const Picture* p : {&picture, &estimate}) {
    const Vec3f middle = p->at(kSide / 2, kSide / 2);
    EXPECT_NEAR(middle.x, 1, p == &picture ? 2e-4 : 0.02);
  }
  float low = 1, high = 1;
  for (const Vec3f& p : picture.pixels)
    if (p.x > 0) {
      low = std::min(low, p.x);
      high = std::max(high, p.x);
    }
  EXPECT_GT(low, 0.9995f);
  EXPECT_LT(high, 1.0005f);
  EXPECT_EQ(picture.at(0, 0), (Vec3f{0, 0, 0})) << "the background is off";
}

// A metal of F = 1 in a white sky sends its directional albedo, with and without rays to the sky.
TEST(EnvironmentRender, AMetalInAWhiteFurnaceSendsItsAlbedo) {
  double worst = 0;
  for (const float roughness : {0.1f, 0.3f, 0.6f, 1.0f})
    for (const Shadows shadows : {Shadows::on, Shadows::off}) {
      const Scene scene = ball_in(white_environment().map, metal(roughness));
      RenderOptions options;
      options.width = options.height = kSide;
      options.background = false;
      options.shadows = shadows;
      const Picture picture = render(scene, options);
      for (int y = 0; y < kSide; ++y)
        for (int x = 0; x < kSide; ++x) {
          const double pixel = 2 * std::tan(0.55 / 2) / kSide;
          const Vec3d to = normalized(Vec3d{(x + 0.5 - kSide / 2.0) * pixel, (kSide / 2.0 - y - 0.5) * pixel, -1});
          const double half = 4 * -to.z, root = half * half - 15;  // where the ray meets the ball
          if (!(root > 0)) continue;
          const double cosine = std::sqrt(root);  // of the view to the normal
          if (cosine < 0.3) continue;             // there the ball's facets show
          const double alpha = static_cast<double>(roughness * roughness);
          worst = std::max(worst, std::fabs(static_cast<double>(picture.at(x, y).x) - lobes::ggx_energy(alpha, cosine).plain));
        }
    }
  std::printf("metals are within %.1e of their albedo\n", worst);
  // Corners of the ball's facets are 0.05 apart, so the facets lie up to 3e-4 inside. At a cosine of 0.3 that moves the normal by 1e-3. The
  // albedo's slope is at most 1.
  EXPECT_LT(worst, 1e-3);
}

// Under a dielectric's boundary and with its specular lobe, in a uniform sky. The part of the base that the cosine-weighted mean of (1 -
// F) leaves is exact. The specular part is the cones' cubature of the lobe's albedo.
TEST(EnvironmentRender, ADielectricInAFurnaceAgreesWithTheReference) {
  SurfaceMaterial m = white_diffuse();
  m.specular = 1;
  m.roughness = 0.5f;
  const Scene scene = ball_in(white_environment().map, m);
  const Picture estimate = picture_of(scene, "reference");
  const double error = relative_l2(picture_of(scene, "auto"), estimate);
  std::printf("dielectric %.2f %%\n", 100 * error);
  EXPECT_LT(error, 1.5 * kTargetError);  // the reference's own noise
}

TEST(EnvironmentRender, DiffuseAgreesWithTheReference) {
  for (const Picture& map : {smooth_map(128), room_map()}) {
    const Scene scene = ball_in(map, white_diffuse());
    RenderStats stats;
    const Picture picture = picture_of(scene, "auto", &stats), estimate = picture_of(scene, "reference");
    const image::ZTest z = image::z_test(picture, estimate, 3 * stats.diffuse_residual + 0.002);
    std::printf("accepted %.4f, L2 %.4f, residual %.4f, spots %.3f\n", z.share(), relative_l2(picture, estimate), stats.diffuse_residual,
                stats.environment_spots);
    EXPECT_GT(z.share(), 0.9975);
  }
}

// Error of the specular lobe, as docs/environments.md states it.
TEST(EnvironmentRender, SpecularAgreesWithTheReference) {
  for (const float roughness : test::by_day_or_night<std::vector<float>>({0.3f, 1.0f}, {0.1f, 0.3f, 0.6f, 1.0f}))
    for (const bool room : {false, true}) {
      const Scene scene = ball_in(room ? room_map() : smooth_map(256), metal(roughness));
      const double error = relative_l2(picture_of(scene, "auto"), picture_of(scene, "reference"));
      std::printf("roughness %.2f %s: %.2f %%\n", static_cast<double>(roughness), room ? "room" : "smooth", 100 * error);
      EXPECT_LT(error, 0.03) << roughness << (room ? " room" : " smooth");
    }
}

// The family of bright strips: any shape, roughness and map, by Monte Carlo of the whole map. The limit is the largest figure for strips in
// docs/environments.md, 3.4 %.
TEST(EnvironmentRender, StripsOfAnyShapeAgreeWithTheReference) {
  reference::Random random(31);
  double worst = 0;
  const int maps = test::by_day_or_night(3, 40);
  for (int k = 0; k < maps; ++k) {
    const auto roughness = static_cast<float>(k % 3 == 0 ? 0.5 : random.uniform(0.3, 1));
    const Scene scene = ball_in(strips_map(random), metal(roughness));
    const double error = relative_l2(picture_of(scene, "auto"), picture_of(scene, "reference"));
    std::printf("map %d, roughness %.2f: %.2f %%\n", k, static_cast<double>(roughness), 100 * error);
    worst = std::max(worst, error);
  }
  std::printf("%d maps: worst %.2f %%\n", maps, 100 * worst);
  EXPECT_LT(worst, 0.035);
}

// The residual that is printed is the cones' error: small without the strips, large with them (a file's own irradiance keeps them).
TEST(EnvironmentRender, TheSpecularResidualTellsWhatTheConesMiss) {
  reference::Random random(29);
  for (int k = 0; k < 3; ++k) {
    Scene scene = ball_in(strips_map(random), metal(0.5f));
    const double split = EnvironmentLight(scene).specular_residual();
    Environment whole = *scene.environment;
    whole.irradiance = IrradianceCoefficients{};
    scene.environment = std::make_shared<const Environment>(std::move(whole));
    const double unsplit = EnvironmentLight(scene).specular_residual();
    std::printf("map %d: residual %.2f %%, with the strips in the rest %.2f %%\n", k, 100 * split, 100 * unsplit);
    EXPECT_LT(split, 0.04);
    EXPECT_GT(unsplit, 0.04);
  }
  EXPECT_LT(EnvironmentLight(ball_in(white_environment().map, metal(0.5f))).specular_residual(), 0.02);
}

// Tiles extend beyond the picture by whole blocks of pixels, where lights of the map cast shadows.
TEST(EnvironmentRender, PicturesOfAnySizeWithShadowsAreFinite) {
  const Scene scene = ball_in(room_map(), metal(0.3f));
  RenderOptions options;
  options.shadows = Shadows::on;
  for (const int height : {4, 13, 36, 45}) {
    options.width = 70;
    options.height = height;
    for (const Vec3f& p : render(scene, options).pixels) ASSERT_TRUE(is_finite(p) && p.x + p.y + p.z > 0) << height;
  }
}

TEST(EnvironmentRender, TheBackgroundIsTheMap) {
  const Scene scene = ball_in(smooth_map(128), white_diffuse());
  RenderOptions options;
  options.width = options.height = 48;
  const Picture picture = render(scene, options);
  const Vec3d corner = normalized(Vec3d{-0.99 * std::tan(0.275), 0.99 * std::tan(0.275), -1});
  const Vec3f seen = picture.at(0, 0), map = radiance_from(scene.environment->map, corner);
  EXPECT_NEAR(seen.x, map.x, 0.01);
  EXPECT_NEAR(seen.y, map.y, 0.01);
}

}  // namespace steradian::environment_test
