// All light: furnaces and leaks against closed forms, and rooms against paths.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/random.h"
#include "night.h"
#include "paths.h"
#include "render/radiosity/patches.h"
#include "steradian/area_light.h"
#include "steradian/compare.h"
#include "steradian/load_scene.h"
#include "steradian/render.h"
#include "support/boxes.h"

namespace steradian::radiosity_test {
namespace {

using namespace scene;

RenderOptions options_for(int side, int bounces) {
  RenderOptions options;
  options.width = options.height = side;
  options.shadows = Shadows::on;
  options.quality = Quality::draft;
  options.bounces = bounces;
  return options;
}

double mean_luminance(const Picture& picture) {
  double sum = 0;
  for (const Vec3f& p : picture.pixels) sum += luminance(static_cast<Vec3d>(p));
  return sum / static_cast<double>(picture.pixels.size());
}

// Root of the mean square of the difference from paths without their noise, over the mean of the paths. share: part of the mean of the
// channels' variances that the variance of the luminance has at least.
double error_beyond_noise(const Picture& ours, const Picture& paths, double share) {
  double squares = 0, noise = 0;
  for (std::size_t i = 0; i < paths.pixels.size(); ++i) {
    squares += std::pow(luminance(static_cast<Vec3d>(ours.pixels[i]) - static_cast<Vec3d>(paths.pixels[i])), 2);
    noise += share * luminance(static_cast<Vec3d>(paths.layers.at("variance")[i]));
  }
  return std::sqrt(std::max(squares - noise, 0.0) / static_cast<double>(paths.pixels.size())) / mean_luminance(paths);
}

}  // namespace

// Every place of a triangle belongs to one patch, and the middle of a patch to that patch.
TEST(Patches, MiddlesLieInTheirPatches) {
  Scene scene;
  scene.materials = {grey(0.5f)};
  scene.meshes = {quad_mesh({0, 0, 0}, {3, 0, 0}, {3, 1, 0}, {0, 1, 0}, 0), ball_mesh({0, 2, 0}, 0.3f, 0, 12, 6)};
  const radiosity::Patches patches(scene, 500);
  EXPECT_GT(patches.side_count(), 400u);
  EXPECT_LE(patches.side_count(), 2u * 500u);
  for (std::uint32_t side = 0; side < patches.side_count(); ++side) {
    const auto& site = patches.site(side);
    EXPECT_EQ(patches.place_at(site.mesh, site.triangle, site.u, site.v, radiosity::Patches::is_front(side)).side, side);
  }
  // Corners and edges, with the roundings of a ray.
  for (const float u : {-1e-7f, 0.0f, 0.5f, 1.0f, 1.0000001f})
    for (const float v : {-1e-7f, 0.0f, 0.5f, 1.0f, 1.0000001f})
      EXPECT_LT(patches.place_at(0, 0, u, std::min(v, 1 - u), true).side, patches.side_count());
}

// A preview differs from the picture by no more than the estimates of both say.
TEST(Radiosity, APreviewIsWithinItsEstimate) {
  const Scene scene = load_scene(test::kSourceDir + "/scenes/cornell.glb").scene;
  RenderOptions options = options_for(72, kAllBounces);
  RenderStats stats, stats_of_preview;
  const Picture whole = render(scene, options, &stats);
  options.bounce_preview = true;
  const Picture preview = render(scene, options, &stats_of_preview);
  double squares = 0;
  for (std::size_t i = 0; i < whole.pixels.size(); ++i)
    squares += std::pow(luminance(static_cast<Vec3d>(preview.pixels[i]) - static_cast<Vec3d>(whole.pixels[i])), 2);
  const double error = std::sqrt(squares / static_cast<double>(whole.pixels.size())) / mean_luminance(whole);
  std::printf("error %.2f %%, estimates %.2f and %.2f %%\n", 100 * error, 100 * stats_of_preview.bounce_error, 100 * stats.bounce_error);
  EXPECT_LT(error, stats_of_preview.bounce_error + stats.bounce_error);
}

// In a closed box whose sides shine with 1 and reflect r, the reflected radiance is r + r^2 + ... : every mean is one of equal values, so
// only roundings and the end of the iterations are left.
TEST(Radiosity, TheFurnaceIsTheGeometricSeries) {
  for (const float r : {0.3f, 0.8f})
    for (const int bounces : {1, 2, 5, kAllBounces}) {
      double truth = 0, power = 1;
      for (int k = 0; k <= (bounces == kAllBounces ? 400 : bounces); ++k) truth += power *= static_cast<double>(r);
      RenderOptions options = options_for(16, bounces);
      options.shadows = Shadows::off;
      double worst = 0;
      const Picture picture = render(closed_box(r, true), options);
      for (std::size_t i = 0; i < picture.pixels.size(); ++i) {
        const double off = std::fabs(static_cast<double>(picture.pixels[i].x) - truth);
        worst = std::max(worst, off / truth);
        EXPECT_LE(off, static_cast<double>(picture.layers.at("bounce_bound")[i].x) + 1e-5 * truth);
      }
      std::printf("albedo %.1f, %d bounces: %.6f, off by at most %.1e\n", static_cast<double>(r), bounces, truth, worst);
      EXPECT_LT(worst, bounces == kAllBounces ? 1.1e-4 : 1e-5);  // the iterations leave out at most 1e-4
    }
}

// Walls that reflect all light keep it: the iterations end, at finite values and without a bound.
TEST(Radiosity, WhiteRoomsHaveNoBound) {
  RenderStats stats;
  for (const Vec3f& p : render(closed_box(1, true), options_for(4, kAllBounces), &stats).pixels) EXPECT_TRUE(is_finite(p));
  EXPECT_LT(stats.bounce_left_out, 0);
}

// Light that goes to and fro between a floor and a ceiling comes back to each in every second bounce: their reflectance bounds it.
TEST(Radiosity, LightToAndFroHasABound) {
  Scene scene;
  scene.materials = {grey(0.5f)};
  scene.meshes = {quad_mesh({-1, 0, 1}, {1, 0, 1}, {1, 0, -1}, {-1, 0, -1}, 0),
                  quad_mesh({-1, 1, -1}, {1, 1, -1}, {1, 1, 1}, {-1, 1, 1}, 0)};
  AreaLight lamp;
  Polygon square;
  square.vertices = {{-0.2, 0.9, -0.2}, {0.2, 0.9, -0.2}, {0.2, 0.9, 0.2}, {-0.2, 0.9, 0.2}};
  lamp.shape = square;
  lamp.radiance = {10, 10, 10};
  scene.area_lights = {lamp};
  scene.cameras = {camera_at({0, 0.5, 3}, {0, 0, -1}, 0.8)};
  RenderStats stats;
  const Picture picture = render(scene, options_for(8, kAllBounces), &stats);
  EXPECT_GE(stats.bounce_left_out, 0);
  EXPECT_LE(stats.bounce_left_out, 1e-3);  // 1e-4 of the largest radiance, which is below 10
  EXPECT_GT(mean_luminance(picture), 0);
}

// A closed box in the light of a lamp outside, whatever its walls reflect.
TEST(Radiosity, NoLightEntersAClosedBox) {
  Scene scene = closed_box(0.7f, false);
  AreaLight lamp;
  lamp.shape = Ellipsoid{{0, 3, 0}, {0.5, 0, 0}, {0, 0.5, 0}, {0, 0, 0.5}};
  lamp.radiance = {100, 100, 100};
  scene.area_lights = {lamp};
  for (const Vec3f& p : render(scene, options_for(16, kAllBounces)).pixels) EXPECT_EQ(p, (Vec3f{}));
}

// A wall stands across the floor, whose patches are large. The light of one half does not enter the other through them.
TEST(Radiosity, NoLightPassesUnderAWall) {
  Scene scene = closed_box(0.7f, false);
  scene.meshes.push_back(quad_mesh({0.13f, -1, -1}, {0.13f, -1, 1}, {0.13f, 1, 1}, {0.13f, 1, -1}, 0));
  AreaLight lamp;
  lamp.shape = Ellipsoid{{-0.4, 0, 0}, {0.2, 0, 0}, {0, 0.2, 0}, {0, 0, 0.2}};
  lamp.radiance = {100, 100, 100};
  scene.area_lights = {lamp};
  scene.cameras = {camera_at({0.9, 0.3, 0.6}, {-1, -0.5, -0.9}, 1.2)};
  for (const Vec3f& p : render(scene, options_for(32, kAllBounces)).pixels) EXPECT_EQ(p, (Vec3f{}));
}

// Two mirrors face each other before a shining wall. The last one shows the patches: each further reflection changes less.
TEST(Radiosity, MirrorsShowMirrorsToTheirDepth) {
  Scene scene = closed_box(0.5f, false);
  SurfaceMaterial mirror = grey(1);
  mirror.metallic = 1;
  mirror.roughness = 0.02f;
  scene.materials.push_back(mirror);
  scene.meshes[0].material = scene.meshes[1].material = 1;  // the sides -x and +x
  AreaLight lamp;
  Polygon square;
  square.vertices = {{-0.4, 0.99, -0.4}, {0.4, 0.99, -0.4}, {0.4, 0.99, 0.4}, {-0.4, 0.99, 0.4}};
  lamp.shape = square;
  lamp.radiance = {10, 10, 10};
  scene.area_lights = {lamp};
  scene.cameras = {camera_at({-0.9, -0.2, 0.5}, {1, -0.1, -0.3}, 1)};
  std::vector<double> means;
  for (const int reflections : {0, 1, 2, 3, 8}) {
    RenderOptions options = options_for(32, kAllBounces);
    options.reflections = reflections;
    const Picture picture = render(scene, options);
    for (const Vec3f& p : picture.pixels) ASSERT_TRUE(is_finite(p));
    means.push_back(mean_luminance(picture));
    std::printf("%d reflections: mean %.4f\n", reflections, means.back());
  }
  const double all = means.back();
  for (std::size_t i = 0; i + 1 < means.size(); ++i) {
    const double off = std::fabs(means[i] - all), before = i > 0 ? std::fabs(means[i - 1] - all) : 0.1 * all;
    EXPECT_LT(off, before) << i;
  }
}

// A box whose sides shine, each of which sees a fifth of each other one. Five reflect half, and one all: its irradiance is 1 + 5/2 f E for
// f = 1/5, and that of the others E = 1 + 4/2 f E + f (1 + E / 2) = 2.4, where the lamps give 1. So it sends 2.2 of 2.2 + 2.5 x 2.4.
TEST(Radiosity, TellsTheLightOfGlossySurfaces) {
  Scene scene = closed_box(0.5f, true);
  RenderStats stats;
  render(scene, options_for(8, kAllBounces), &stats);
  EXPECT_EQ(stats.bounce_glossy, 0);
  SurfaceMaterial metal = grey(1);
  metal.metallic = 1;
  scene.materials.push_back(metal);
  scene.meshes[0].material = 1;
  scene.multiple_scattering = true;
  render(scene, options_for(8, kAllBounces), &stats);
  EXPECT_NEAR(stats.bounce_glossy, 2.2 / 8.2, 0.003);
  EXPECT_GT(stats.bounce_glossy_evenly, 0);
  EXPECT_LT(stats.bounce_glossy_evenly, stats.bounce_glossy);
}

// The same bytes at any number of threads.
TEST(Radiosity, ThreadsDoNotMatter) {
  const Scene scene = load_scene(test::kSourceDir + "/scenes/room.glb").scene;
  RenderOptions options = options_for(40, 2);
  options.threads = 1;
  const Picture one = render(scene, options);
  options.threads = 3;
  EXPECT_EQ(one.pixels, render(scene, options).pixels);
}

// Lit rooms with a shelf and a ball, which is a mirror in every second room, against paths.
TEST(Radiosity, RoomsAgreeWithPaths) {
  reference::Random random(5);
  const int rooms = test::by_day_or_night(1, 20);
  double worst = 0;
  for (int k = 0; k < rooms; ++k) {
    Scene scene = closed_box(static_cast<float>(random.uniform(0.4, 0.8)), false);
    SurfaceMaterial coloured = grey(0.6f);
    coloured.base_color = {0.8f, static_cast<float>(random.uniform(0.1, 0.8)), 0.2f, 1};
    scene.materials.push_back(coloured);
    scene.meshes[static_cast<std::size_t>(random.uniform() * 5)].material = 1;
    const auto x = static_cast<float>(random.uniform(-0.6, 0.2)), z = static_cast<float>(random.uniform(-0.8, 0)),
               h = static_cast<float>(random.uniform(-0.7, 0.3));
    scene.meshes.push_back(quad_mesh({x, h, z + 0.4f}, {x + 0.4f, h, z + 0.4f}, {x + 0.4f, h, z}, {x, h, z}, 1));
    SurfaceMaterial mirror = grey(0.9f);
    mirror.metallic = 1;
    mirror.roughness = 0.1f;
    scene.materials.push_back(mirror);
    scene.meshes.push_back(ball_mesh({0.3f, -0.7f, 0.1f}, 0.3f, k % 2 == 0 ? 2 : 0, 32, 16));
    AreaLight lamp;
    Polygon square;
    square.vertices = {{-0.2, 0.98, -0.2}, {0.3, 0.98, -0.2}, {0.3, 0.98, 0.3}, {-0.2, 0.98, 0.3}};
    lamp.shape = square;
    lamp.radiance = {10, 10, 10};
    scene.area_lights = {lamp};
    RenderOptions options = options_for(16, kAllBounces);
    options.quality = Quality::normal;
    RenderStats stats;
    const Picture picture = render(scene, options, &stats);
    options.method = "reference";
    options.target_error = 0.015;
    const Picture paths = render(scene, options);
    const double error = error_beyond_noise(picture, paths, 0.5), ratio = mean_luminance(picture) / mean_luminance(paths);
    std::printf("room %d: error %.2f %%, estimated %.2f %%, mean ratio %.4f\n", k, 100 * error, 100 * stats.bounce_error, ratio);
    worst = std::max(worst, error);
    // Half of the reference's noise of 1.5 % is left in the difference, and patches are 1 % of their room's side. A mirror of roughness 0.1
    // spreads light by some degrees, and its image here is sharp: 1 % more.
    EXPECT_LT(error, k % 2 == 0 ? 0.03 : 0.02) << k;
    // 16 x 16 pixels of 1.5 % noise each, and patches of a 40,000th of the room.
    EXPECT_NEAR(ratio, 1, 0.005) << k;
  }
  std::printf("%d rooms: worst %.2f %%\n", rooms, 100 * worst);
}

// However many small triangles a scene has, its walls are cut.
TEST(Radiosity, CutsLargeTrianglesBesideManySmallOnes) {
  Scene scene = closed_box(0.5f, false);
  for (int k = 0; k < 20; ++k) scene.meshes.push_back(ball_mesh({0, 0, 0}, 0.1f, 0, 48, 24));
  const radiosity::Patches patches(scene, 20'000);
  EXPECT_GT(patches.side_count() / 2, scene.triangle_count() + 5'000);
  EXPECT_LT(patches.side_count() / 2, scene.triangle_count() + 12'000);
  for (std::uint32_t side = 0; side < 24; side += 2) EXPECT_LT(patches.site(side).step, 0.1f) << "the first patches are those of a wall";
  // The sixteen places of a patch lie in it, and their mean is its middle.
  for (std::uint32_t side = 0; side < 2000; side += 2) {
    const radiosity::Patches::Site middle = patches.site(side);
    float u = 0, v = 0;
    for (std::uint32_t k = 0; k < radiosity::kPatchParts; ++k) {
      const radiosity::Patches::Site at = patches.site(radiosity::PatchPlace{side, k});
      const radiosity::PatchPlace place = patches.place_at(at.mesh, at.triangle, at.u, at.v, true);
      EXPECT_EQ(place.side, side) << k;
      EXPECT_EQ(place.part, k);
      u += at.u / 16;
      v += at.v / 16;
    }
    EXPECT_NEAR(u, middle.u, 1e-6f);
    EXPECT_NEAR(v, middle.v, 1e-6f);
  }
  // A group begins with a side of its own, on the same triangle.
  for (std::uint32_t side = 0; side < 2000; ++side) {
    const std::uint32_t group = patches.group_of(side);
    EXPECT_EQ(patches.group_of(group), group);
    EXPECT_EQ(group % 2, side % 2);
    EXPECT_EQ(patches.site(group).triangle, patches.site(side).triangle);
  }
}

// A beam meets brass, which sends it on to one part of the walls.
TEST(Radiosity, GlossySurfacesSendLightInItsDirection) {
  Scene scene = closed_box(0.5f, false);
  SurfaceMaterial brass = grey(0.8f);
  brass.metallic = 1;
  brass.roughness = 0.45f;
  scene.materials.push_back(brass);
  scene.meshes.push_back(quad_mesh({-0.5f, -0.9f, 0.5f}, {0.5f, -0.9f, 0.5f}, {0.5f, -0.9f, -0.5f}, {-0.5f, -0.9f, -0.5f}, 1));
  PunctualLight beam;
  beam.kind = PunctualKind::spot;
  beam.position = {0.7, 0.3, 0.1};
  beam.direction = normalized(Vec3d{-0.7, -1.2, -0.1});
  beam.intensity = {1, 1, 1};
  beam.cos_inner = std::cos(0.2);
  beam.cos_outer = std::cos(0.25);
  scene.punctual_lights = {beam};
  scene.cameras = {camera_at({0.9, -0.3, 0.6}, {-1, 0.3, -0.2}, 1)};
  RenderOptions options = options_for(24, kAllBounces);
  const Picture ours = render(scene, options);
  options.method = "sampled";
  options.spp = 2048;
  const Picture paths = render(scene, options);
  const double error = error_beyond_noise(ours, paths, 1), ratio = mean_luminance(ours) / mean_luminance(paths);
  std::printf("error %.2f %%, mean ratio %.4f\n", 100 * error, ratio);
  // The lit spot is ten patches wide, and its border crosses a third of its patches: a tenth of their light may lie beside its place. The
  // mean of the paths has a standard error of 0.6 %, and the border of the spot changes its light by less than 2 %.
  EXPECT_LT(error, 0.1);  // 0.5 where brass sends light on evenly
  EXPECT_NEAR(ratio, 1, 0.02);
}

// A metal panel sees a lit spot of a wall. Another metal shows the panel, in whose lobe the bounced light lies.
TEST(Radiosity, MetalsSendBouncedLightInItsDirection) {
  Scene scene = closed_box(0.5f, false);
  SurfaceMaterial brass = grey(0.9f);
  brass.metallic = 1;
  brass.roughness = 0.45f;
  SurfaceMaterial rough = brass;
  rough.roughness = 0.6f;
  scene.materials.insert(scene.materials.end(), {brass, rough});
  const auto last = static_cast<int>(scene.materials.size()) - 1;
  scene.meshes.push_back(quad_mesh({-0.9f, -0.9f, 0.8f}, {-0.9f, -0.9f, -0.8f}, {-0.9f, 0.5f, -0.8f}, {-0.9f, 0.5f, 0.8f}, last - 1));
  scene.meshes.push_back(quad_mesh({-0.8f, -0.95f, 0.8f}, {0.8f, -0.95f, 0.8f}, {0.8f, -0.95f, -0.8f}, {-0.8f, -0.95f, -0.8f}, last));
  PunctualLight beam;
  beam.kind = PunctualKind::spot;
  beam.position = {0, -0.3, 0};
  beam.direction = {1, 0, 0};
  beam.intensity = {1, 1, 1};
  beam.cos_inner = std::cos(0.2);
  beam.cos_outer = std::cos(0.25);
  scene.punctual_lights = {beam};
  scene.cameras = {camera_at({0.6, -0.6, 0}, {-1, -0.5, 0}, 0.8)};
  RenderOptions options = options_for(24, kAllBounces);
  options.bounce_error = 1e-3;  // the spot is small in the lobe of the metal that shows it
  const Picture ours = render(scene, options);
  options.method = "sampled";
  options.spp = 2048;
  const Picture paths = render(scene, options);
  const double error = error_beyond_noise(ours, paths, 1), ratio = mean_luminance(ours) / mean_luminance(paths);
  std::printf("error %.2f %%, mean ratio %.4f\n", 100 * error, ratio);
  // 0.033, and 0.16 where the panel sends bounced light on evenly: the limit lies between, a factor of two from each.
  EXPECT_LT(error, 0.07);
}

// A lamp's shape divides a box. A bright spot of the floor sends nothing past it, though shadows of lamps have no part in it.
TEST(Radiosity, NoLightPassesTheShapeOfALamp) {
  Scene scene = closed_box(0.7f, false);
  scene.materials.push_back(grey(0));
  AreaLight lamp;
  Polygon square;
  square.vertices = {{-1, 0.5, -1}, {1, 0.5, -1}, {1, 0.5, 1}, {-1, 0.5, 1}};
  lamp.shape = square;
  lamp.radiance = {1e-6, 1e-6, 1e-6};
  scene.area_lights = {lamp};
  Mesh shape = quad_mesh({-1, 0.5f, -1}, {1, 0.5f, -1}, {1, 0.5f, 1}, {-1, 0.5f, 1}, static_cast<int>(scene.materials.size()) - 1);
  shape.is_light_shape = true;
  shape.triangle_lights = {0, 0};
  scene.meshes.push_back(shape);
  PunctualLight beam;
  beam.kind = PunctualKind::spot;
  beam.direction = {0, -1, 0};
  beam.intensity = {1, 1, 1};
  beam.cos_inner = std::cos(0.1);
  beam.cos_outer = std::cos(0.15);
  scene.punctual_lights = {beam};
  scene.cameras = {camera_at({0.2, 0.75, 0.9}, {0, 0.1, -1}, 1)};
  for (const Vec3f& p : render(scene, options_for(16, kAllBounces)).pixels) EXPECT_LE(p.x, 1e-5f);  // ten times what the lamp sends
}

// A plate near a lamp hides the same part of it from every patch. Rays to the same places of the lamp would all be wrong alike.
TEST(Radiosity, PatchesBelowAPlateKeepTheMean) {
  Scene scene = closed_box(0.5f, false);
  AreaLight lamp;
  Polygon square;
  square.vertices = {{-0.4, 0.98, -0.4}, {0.4, 0.98, -0.4}, {0.4, 0.98, 0.4}, {-0.4, 0.98, 0.4}};
  lamp.shape = square;
  lamp.radiance = {10, 10, 10};
  scene.area_lights = {lamp};
  scene.meshes.push_back(quad_mesh({-0.4f, 0.975f, -0.4f}, {0.335f, 0.975f, -0.4f}, {0.335f, 0.975f, 0.4f}, {-0.4f, 0.975f, 0.4f}, 0));
  RenderOptions options = options_for(16, 1);
  const double by_rays = mean_luminance(render(scene, options));
  options.quality = Quality::high;
  const double exact = mean_luminance(render(scene, options));
  std::printf("mean light by rays to the lamp over that by exact shadows: %.4f\n", by_rays / exact);
  // 8 % of the lamp are left: 16 rays of a patch find them with a standard error of 0.85 of it at most. The mean over 8,000 patches has one
  // of 0.01. Rays to the same 64 places were 7 % off.
  EXPECT_NEAR(by_rays / exact, 1, 0.02);
}

// The error of each pixel covers its difference from paths, nearly everywhere, and is not much larger than that.
TEST(Radiosity, ErrorsCoverTheDifferenceFromPaths) {
  std::vector<std::string> names = {"cornell", "room"};
  if (test::by_day_or_night(1, 2) == 2) names.insert(names.end(), {"gallery", "lamp_shade"});
  for (const std::string& name : names) {
    const Scene scene = load_scene(test::kSourceDir + "/scenes/" + name + ".glb").scene;
    RenderOptions options = options_for(0, kAllBounces);
    options.width = 48;
    options.height = 27;
    options.quality = Quality::normal;
    const Picture ours = render(scene, options);
    options.bounce_strict = true;
    const Picture strict = render(scene, options);
    options.bounce_strict = false;
    options.method = "sampled";
    options.spp = test::by_day_or_night(512, 4096);
    const Picture paths = render(scene, options);
    const Coverage covered = coverage(ours, paths, {"bounce_error"});
    std::printf("%s: %.2f %% of the pixels are covered, worst %.2f\n", name.c_str(), 100 * covered.fraction, covered.worst);
    EXPECT_GT(covered.fraction, 0.97) << name;
    const Coverage by_strict = coverage(strict, paths, {"bounce_error"});
    std::printf("with --bounce-strict %.2f %%, worst %.2f\n", 100 * by_strict.fraction, by_strict.worst);
    EXPECT_GT(by_strict.fraction, 0.97) << name;
    double error = 0, difference = 0, error_of_strict = 0;
    for (std::size_t i = 0; i < ours.pixels.size(); ++i) {
      error_of_strict += luminance(static_cast<Vec3d>(strict.layers.at("bounce_error")[i]));
      error += luminance(static_cast<Vec3d>(ours.layers.at("bounce_error")[i]));
      difference += std::fabs(luminance(static_cast<Vec3d>(ours.pixels[i]) - static_cast<Vec3d>(paths.pixels[i])));
    }
    std::printf("the estimate is %.1f times the difference\n", error / difference);
    EXPECT_LT(error, 10 * difference) << name;  // an error of ten times the truth is of no use
    EXPECT_LT(error_of_strict, error / 2) << name;
  }
}

// Pixels whose centres meet a crease of a room exactly see the room, not the inside of a wall.
TEST(Radiosity, CreasesAreNotBlack) {
  Scene scene = closed_box(0.5f, false);
  AreaLight lamp;
  lamp.shape = Ellipsoid{{0, 0.5, 0}, {0.2, 0, 0}, {0, 0.2, 0}, {0, 0, 0.2}};
  lamp.radiance = {10, 10, 10};
  scene.area_lights = {lamp};
  scene.cameras = {camera_at({0, 0, 0.5}, {0, 0, -1}, 1.5)};
  for (const int side : {31, 32, 33}) {
    const Picture picture = render(scene, options_for(side, 0));
    std::vector<double> light;
    for (const Vec3f& p : picture.pixels) light.push_back(luminance(static_cast<Vec3d>(p)));
    const double least = *std::min_element(light.begin(), light.end());
    EXPECT_GT(least, 0.05 * *std::max_element(light.begin(), light.end())) << side;
  }
}

// A narrow beam lights a circle as large as seven patches of a wall. Patches at its border take a part of its light.
TEST(Radiosity, PatchesAtABorderOfLightTakeItsMean) {
  Scene scene = closed_box(0.5f, false);
  PunctualLight beam;
  beam.kind = PunctualKind::spot;
  beam.position = {0.2, 0, -0.3};
  beam.direction = {0, -1, 0};
  beam.intensity = {1, 1, 1};
  beam.cos_inner = std::cos(0.08);
  beam.cos_outer = std::cos(0.0801);
  scene.punctual_lights = {beam};
  RenderOptions options = options_for(32, 1);
  const double ours = mean_luminance(render(scene, options));
  options.method = "sampled";
  options.spp = 256;
  const double paths = mean_luminance(render(scene, options));
  // The mean of 32 x 32 x 256 paths has a standard error of 0.3 %. A circle of radius 5.8 in units of places has 105 of them, within 5.
  EXPECT_NEAR(ours / paths, 1, 0.06);
}

}  // namespace steradian::radiosity_test
