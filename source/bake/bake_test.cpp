// Light maps: furnaces and dark rooms against closed forms, seams, and broken charts.
#include "bake/bake.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "bake/samples.h"
#include "night.h"
#include "render/sampled/paths.h"
#include "steradian/error.h"
#include "steradian/polygon_light.h"
#include "support/boxes.h"

namespace steradian::bake_test {
namespace {

using namespace bake;
using scene::ball_mesh;
using scene::closed_box;
using scene::grey;
using scene::quad_mesh;

BakeOptions options_for(double texels, int bounces) {
  BakeOptions options;
  options.texels = texels;
  options.light.shadows = Shadows::on;
  options.light.quality = Quality::draft;
  options.light.bounces = bounces;
  return options;
}

LightMap baked(const Scene& scene, const BakeOptions& options, BakeStats* stats = nullptr) {
  Budget budget;
  return bake_map(scene, options, "scene", budget, stats);
}

Vec3d middle_of(const Scene& scene, const LightMap& map, const Chart& chart) {
  Vec3d sum{};
  double area = 0;
  const Mesh& mesh = scene.meshes[chart.mesh];
  for (const ChartTriangle& t : chart.triangles) {
    std::array<Vec3d, 3> p;
    for (std::size_t k = 0; k < 3; ++k) {
      if (map.cuts[chart.mesh].empty()) {
        p[k] = corner_of(mesh, t.triangle, k);
        continue;
      }
      const CutCorner& corner = map.cuts[chart.mesh][t.triangle][k];
      p[k] = {};
      for (std::size_t i = 0; i < 3; ++i) p[k] += corner_of(mesh, corner.triangle, i) * corner.weights[i];
    }
    const double a = length(cross(p[1] - p[0], p[2] - p[0]));
    sum += (p[0] + p[1] + p[2]) * (a / 3);
    area += a;
  }
  return sum / area;
}

double brightest_in(const LightMap& map, const Chart& chart) {
  double brightest = 0;
  for (int y = chart.y; y < chart.y + chart.height; ++y)
    for (int x = chart.x; x < chart.x + chart.width; ++x)
      brightest = std::max(brightest, static_cast<double>(map.irradiance[static_cast<std::size_t>(y * map.width + x)].x));
  return brightest;
}

// Shines down.
AreaLight square_lamp(Vec3d middle, double half, double radiance) {
  AreaLight lamp;
  Polygon square;
  square.vertices = {middle + Vec3d{-half, 0, -half}, middle + Vec3d{half, 0, -half}, middle + Vec3d{half, 0, half},
                     middle + Vec3d{-half, 0, half}};
  lamp.shape = square;
  lamp.radiance = {radiance, radiance, radiance};
  return lamp;
}

}  // namespace

// In a closed box whose sides shine with 1 and reflect r, the irradiance is pi / (1 - r) at every texel.
TEST(Bake, TheFurnaceIsConstantOverEveryTexel) {
  for (const float r : {0.0f, 0.5f, 0.8f}) {
    BakeOptions options = options_for(7.3, r > 0 ? kAllBounces : 0);
    options.light.shadows = Shadows::off;
    const LightMap map = baked(closed_box(r, true), options);
    ASSERT_EQ(map.charts.size(), 6u);
    double worst = 0;
    for (const Chart& chart : map.charts)
      for (int y = chart.y; y < chart.y + chart.height; ++y)
        for (int x = chart.x; x < chart.x + chart.width; ++x) {
          const Vec3f e = map.irradiance[static_cast<std::size_t>(y) * static_cast<std::size_t>(map.width) + static_cast<std::size_t>(x)];
          worst = std::max(worst, std::fabs(static_cast<double>(e.x) * (1 - static_cast<double>(r)) / std::numbers::pi - 1));
        }
    std::printf("albedo %.1f: off by at most %.1e over %d x %d texels\n", static_cast<double>(r), worst, map.width, map.height);
    // The bounces end at a change of 1e-4, of which a geometric series leaves r / (1 - r) more; single precision gives the rest.
    EXPECT_LT(worst, 1e-4 * static_cast<double>(r / (1 - r)) + 1e-5);
  }
}

// The same at every corner of the box, and of a ball in it.
TEST(Bake, TheFurnaceIsConstantAtEveryVertex) {
  Scene scene = closed_box(0.5f, true);
  BakeOptions options = options_for(5, kAllBounces);
  options.light.shadows = Shadows::off;
  options.target = BakeTarget::vertex;
  const LightMap light = baked(scene, options);
  EXPECT_EQ(light.width, 0);
  double worst = 0;
  ASSERT_EQ(light.corners.size(), 6u);
  for (const CornerLight& mesh : light.corners) {
    ASSERT_EQ(mesh.irradiance.size(), 6u);
    for (const Vec3f& e : mesh.irradiance) worst = std::max(worst, std::fabs(static_cast<double>(e.x) * 0.5 / std::numbers::pi - 1));
  }
  EXPECT_LT(worst, 2e-4);
}

// On a ball in the light of a far lamp the linear fit is nearest to the cosine, and vertices of one place have one value.
TEST(Bake, VerticesOfABallFollowTheCosine) {
  Scene scene;
  scene.materials = {grey(0.5f)};
  scene.meshes = {ball_mesh({0, 0, 0}, 1, 0, 48, 24)};
  PunctualLight sun;
  sun.kind = PunctualKind::directional;
  sun.direction = {0, -1, 0};
  scene.punctual_lights = {sun};
  scene.cameras = {Camera{}};
  BakeOptions options = options_for(16, 0);
  options.target = BakeTarget::vertex;
  const LightMap light = baked(scene, options);
  const Mesh& mesh = scene.meshes[0];
  double worst = 0;
  for (std::size_t i = 0; i < mesh.indices.size(); ++i) {
    if (light.corners[0].irradiance[i] == Vec3f{}) continue;
    const double truth = std::max(static_cast<double>(mesh.normals[mesh.indices[i]].y), 0.0);
    worst = std::max(worst, std::fabs(static_cast<double>(light.corners[0].irradiance[i].x) - truth));
  }
  std::printf("off by at most %.4f\n", worst);
  // Linear functions over steps of pi / 24 are within step^2 / 8 of a cosine; at its end the slope jumps by 1, which costs up to step / 4.
  EXPECT_LT(worst, std::numbers::pi / 24 / 4);
}

// The samples of a chart stand for its whole area, whatever its triangles.
TEST(BakeSamples, StandForTheArea) {
  Scene scene;
  scene.materials = {grey(0.5f)};
  scene.meshes = {quad_mesh({0, 0, 0}, {3, 0, 0}, {3, 1.3f, 0}, {0, 1.3f, 0}, 0), ball_mesh({0, 2, 0}, 0.5f, 0, 24, 12)};
  scene.area_lights = {square_lamp({0, 5, 0}, 1, 1)};
  scene.cameras = {Camera{}};
  const LightMap map = baked(scene, options_for(9, 0));
  double area = 0, truth = 0;
  for (const Chart& chart : map.charts) {
    for (const SampleBlock& block : samples_of(chart, scene.meshes[chart.mesh]))
      for (const Sample& s : block) area += s.area;
    for (const ChartTriangle& t : chart.triangles) truth += length(across(scene.meshes[chart.mesh], t.triangle)) / 2;
  }
  std::printf("%zu charts, %.6f of %.6f m^2\n", map.charts.size(), area, truth);
  // Slivers below a hundredth of a cell are left out.
  EXPECT_NEAR(area / truth, 1, 2e-3);
}

// A ball in the light of a lamp. Two bilinear fits of one smooth light differ by at most the errors of both. Each is within h^2 / 4 of the
// light's second derivative along an axis, for texels of side h. Texels at the same places of an edge can agree far better: a
// ten-thousandth is a fortieth of a step of eight bits.
TEST(Bake, SeamsOfABallClose) {
  Scene scene;
  scene.materials = {grey(0.5f)};
  scene.meshes = {ball_mesh({0, 0, 0}, 1, 0, 48, 24)};
  scene.area_lights = {square_lamp({0, 3, 0}, 1.5, 5)};
  scene.cameras = {Camera{}};
  const PreparedPolygon lamp = prepare_polygon(flat_polygon(scene.area_lights[0]));
  double bend = 0;
  constexpr double kStep = 1e-2;
  const auto light = [&](double angle) {
    const Vec3d n{std::sin(angle), std::cos(angle), 0};
    return 5 * polygon_irradiance(lamp, n, n);
  };
  for (double angle = 0; angle < 2; angle += kStep)
    bend = std::max(bend, std::fabs(light(angle + kStep) - 2 * light(angle) + light(angle - kStep)) / (kStep * kStep));
  for (const double texels : {16.0, 32.0, 64.0}) {
    BakeStats stats;
    const LightMap map = baked(scene, options_for(texels, 0), &stats);
    ASSERT_GT(stats.seams, 20u);
    const double bound = 2 * bend / (4 * texels * texels) / stats.mean;
    std::printf("%.0f texels a metre: %zu charts, %zu seams, at most %.2e of the mean apart (%.2e), residual %.2e\n", texels, stats.charts,
                stats.seams, stats.largest_seam, bound, stats.rms_residual);
    EXPECT_LT(stats.largest_seam, std::min(bound, 1e-4));
  }
}

// Two rooms with one floor, walls and ceiling, parted by a wall of a fifth of a texel that stands on the floor, and a lamp in one of them.
// No light enters the other.
TEST(Bake, NoLightLeaksBelowAThinWall) {
  for (const double gap : {0.0, 1e-7, -1e-3})
    for (const int bounces : {0, 2}) {
      Scene scene;
      scene.materials = {grey(0.5f)};
      const auto add_box = [&](Vec3d low, Vec3d high, bool inside) {
        const auto quad = [&](Vec3d a, Vec3d b, Vec3d c, Vec3d d) {
          const auto f = [](Vec3d p) { return static_cast<Vec3f>(p); };
          scene.meshes.push_back(inside ? quad_mesh(f(d), f(c), f(b), f(a), 0) : quad_mesh(f(a), f(b), f(c), f(d), 0));
        };
        const Vec3d l = low, h = high;
        quad({l.x, l.y, h.z}, {h.x, l.y, h.z}, {h.x, h.y, h.z}, {l.x, h.y, h.z});
        quad({h.x, l.y, l.z}, {l.x, l.y, l.z}, {l.x, h.y, l.z}, {h.x, h.y, l.z});
        quad({h.x, l.y, h.z}, {h.x, l.y, l.z}, {h.x, h.y, l.z}, {h.x, h.y, h.z});
        quad({l.x, l.y, l.z}, {l.x, l.y, h.z}, {l.x, h.y, h.z}, {l.x, h.y, l.z});
        quad({l.x, h.y, h.z}, {h.x, h.y, h.z}, {h.x, h.y, l.z}, {l.x, h.y, l.z});
        quad({l.x, l.y, l.z}, {h.x, l.y, l.z}, {h.x, l.y, h.z}, {l.x, l.y, h.z});
      };
      const double thick = 0.2 / 8;
      add_box({-2, 0, -1}, {2, 2, 1}, true);
      add_box({0.3, gap, -1 + gap}, {0.3 + thick, 2 - gap, 1 - gap}, false);
      scene.area_lights = {square_lamp({-1, 1.9, 0}, 0.3, 10)};
      scene.cameras = {Camera{}};
      BakeStats stats;
      const LightMap map = baked(scene, options_for(8, bounces), &stats);
      EXPECT_GE(stats.cut, 4u);
      std::size_t lit = 0, dark = 0;
      for (const Chart& chart : map.charts) {
        const double x = middle_of(scene, map, chart).x, brightest = brightest_in(map, chart);
        if (x > 0.3 + 0.9 * thick) {
          EXPECT_EQ(brightest, 0) << "x " << x;
          ++dark;
        } else if (x < 0.3 - 1e-6) {
          EXPECT_TRUE(brightest > 0 || bounces == 0) << "x " << x;  // the ceiling above the lamp is dark without bounces
          ++lit;
        }
      }
      std::printf("gap %g, %d bounces: %zu planes cut, %zu charts lit, %zu dark\n", gap, bounces, stats.cut, lit, dark);
      EXPECT_EQ(lit, 5u);
      EXPECT_GE(dark, 6u);  // a wall that reaches into the others has more
    }
}

// A screen of a fifth of a texel stands in a room and leaves a way around it, with a lamp on one side: texels beside it show the light of
// their own side, and the floor has no step where nothing stands.
TEST(Bake, AScreenPartsTheTexelsOfItsFloor) {
  Scene scene = closed_box(0.5f, false);
  const float thick = 0.2f / 8;
  const auto wall = [&](Vec3f a, Vec3f b, Vec3f c, Vec3f d) { scene.meshes.push_back(quad_mesh(a, b, c, d, 0)); };
  wall({0.1f, -1, -1}, {0.1f, -1, 0.3f}, {0.1f, 0.4f, 0.3f}, {0.1f, 0.4f, -1});
  std::reverse(scene.meshes.back().indices.begin(), scene.meshes.back().indices.end());
  for (Vec3f& n : scene.meshes.back().normals) n = {1, 0, 0};
  wall({0.1f - thick, -1, -1}, {0.1f - thick, -1, 0.3f}, {0.1f - thick, 0.4f, 0.3f}, {0.1f - thick, 0.4f, -1});
  wall({0.1f - thick, -1, 0.3f}, {0.1f, -1, 0.3f}, {0.1f, 0.4f, 0.3f}, {0.1f - thick, 0.4f, 0.3f});
  wall({0.1f - thick, 0.4f, 0.3f}, {0.1f, 0.4f, 0.3f}, {0.1f, 0.4f, -1}, {0.1f - thick, 0.4f, -1});
  for (std::size_t m = 6; m < scene.meshes.size(); ++m) {
    const Vec3f outside = static_cast<Vec3f>(normalized(across(scene.meshes[m], 0)));
    for (Vec3f& n : scene.meshes[m].normals) n = outside;
  }
  scene.area_lights = {square_lamp({-0.7, -0.3, -0.5}, 0.1, 10)};
  BakeStats stats;
  const LightMap map = baked(scene, options_for(8, 0), &stats);
  EXPECT_GE(stats.cut, 1u);
  EXPECT_GE(stats.seams, 1u);
  std::printf("%zu planes cut, %zu charts, %zu seams at most %.1e apart, residual %.1e\n", stats.cut, stats.charts, stats.seams,
              stats.largest_seam, stats.rms_residual);
  // The floor behind the screen is dark but for what passes around it: no texel there takes light through the wall.
  double behind = 0, before = 0;
  for (const Chart& chart : map.charts) {
    const Vec3d middle = middle_of(scene, map, chart);
    if (chart.is_covered || middle.y > -0.999) continue;
    (middle.x > 0.1 ? behind : before) = std::max(middle.x > 0.1 ? behind : before, brightest_in(map, chart));
  }
  EXPECT_GT(before, 0);
  EXPECT_LT(behind, 0.2 * before);
}

// Texels against paths at the same places, in a room with a shelf and a ball.
TEST(Bake, ARoomAgreesWithPaths) {
  Scene scene = closed_box(0.6f, false);
  scene.meshes.push_back(quad_mesh({-0.3f, -0.2f, 0.1f}, {0.3f, -0.2f, 0.1f}, {0.3f, -0.2f, -0.4f}, {-0.3f, -0.2f, -0.4f}, 0));
  scene.meshes.push_back(ball_mesh({0.4f, -0.7f, 0.1f}, 0.3f, 0, 32, 16));
  scene.area_lights = {square_lamp({0, 0.98, 0}, 0.3, 10)};
  BakeOptions options = options_for(16, kAllBounces);
  options.light.quality = Quality::normal;
  BakeStats stats;
  const LightMap map = baked(scene, options, &stats);
  ASSERT_EQ(stats.cut, 0u);
  const RayScene rays(scene);
  DirectSampler sampler(scene, &rays, nullptr, Terminator::strict);
  reference::Random random(3);
  const int paths = test::by_day_or_night(512, 16384);
  double squares = 0, noise = 0, error = 0, sum = 0, shown = 0;
  std::size_t count = 0;
  for (const Chart& chart : map.charts) {
    const Mesh& mesh = scene.meshes[chart.mesh];
    const std::vector<SampleBlock> blocks = samples_of(chart, mesh);
    for (std::size_t b = 0; b < blocks.size(); b += 40)
      for (const std::size_t i : {5u, 10u}) {
        const Sample& sample = blocks[b][i];
        if (!(sample.area > 0)) continue;
        const Vec3f normal = static_cast<Vec3f>(normalized(across(mesh, sample.triangle)));
        Surface s = surface_at(scene, mesh, sample.triangle, sample.u, sample.v, normal);
        s.albedo = {1, 1, 1};
        Estimate e = sampler.estimate(s, normal, LobeChoice::all, paths, random);
        e += trace_paths({scene, rays, sampler}, s, normal, kAllBounces, paths, random);
        const double truth = std::numbers::pi * e.mean.x, ours = shown_at(map.irradiance, map.width, sample.at).x;
        squares += (ours - truth) * (ours - truth);
        noise += std::numbers::pi * std::numbers::pi * e.variance.x;
        sum += truth;
        shown += ours;
        error += std::pow(shown_at(map.error, map.width, sample.at).x, 2);
        ++count;
      }
  }
  const auto n = static_cast<double>(count);
  const double mean = sum / n, rms = std::sqrt(std::max(squares - noise, 0.0) / n) / mean;
  std::printf("%zu places: off by %.2f %% rms of the mean, texels say %.2f %%, noise of the paths %.2f %%, ratio of the means %.4f\n",
              count, 100 * rms, 100 * std::sqrt(error / n) / mean, 100 * std::sqrt(noise / n) / mean, shown / sum);
  // 2 % as pictures of such rooms (Radiosity.RoomsAgreeWithPaths), and three standard errors of the noise's own sum, which is about that of
  // squares of normal numbers.
  EXPECT_LT(squares - noise, n * std::pow(0.02 * mean, 2) + 3 * noise * std::sqrt(2 / n));
  EXPECT_NEAR(shown / sum, 1, 0.005 + 3 * std::sqrt(noise) / sum);
}

// A mesh of two triangles whose second texture coordinates are wrong in some way is refused by its name.
TEST(Bake, RefusesBrokenCharts) {
  // copies: of the sheet, side by side, all with the same coordinates
  const auto message = [](const std::vector<Vec2f>& uv, int copies = 1) {
    Scene scene;
    scene.materials = {grey(0.5f)};
    Mesh sheet;
    sheet.name = "sheet";
    for (int copy = 0; copy < copies; ++copy) {
      const float x = 2 * static_cast<float>(copy);
      const Mesh quad = quad_mesh({x, 0, 0}, {x + 1, 0, 0}, {x + 1, 1, 0}, {x, 1, 0}, 0);
      for (const std::uint32_t i : quad.indices) sheet.indices.push_back(i + static_cast<std::uint32_t>(sheet.positions.size()));
      sheet.positions.insert(sheet.positions.end(), quad.positions.begin(), quad.positions.end());
      sheet.normals.insert(sheet.normals.end(), quad.normals.begin(), quad.normals.end());
      sheet.texcoords[1].insert(sheet.texcoords[1].end(), uv.begin(), uv.end());
    }
    scene.meshes = {sheet};
    scene.area_lights = {square_lamp({0, 5, 0}, 1, 1)};
    scene.cameras = {Camera{}};
    try {
      baked(scene, options_for(4, 0));
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_EQ(message({{0, 0}, {1, 0}, {1, 1}, {0, 1}}), "");
  EXPECT_EQ(message({{0, 0}, {0, 1}, {1, 1}, {1, 0}}), "") << "mirrored as a whole";
  EXPECT_NE(message({{0, 0}, {1, 0}, {1, 1}, {0, 1}}, 2).find("\"sheet\""), std::string::npos) << "two charts at one place";
  for (const auto& [uv, words] : {std::pair<std::vector<Vec2f>, const char*>{{{0, 0}, {1, 0}, {1, 1}, {1, 0.5f}}, "flipped"},
                                  {{{0, 0}, {1, 0}, {0, 0}, {0, 1}}, "no area"},
                                  {{{0, 0}, {1, 0}, {2, 0}, {0, 1}}, "no area"}}) {
    const std::string text = message(uv);
    std::printf("%s\n", text.c_str());
    EXPECT_NE(text.find(words), std::string::npos) << text;
    EXPECT_NE(text.find("\"sheet\""), std::string::npos) << text;
  }
}

// A winding stair seen from above overlaps itself: its triangles become two charts. Given such a chart, the mesh is refused.
TEST(Bake, ChartsNeverOverlapThemselves) {
  Scene scene;
  scene.materials = {grey(0.5f)};
  Mesh stair;
  stair.name = "stair";
  constexpr int kSteps = 48;  // two turns
  for (int k = 0; k <= kSteps; ++k) {
    const double angle = 4 * std::numbers::pi * k / kSteps;
    for (const double r : {0.5, 1.5}) {
      stair.positions.push_back(static_cast<Vec3f>(Vec3d{r * std::cos(angle), 0.02 * k, -r * std::sin(angle)}));
      stair.normals.push_back({0, 1, 0});
      stair.texcoords[1].push_back({stair.positions.back().x, stair.positions.back().z});
    }
  }
  for (std::uint32_t k = 0; k < kSteps; ++k)
    for (const std::uint32_t i : {0u, 1u, 3u, 0u, 3u, 2u}) stair.indices.push_back(2 * k + i);
  scene.meshes = {stair};
  scene.area_lights = {square_lamp({0, 5, 0}, 1, 1)};
  scene.cameras = {Camera{}};
  try {
    baked(scene, options_for(8, 0));
    FAIL() << "the chart that overlaps itself was taken";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("overlaps"), std::string::npos) << error.what();
  }
  scene.meshes[0].texcoords[1].clear();
  const LightMap map = baked(scene, options_for(8, 0));
  EXPECT_GE(map.charts.size(), 2u);
  EXPECT_LE(map.charts.size(), 6u);
}

// Hills of many small triangles with flat normals: folds are no contacts, and every triangle has its light. The mesh is named.
TEST(Bake, FoldsAreNoContacts) {
  Scene scene;
  scene.materials = {grey(0.5f)};
  Mesh hills;
  hills.name = "hills";
  reference::Random random(2);
  constexpr std::uint32_t kSide = 80;
  std::vector<Vec3f> points;
  for (std::uint32_t i = 0; i <= kSide; ++i)
    for (std::uint32_t k = 0; k <= kSide; ++k)
      points.push_back({0.02f * static_cast<float>(i), static_cast<float>(random.uniform(0, 0.01)), -0.02f * static_cast<float>(k)});
  for (std::uint32_t i = 0; i < kSide; ++i)
    for (std::uint32_t k = 0; k < kSide; ++k) {
      const std::uint32_t a = i * (kSide + 1) + k, b = a + kSide + 1;
      for (const std::array<std::uint32_t, 3> t : {std::array{a, b, b + 1}, std::array{a, b + 1, a + 1}}) {
        const Vec3f normal = normalized(cross(points[t[1]] - points[t[0]], points[t[2]] - points[t[0]]));
        for (const std::uint32_t v : t) {
          hills.indices.push_back(static_cast<std::uint32_t>(hills.positions.size()));
          hills.positions.push_back(points[v]);
          hills.normals.push_back(normal);
        }
      }
    }
  scene.meshes = {hills};
  PunctualLight sun;
  sun.kind = PunctualKind::directional;
  sun.direction = {0, -1, 0};
  scene.punctual_lights = {sun};
  scene.cameras = {Camera{}};
  BakeStats stats;
  const LightMap map = baked(scene, options_for(4, 0), &stats);
  EXPECT_EQ(stats.cut, 0u);
  EXPECT_GT(stats.mean, 0.8);  // the triangles are tilted by up to 35 degrees
  for (const Chart& chart : map.charts) {
    EXPECT_FALSE(chart.is_covered);
    EXPECT_GT(brightest_in(map, chart), 0.7);
  }
  ASSERT_EQ(map.warnings.size(), 1u);
  EXPECT_NE(map.warnings[0].find("\"hills\" has 12800 triangles"), std::string::npos) << map.warnings[0];
}

// The same bytes at any number of threads.
TEST(Bake, ThreadsDoNotMatter) {
  Scene scene = closed_box(0.5f, false);
  scene.meshes.push_back(ball_mesh({0, -0.5f, 0}, 0.4f, 0, 24, 12));
  scene.area_lights = {square_lamp({0, 0.9, 0}, 0.3, 10)};
  BakeOptions options = options_for(12, 2);
  options.light.threads = 1;
  const LightMap one = baked(scene, options);
  options.light.threads = 3;
  const LightMap other = baked(scene, options);
  EXPECT_EQ(one.irradiance, other.irradiance);
  EXPECT_EQ(one.error, other.error);
}

}  // namespace steradian::bake_test
