// Lights that fit themselves: recovery of seeded lights, bands of illuminance, statements about what is not determined.
#include "steradian/solve.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/random.h"
#include "night.h"
#include "solve/box_least_squares.h"
#include "solve/lamp_room_test.h"
#include "shapes/triangulate.h"
#include "solve/least_power.h"
#include "steradian/error.h"

namespace steradian::solve_test {

// The lamp stands turned by 70 degrees, of which the range allows 60. With its sides exchanged, 20 do.
TEST(Solve, TurnsARectangleOnByAQuarter) {
  Scene scene = room();
  scene.area_lights = {panel({0.4, 2.5, -0.5}, 1.2, 0.6, {8, 7, 6}, {0.2, 0, -0.1})};
  const PictureTarget target = picture_of(scene, 64, 36);
  const Vec3d center{0.3, 2.4, -0.4};
  AreaLight start = panel(center, 0.8, 0.6, {8, 7, 6});
  for (Vec3d& v : std::get<Polygon>(start.shape).vertices) v = center + rotated(v - center, {0, 1, 0}, 70 * std::numbers::pi / 180);
  scene.area_lights = {start};
  const Solution found = solve(scene, {everything(0)}, {}, {target});
  EXPECT_TRUE(found.converged);
  EXPECT_LT(length(center_of(found.area_lights[0]) - Vec3d{0.4, 2.5, -0.5}), 1e-5);
  for (const FittedParameter& p : found.parameters) EXPECT_FALSE(p.at_bound) << p.name;
}

TEST(Solve, RecoversALampFromItsPicture) {
  Scene scene = room();
  scene.area_lights = {panel({0.4, 2.5, -0.5}, 1.2, 0.6, {8, 7, 6}, {0.2, 0, -0.1})};
  const PictureTarget target = picture_of(scene, 64, 36);
  scene.area_lights = {panel({-0.3, 2.2, 0.2}, 0.8, 0.8, {6, 5.25, 4.5})};
  SolveOptions options;
  options.starts = 8;
  const Solution found = solve(scene, {everything(0)}, {}, {target}, options);
  EXPECT_TRUE(found.converged);
  const double off = length(center_of(found.area_lights[0]) - Vec3d{0.4, 2.5, -0.5});
  std::printf("lamp recovered to %.1e m, picture to %.1e, %zu steps, %d evaluations\n", off, found.picture_error, found.steps.size() - 1,
              found.evaluations);
  EXPECT_LT(off, 1e-5);
  EXPECT_LT(found.picture_error, 1e-5);
  ASSERT_EQ(found.parameters.size(), 9u);
  for (const FittedParameter& p : found.parameters) EXPECT_TRUE(p.determined) << p.name;
}

// A triangle and its mirror image, whose corners stand in another order. Its corners lie elsewhere, and the image follows.
TEST(Solve, AMirrorImageFollowsVertices) {
  Scene scene = room();
  const auto lamps_of = [](const std::vector<Vec3d>& corners) {
    AreaLight lamp = panel({0, 2.6, 0}, 1, 1, {8, 8, 8}), image = lamp;
    const auto there = [](Vec3d p) { return Vec3d{0.2 - p.x, p.y, p.z}; };  // in the plane x = 0.1
    lamp.shape = Polygon{corners, {}};
    image.shape = Polygon{{there(corners[1]), there(corners[0]), there(corners[2])}, {}};
    return std::vector<AreaLight>{lamp, image};
  };
  const std::vector<Vec3d> wanted = {{-1.1, 2.6, -0.4}, {-0.2, 2.6, -0.3}, {-0.5, 2.6, 0.6}};
  scene.area_lights = lamps_of(wanted);
  const std::vector<Vec3d> image = polygon_of(scene.area_lights[1]).vertices;
  const PictureTarget target = picture_of(scene, 64, 36);
  scene.area_lights = lamps_of({wanted[0] + Vec3d{0.1, 0, 0.2}, wanted[1] + Vec3d{-0.1, 0, 0.1}, wanted[2] + Vec3d{0.2, 0, -0.1}});
  LightFit fit;
  fit.power = fit.vertices = true;
  fit.most_move = 0.5;
  LightTie tie;
  tie.lights = {0, 1};
  tie.has_mirror = true;
  tie.mirror_point = {0.1, 0, 0};
  tie.mirror_normal = {1, 0, 0};
  const Solution found = solve(scene, {fit}, {tie}, {target});
  EXPECT_EQ(found.parameters.size(), 7u);
  double off = 0;
  for (std::size_t i = 0; i < 3; ++i)
    off = std::max({off, length(polygon_of(found.area_lights[0]).vertices[i] - wanted[i]),
                    length(polygon_of(found.area_lights[1]).vertices[i] - image[i])});
  std::printf("three vertices and their image recovered to %.1e m\n", off);
  EXPECT_LT(off, 1e-3);
  std::get<Polygon>(scene.area_lights[1].shape).vertices[0].x += 0.1;
  EXPECT_THROW(solve(scene, {fit}, {tie}, {target}), Error);
}

// A pentagon whose corners all lie elsewhere, and its power.
TEST(Solve, RecoversTheVerticesOfAPolygon) {
  Scene scene = room();
  AreaLight lamp = panel({0, 2.6, 0}, 1, 1, {8, 8, 8});
  lamp.shape = Polygon{{{-0.9, 2.6, -0.4}, {0.1, 2.6, -0.9}, {0.8, 2.6, -0.2}, {0.5, 2.6, 0.6}, {-0.6, 2.6, 0.5}}, {}};
  scene.area_lights = {lamp};
  const std::vector<Vec3d> wanted = polygon_of(lamp).vertices;
  const PictureTarget target = picture_of(scene, 64, 36);
  auto& polygon = std::get<Polygon>(scene.area_lights[0].shape);
  const Vec3d away[] = {{0.2, 0, 0.1}, {-0.1, 0, 0.2}, {-0.2, 0, 0.1}, {0.1, 0, -0.2}, {0.2, 0, 0.2}};
  for (std::size_t i = 0; i < 5; ++i) polygon.vertices[i] += away[i];
  scene.area_lights[0].radiance = {5, 5, 5};
  LightFit fit;
  fit.power = fit.vertices = true;
  fit.most_move = 0.5;
  const Solution found = solve(scene, {fit}, {}, {target});
  EXPECT_TRUE(found.converged);
  ASSERT_EQ(found.parameters.size(), 11u);
  ASSERT_EQ(found.changes[0].vertices.size(), 5u);
  double off = 0;
  for (std::size_t i = 0; i < 5; ++i) {
    off = std::max(off, length(polygon_of(found.area_lights[0]).vertices[i] - wanted[i]));
    EXPECT_EQ(found.changes[0].vertices[i], polygon_of(found.area_lights[0]).vertices[i]);
  }
  std::printf("five vertices recovered to %.1e m, picture to %.1e, %zu steps\n", off, found.picture_error, found.steps.size() - 1);
  // The picture has single precision, and tells two near corners of one edge apart to some tenths of a millimetre.
  EXPECT_LT(off, 1e-3);
  EXPECT_LT(found.picture_error, 2e-6);
  EXPECT_NEAR(found.area_lights[0].radiance.x, 8, 8e-3);
}

// From corners far away, the shortest way often leads through outlines that cross themselves. Such a file could not be written.
TEST(Solve, NeverLetsAnOutlineCrossItself) {
  Scene scene = room();
  AreaLight lamp = panel({0, 2.6, 0}, 1, 1, {8, 8, 8});
  const auto pentagon = [](double radius, double by, double first) {
    Polygon p;
    for (int i = 0; i < 5; ++i) {
      const double angle = first - 2 * std::numbers::pi * i / 5, r = i % 2 == 0 ? radius : radius * by;
      p.vertices.push_back({r * std::cos(angle), 2.6, -r * std::sin(angle)});
    }
    return p;
  };
  lamp.shape = pentagon(1, 0.4, 0);
  scene.area_lights = {lamp};
  const PictureTarget target = picture_of(scene, 48, 27);
  LightFit fit;
  fit.vertices = true;
  std::vector<double> costs;
  for (int i = 0; i < 10; ++i) {
    scene.area_lights[0].shape = pentagon(0.4 + 0.1 * i, 1 + 0.3 * (i % 3), 0.6 * i);
    const Solution found = solve(scene, {fit}, {}, {target});
    Contours contours(1);
    for (const Vec3d& v : polygon_of(found.area_lights[0]).vertices) contours[0].push_back({v.x, v.z});
    EXPECT_TRUE(triangles_of(contours)) << "start " << i;
    costs.push_back(found.cost);
  }
  std::sort(costs.begin(), costs.end());
  std::printf("costs %.1e to %.1e, median %.1e\n", costs.front(), costs.back(), costs[5]);
}

TEST(Solve, RefusesVerticesWithWhatTheyInclude) {
  Scene scene = room();
  scene.area_lights = {panel({0, 2.6, 0}, 1, 1, {8, 8, 8}), panel({1, 2.6, 0}, 1, 1, {8, 8, 8})};
  const std::vector<LightTarget> targets = {picture_of(scene, 16, 9)};
  LightFit fit;
  fit.vertices = fit.size = true;
  EXPECT_THROW(solve(scene, {fit}, {}, targets), Error);
  fit.size = false;
  scene.area_lights[0].node = 3;  // a rectangle of a file
  EXPECT_THROW(solve(scene, {fit}, {}, targets), Error);
  scene.area_lights[0].shape = Ellipse{{0, 2.6, 0}, {1, 0, 0}, {0, 0, -1}};
  scene.area_lights[0].node = -1;
  EXPECT_THROW(solve(scene, {fit}, {}, targets), Error);
}

// Derivatives by the boundary on packs against central differences of the values. Where the lamp's plane crosses a wall, differences meet a
// kink: nine pixels of ten count. The derivative of the closed form's cubature is up to 3.6e-2 of the true one off.
TEST(Solve, SlopesOnPacksAreDifferencesOfTheValues) {
  Scene scene = room();
  scene.area_lights = {panel({0.4, 2.5, -0.5}, 1.2, 0.6, {8, 7, 6}, {0.2, 0, -0.1})};
  const std::vector<LightTarget> targets = {picture_of(scene, 64, 36)};
  const std::vector<LightFit> fits = {everything(0)};
  const LightModel model(scene, fits, {}, targets);
  const std::vector<double> x = model.start();
  const LightModel::Values all = model.with_slopes(x);
  const std::size_t n = x.size();
  for (std::size_t u = 0; u < n; ++u) {
    const double step = 2e-3;
    std::vector<double> low = x, high = x;
    low[u] -= step;
    high[u] += step;
    const std::vector<double> a = model.at(low).value, b = model.at(high).value;
    std::vector<double> errors;
    double size = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
      const double difference = (b[i] - a[i]) / (2 * step);
      errors.push_back(std::fabs(all.slopes[i * n + u] - difference));
      size += difference * difference / static_cast<double>(a.size());
    }
    std::sort(errors.begin(), errors.end());
    const double most = errors[errors.size() * 9 / 10] / std::sqrt(size);
    std::printf("%s: nine of ten within %.1e of the derivatives' rms\n", model.variables()[u].name.c_str(), most);
    EXPECT_LT(most, 4e-2) << model.variables()[u].name;
  }
}

// The same from eight random starting points, for other lamps.
TEST(Solve, RecoversLampsFromAnywhere) {
  reference::Random random(5);
  std::vector<double> off;
  const int lamps = test::by_day_or_night(10, 20);
  for (int i = 0; i < lamps; ++i) {
    Scene scene = room();
    const Vec3d center{random.uniform(-2, 2), random.uniform(1.8, 2.7), random.uniform(-2, 1)};
    const double width = random.uniform(0.4, 1.5), height = random.uniform(0.4, 1.5);
    const Vec3d turn{random.uniform(-0.3, 0.3), 0, random.uniform(-0.3, 0.3)};
    scene.area_lights = {panel(center, width, height, {8, 7, 6}, turn)};
    const PictureTarget target = picture_of(scene, 64, 36);
    scene.area_lights = {panel({0, 2.2, 0}, 0.8, 0.8, {6, 5.25, 4.5})};
    SolveOptions options;
    options.starts = 8;
    options.seed = static_cast<std::uint64_t>(i + 1);
    const Solution found = solve(scene, {everything(0)}, {}, {target}, options);
    off.push_back(length(center_of(found.area_lights[0]) - center));
  }
  std::sort(off.begin(), off.end());
  const auto found_again = std::count_if(off.begin(), off.end(), [](double d) { return d < 1e-5; });
  std::printf("%td of %d lamps found to 1e-5 m, half of them to %.1e m\n", found_again, lamps, off[off.size() / 2]);
  EXPECT_GE(found_again * 100, lamps * 95);
}

TEST(Solve, TakesNoStepsFromItsOwnSolution) {
  Scene scene = room();
  scene.area_lights = {panel({0.4, 2.5, -0.5}, 1.2, 0.6, {8, 7, 6}, {0.2, 0, -0.1})};
  const Solution found = solve(scene, {everything(0)}, {}, {picture_of(scene, 64, 36)});
  EXPECT_LE(found.steps.size(), 3u);
  for (const FittedParameter& p : found.parameters) EXPECT_NEAR(p.value, p.start, 1e-5 * std::max(std::fabs(p.start), 1.0)) << p.name;
}

// Twelve panels under the ceiling, 500 lux within 10 % on a desk, at most 150 elsewhere on the floor.
TEST(Solve, LightsADeskByTwelvePanels) {
  Scene scene = room();
  std::vector<LightFit> fits;
  for (int i = 0; i < 12; ++i) {
    scene.area_lights.push_back(panel({-2.25 + 1.5 * (i % 4), 2.99, -2 + 2.0 * (i / 4)}, 0.6, 0.6, {300, 300, 300}));
    fits.push_back({});
    fits.back().light = static_cast<std::size_t>(i);
    fits.back().power = true;
  }
  LuxTarget desk, floor;
  desk.name = "desk";
  floor.name = "floor";
  for (int i = 0; i < 8; ++i)
    for (int j = 0; j < 4; ++j) {
      desk.points.push_back({0.3 + 1.4 * i / 7, 0.75, -0.3 + 0.6 * j / 3});
      desk.normals.push_back({0, 1, 0});
    }
  desk.lux.min = 450;
  desk.lux.max = 550;
  for (int i = 0; i < 12; ++i)
    for (int j = 0; j < 12; ++j) {
      floor.points.push_back({-2.75 + 0.5 * i, 0.0, -2.75 + 0.5 * j});
      floor.normals.push_back({0, 1, 0});
    }
  floor.lux.max = 100;
  floor.weight = 1e-6;  // the desk comes first
  SolveOptions options;
  for (const bool least : {false, true})
    for (const int bounces : {0, kAllBounces}) {
      options.render.bounces = bounces;
      options.render.quality = Quality::draft;
      options.least_power = least;
      const Solution found =
          solve(scene, fits, {}, least ? std::vector<LightTarget>{desk} : std::vector<LightTarget>{desk, floor}, options);
      EXPECT_TRUE(found.converged);
      double flux = 0;
      for (const FittedParameter& p : found.parameters) flux += p.value;
      std::printf("%s, %s: desk %.0f to %.0f lux, mean %.0f; %.0f lm\n", least ? "least power" : "dark floor",
                  bounces == 0 ? "direct" : "all bounces", found.lux[0].min, found.lux[0].max, found.lux[0].mean, flux);
      EXPECT_EQ(found.lux[0].outside, 0u);
      EXPECT_GE(found.lux[0].min, 449.5);
      EXPECT_LE(found.lux[0].max, 550.5);
    }
}

// Two lamps, one the image of the other in the plane x = 0, with a color of their own for each channel.
TEST(Solve, MovesTiedLightsTogether) {
  Scene scene = room();
  scene.area_lights = {panel({-1.3, 2.4, -0.7}, 0.8, 0.8, {9, 4, 1}, {0.2, 0, 0.1}),
                       panel({1.3, 2.4, -0.7}, 0.8, 0.8, {9, 4, 1}, {0.2, 0, -0.1})};
  const PictureTarget target = picture_of(scene, 64, 36);
  scene.area_lights = {panel({-0.8, 2.2, -0.3}, 0.8, 0.8, {5, 5, 0}), panel({0.9, 2.3, -0.2}, 0.8, 0.8, {5, 5, 0})};
  LightFit fit = everything(0);
  fit.power = fit.size = false;
  fit.color = true;
  LightTie tie{{0, 1}, true, {0, 0, 0}, {1, 0, 0}};
  const Solution found = solve(scene, {fit}, {tie}, {target});
  EXPECT_LT(found.picture_error, 1e-5);
  EXPECT_LT(length(center_of(found.area_lights[0]) - Vec3d{-1.3, 2.4, -0.7}), 1e-4);
  EXPECT_LT(length(center_of(found.area_lights[1]) - Vec3d{1.3, 2.4, -0.7}), 1e-4);
  EXPECT_LT(length(found.area_lights[1].radiance - Vec3d{9, 4, 1}), 1e-3);
  ASSERT_EQ(found.changes.size(), 2u);
  EXPECT_NEAR(found.changes[1].rotation.x, found.changes[0].rotation.x, 1e-12);
  EXPECT_NEAR(found.changes[1].rotation.z, -found.changes[0].rotation.z, 1e-12);
}

// Places free: six panels bunched in the middle move apart until the least illuminance is over 0.65 of the mean. With all powers at once,
// the conditions are those of the least power.
TEST(Solve, MakesIlluminancesUniform) {
  Scene scene = room();
  LuxTarget floor;
  floor.name = "floor";
  for (int i = 0; i < 8; ++i)
    for (int j = 0; j < 8; ++j) {
      floor.points.push_back({-1.75 + 0.5 * i, 0.0, -1.75 + 0.5 * j});
      floor.normals.push_back({0, 1, 0});
    }
  floor.lux.mean = 300;
  floor.lux.uniformity = 0.65;
  std::vector<LightFit> fits;
  for (int i = 0; i < 6; ++i) {
    scene.area_lights.push_back(panel({-0.5 + 0.5 * (i % 3), 2.9, -0.25 + 0.5 * (i / 3)}, 0.4, 0.4, {500, 500, 500}));
    LightFit fit;
    fit.light = static_cast<std::size_t>(i);
    fit.power = fit.position = true;
    fit.position_x = fit.position_z = {-2.5, 2.5};
    fit.position_y = {2.9, 2.9};
    fits.push_back(fit);
  }
  const Solution spread = solve(scene, fits, {}, {floor});
  std::printf("places free: min/mean %.3f, mean %.1f after %d steps\n", spread.lux[0].min / spread.lux[0].mean, spread.lux[0].mean,
              spread.steps.back().step);
  EXPECT_GE(spread.lux[0].min, 0.65 * spread.lux[0].mean);
  EXPECT_NEAR(spread.lux[0].mean, 300, 0.3);

  scene.area_lights = spread.area_lights;
  for (LightFit& fit : fits) fit.position = false;
  SolveOptions options;
  options.least_power = true;
  floor.lux.uniformity = 0.6;
  const Solution least = solve(scene, fits, {}, {floor}, options);
  EXPECT_NEAR(least.lux[0].mean, 300, 0.3);
  EXPECT_GE(least.lux[0].min, 0.6 * least.lux[0].mean * (1 - 1e-5));
  double before = 0, after = 0;
  for (const FittedParameter& p : least.parameters) before += p.start, after += p.value;
  EXPECT_LT(after, before);
  floor.lux.min = 1e4;  // not with this mean
  EXPECT_NE(solve(scene, fits, {}, {floor}, options).notes.front().find("no powers satisfy"), std::string::npos);
}

// A painted highlight on a glossy floor. Its light is the middle of the specular light that is at least half as bright as the brightest.
TEST(Solve, PutsAHighlightWhereItIsPainted) {
  constexpr int kWidth = 96, kHeight = 54, kStrokes = 20;
  Scene scene = room();
  scene.materials[1].roughness = 0.3f;
  scene.cameras = {scene::camera_at({0, 1.5, 2.8}, {0, -0.5, -1}, 0.9)};  // every pixel shows the room
  reference::Random random(11);
  int near = 0;
  double worst = 0;
  for (int stroke = 0; stroke < kStrokes; ++stroke) {
    scene.area_lights = {panel({0, 2.5, -0.5}, 0.5, 0.5, {8, 8, 8})};
    // The pixel in which a mirror would show some place under the ceiling.
    const Camera& camera = scene.cameras[0];
    const Vec3d image{random.uniform(-1.2, 1.2), -2.5, random.uniform(-2.2, -0.6)};
    const Vec3d to = image - camera.position;
    const double scale = kHeight / (2 * std::tan(camera.yfov / 2) * -dot(to, camera.z));
    const double sx = kWidth / 2.0 + scale * dot(to, camera.x), sy = kHeight / 2.0 - scale * dot(to, camera.y);
    PictureTarget target;
    target.picture = Picture(kWidth, kHeight);
    target.part = LightPart::specular;
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x) {
        const bool painted = std::hypot(x + 0.5 - sx, y + 0.5 - sy) < 4;
        if (painted) target.picture.at(x, y) = {1, 1, 1};
        target.pixel_weights.push_back(painted ? 1.0f : 0.1f);
      }
    LightFit fit;
    fit.power = fit.position = true;
    fit.position_x = {-2.7, 2.7};
    fit.position_y = {2.4, 2.6};
    fit.position_z = {-2.7, 2.7};
    const Solution found = solve(scene, {fit}, {}, {target});
    scene.area_lights = found.area_lights;
    LightFit power;
    power.power = true;
    const LightModel model(scene, {power}, {}, {target});
    const std::vector<double> value = model.at(model.start()).value;
    ASSERT_EQ(value.size(), std::size_t{3 * kWidth * kHeight});
    double brightest = 0, sum = 0, cx = 0, cy = 0;
    for (const double v : value) brightest = std::max(brightest, v);
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x) {
        const double v = value[static_cast<std::size_t>(3 * (y * kWidth + x))];
        if (v < brightest / 2) continue;
        sum += v;
        cx += v * (x + 0.5);
        cy += v * (y + 0.5);
      }
    const double off = std::hypot(cx / sum - sx, cy / sum - sy);
    near += off < 3 ? 1 : 0;
    worst = std::max(worst, off);
  }
  std::printf("%d of %d highlights within 3 pixels, the farthest %.1f pixels off\n", near, kStrokes, worst);
  EXPECT_GE(near, 18);
}

TEST(Solve, SaysWhatIsNotDetermined) {
  // Two panels in one place: only the sum of their powers is known.
  Scene scene = room();
  scene.area_lights = {panel({0, 2.5, 0}, 1, 1, {5, 5, 5}), panel({0, 2.5, 0}, 1, 1, {5, 5, 5})};
  const PictureTarget target = picture_of(scene, 32, 18);
  LightFit one, two;
  one.power = two.power = true;
  two.light = 1;
  const Solution found = solve(scene, {one, two}, {}, {target});
  for (const FittedParameter& p : found.parameters) {
    EXPECT_FALSE(p.determined) << p.name;
    EXPECT_TRUE(std::isinf(p.sigma));
  }
}

TEST(Solve, RefusesWhatCannotBeFitted) {
  Scene scene = room();
  scene.area_lights = {panel({0, 2.5, 0}, 1, 1, {5, 5, 5})};
  const PictureTarget target = picture_of(scene, 32, 18);
  const auto message = [&](const Scene& s, const std::vector<LightFit>& fits, const std::vector<LightTarget>& targets) -> std::string {
    try {
      solve(s, fits, {}, targets);
    } catch (const Error& e) {
      return e.what();
    }
    return "";
  };
  LightFit fit;
  EXPECT_NE(message(scene, {}, {target}).find("nothing to fit"), std::string::npos);
  EXPECT_NE(message(scene, {fit}, {target}).find("nothing to fit"), std::string::npos);
  fit.power = true;
  EXPECT_NE(message(scene, {fit}, {}).find("no target"), std::string::npos);
  fit.light = 3;
  EXPECT_NE(message(scene, {fit}, {target}).find("not in the scene"), std::string::npos);
  fit.light = 0;
  PictureTarget broken = target;
  broken.picture.pixels[5].x = std::nanf("");
  EXPECT_NE(message(scene, {fit}, {broken}).find("pixel (5, 0) is not finite"), std::string::npos);
  broken = target;
  broken.pixel_weights.assign(broken.picture.pixels.size(), 0.0f);
  EXPECT_NE(message(scene, {fit}, {broken}).find("no pixel counts"), std::string::npos);
  broken.pixel_weights.assign(3, 1.0f);
  EXPECT_NE(message(scene, {fit}, {broken}).find("another size"), std::string::npos);
  LuxTarget one;
  one.points = {{0, 0, 0}};
  one.normals = {{0, 1, 0}};
  one.lux.min = 5;
  EXPECT_NE(message(scene, {everything(0)}, {one}).find("for 9 unknowns"), std::string::npos);
  one.normals = {{0, -1, 0}};
  EXPECT_NE(message(scene, {fit}, {one}).find("no target sees the light"), std::string::npos);
  LightFit start_outside = everything(0);
  start_outside.position_y = {0, 1};
  EXPECT_NE(message(scene, {start_outside}, {target}).find("outside of its range"), std::string::npos);
}

// The conditions of Karush, Kuhn and Tucker: free variables have no slope, those at a bound have one outwards.
TEST(Solve, QuadraticsInABoxSatisfyTheirConditions) {
  reference::Random random(1);
  std::size_t solves = 0;
  for (int round = 0; round < 50; ++round) {
    const std::size_t n = 12, rows = 30;
    std::vector<double> j(n * rows), h(n * n), g(n), low(n, 0.0), high(n, 1.0);
    for (double& x : j) x = random.uniform(0, 1);
    for (std::size_t r = 0; r < rows; ++r) {
      const double goal = random.uniform(-1, 3);
      for (std::size_t a = 0; a < n; ++a) {
        g[a] -= j[r * n + a] * goal;
        for (std::size_t b = 0; b < n; ++b) h[a * n + b] += j[r * n + a] * j[r * n + b];
      }
    }
    const solving::BoxStep found = solving::least_in_box(g, h, low, high);
    solves += found.solves;
    for (std::size_t a = 0; a < n; ++a) {
      double slope = g[a];
      for (std::size_t b = 0; b < n; ++b) slope += h[a * n + b] * found.step[b];
      EXPECT_GE(found.step[a], 0);
      EXPECT_LE(found.step[a], 1);
      EXPECT_TRUE(found.step[a] == 0 || slope <= 1e-9) << slope;
      EXPECT_TRUE(found.step[a] == 1 || slope >= -1e-9) << slope;
    }
  }
  std::printf("12 variables in a box: %.1f systems of equations on average\n", static_cast<double>(solves) / 50);
}

}  // namespace steradian::solve_test
