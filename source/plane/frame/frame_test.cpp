// The frame, on packs and tiles, against the query in double.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fmt/format.h>
#include <functional>
#include <gtest/gtest.h>

#include "core/simd.h"
#include "night.h"
#include "paths.h"
#include "plane/exact/random.h"
#include "plane/exact/world.h"
#include "plane/frame/scene.h"
#include "plane/stage/drawing.h"
#include "support/plane_families.h"

namespace steradian::plane::frame_test {
namespace {

double largest_radiance(const PlaneScene& scene) {
  double largest = 0;
  for (const PlaneBody& b : scene.bodies)
    if (b.light) largest = std::max({largest, b.light->radiance.x, b.light->radiance.y, b.light->radiance.z});
  return largest;
}

// Compares every `stride`-th pixel of the frame with the query. The bound is the interface's: 1e-5 of the emission. A light divided by the
// distance sends more than its radiance; there the bound is relative to the light that arrives.
void expect_query(
    const PlaneScene& scene, int width, int height, int stride, const std::string& what, double bound = 1e-5,
    const std::function<bool(Vec2d)>& counts = [](Vec2d) { return true; }) {
  const PlaneWorld world(scene);
  PlaneFrameOptions options;
  options.width = width;
  options.height = height;
  const Picture picture = render_plane(world, options);
  double worst = 0, squares = 0;
  const double emission = largest_radiance(scene);
  int count = 0, wrong = 0;
  for (int i = 0; i < width * height; i += stride) {
    const int x = i % width, y = i / width;
    // The point equals the frame's to the last bit: it may lie on an outline.
    const Vec2d step{scene.width / width, scene.height / height};
    const Vec2d p{scene.origin.x + step.x * (x + 0.5), scene.origin.y + step.y * (y + 0.5)};
    if (!counts(p)) continue;
    const Vec3d exact = world.query(p).radiance;
    const Vec3f pixel = picture.at(x, y);
    const double error = std::max({std::fabs(exact.x - static_cast<double>(pixel.x)), std::fabs(exact.y - static_cast<double>(pixel.y)),
                                   std::fabs(exact.z - static_cast<double>(pixel.z))}) /
                         std::max({emission, exact.x, exact.y, exact.z});
    worst = std::max(worst, error);
    squares += error * error;
    ++count;
    if (!(error <= bound) && ++wrong <= 3) {
      ADD_FAILURE() << what << ": pixel (" << x << ", " << y << ") = " << pixel.x << ", query (" << p.x << ", " << p.y << ") = " << exact.x
                    << ", error " << error;
    }
  }
  EXPECT_EQ(wrong, 0) << what << ", of " << count << " pixels";
  std::printf("%-50s rms %.1e, largest %.1e of %d pixels\n", what.c_str(), std::sqrt(squares / count), worst, count);
}

}  // namespace

TEST(PlaneFrame, EqualsTheQueryOnAllFamilies) {
  for (int family = 1; family <= kPlaneFamilies; ++family)
    expect_query(make_plane_family(family, 7), 200, 150, 7, plane_family_name(family));
}

TEST(PlaneFrame, EqualsTheQueryInEveryInstructionSet) {
  for (Simd simd : available_simd()) {
    setenv("STERADIAN_SIMD", name_of(simd), 1);
    expect_query(make_plane_family(8, 2), 160, 120, 5, name_of(simd));
    for (const LightPairDrawing& drawing :
         {LightPairDrawing{"ellipse", "gradient"}, LightPairDrawing{"circle", "lambert"}, LightPairDrawing{"capsule", "spot"}})
      expect_query(make_drawing(drawing), 97, 61, 7, std::string(name_of(simd)) + ", " + drawing.shape + "-" + drawing.emission);
    unsetenv("STERADIAN_SIMD");
  }
}

// Bowls and bulges with bodies in them, on them and across them, outlines that cross themselves, lines lit from both sides.
TEST(PlaneFrame, EqualsTheQueryAroundCurvedLights) {
  const std::string shapes[] = {
      R"~(<path d="M40 30C40 110 120 110 120 30L110 30C110 95 50 95 50 30Z" {}/><circle cx="80" cy="60" r="12"/><rect x="60" y="84" width="8" height="6"/>)~",
      R"~(<path d="M30 75C60 20 140 20 170 75C140 40 60 40 30 75Z" {}/><path d="M100 34V10" stroke="#000"/><circle cx="60" cy="30" r="9"/>)~",
      R"~(<path d="M40 60C160 0 160 150 40 90C120 120 120 30 40 60Z" {}/><rect x="70" y="72" width="30" height="6" transform="rotate(20 80 75)"/>)~",
      R"~(<path d="M40 40C200 160 0 160 150 40L140 40C20 130 180 140 50 40Z" {}/><circle cx="100" cy="100" r="8"/>)~",
      R"~(<path d="M30 100Q70 20 110 100T180 60" {} style="fill:none;stroke:#fff"/><circle cx="70" cy="80" r="7"/><rect x="120" y="100" width="14" height="20"/>)~",
      R"~(<path d="M30 100Q70 20 110 100T180 60" {} style="fill:none;stroke:#fff;stroke-width:9;stroke-linecap:round"/><path d="M60 40L90 90" stroke="#000" stroke-width="4" stroke-linecap="round"/>)~"};
  const std::string emissions[] = {R"~(fill="#fff")~",
                                   R"~(fill="#fff" data-range="90")~",
                                   R"~(fill="#fff" data-profile="lambert")~",
                                   R"~(fill="#fff" data-profile="inverse")~",
                                   R"~(fill="#fff" data-spot="-60 50")~",
                                   R"~(fill="url(#g)")~"};
  for (std::size_t s = 0; s < std::size(shapes); ++s)
    for (std::size_t e = 0; e < std::size(emissions); ++e) {
      if ((s + e) % test::by_day_or_night<std::size_t>(2, 1) != 0) continue;
      std::string svg = shapes[s];
      svg.replace(svg.find("{}"), 2, "class=\"light\" " + emissions[e]);
      svg =
          R"~(<svg viewBox="0.17 0.08 200 150"><linearGradient id="g" x2="1" y2="0.7"><stop stop-color="#f80"/><stop offset="0.4" stop-color="#08f"/>)~"
          R"~(<stop offset="1" stop-color="#fff"/></linearGradient>)~" +
          svg + "</svg>";
      const PlaneScene scene = load_plane_scene_from_text(svg, "curved").scene;
      expect_query(scene, 200, 150, 17, "curved " + std::to_string(s) + ", " + std::to_string(e), e == 3 ? 3e-5 : 1e-5);
    }
}

// Tiles at every distance from arcs, which need quadratures of four to sixteen nodes, or adaptive ones.
TEST(PlaneFrame, EqualsTheQueryAtEveryDistanceFromAnArc) {
  const std::string shapes[] = {"rx=\"40\" ry=\"40\"", "rx=\"40\" ry=\"22\"", "rx=\"30\" ry=\"11\"", "rx=\"30\" ry=\"7\""};
  const std::string emissions[] = {R"~(fill="#fff" data-range="100")~", R"~(fill="#fff" data-profile="lambert")~",
                                   R"~(fill="#fff" data-profile="inverse")~", R"~(fill="url(#g)")~",
                                   R"~(fill="url(#g)" data-profile="lambert" data-range="140")~"};
  for (std::size_t s = 0; s < std::size(shapes); ++s)
    for (std::size_t e = 0; e < std::size(emissions); ++e) {
      const std::string svg = R"~(<svg viewBox="0 0 200 150"><linearGradient id="g" x2="1" y2="0.7"><stop stop-color="#f80"/>)~"
                              R"~(<stop offset="0.4" stop-color="#08f"/><stop offset="1" stop-color="#fff"/></linearGradient>)~"
                              R"~(<ellipse class="light" cx="60" cy="61" transform="rotate(25 60 61)" )~" +
                              shapes[s] + " " + emissions[e] + R"~(/><rect x="120" y="80" width="12" height="9"/></svg>)~";
      const PlaneScene scene = load_plane_scene_from_text(svg, "arcs").scene;
      // Floats cannot decide on which side of an outline a point within a hair's breadth of it lies.
      const PlaneBody& light = scene.bodies.front();
      const PlaneEllipse outline{light.center, light.x_axis, light.y_axis};
      expect_query(scene, 400, 300, 7, "arc " + std::to_string(s) + ", " + std::to_string(e), e == 2 ? 3e-5 : 1e-5,
                   [&](Vec2d p) { return std::fabs(length(outline.to_unit(p)) - 1) > 5e-3; });
    }
}

// A light of hundreds of edges is tested by its runs: half of its edges would face a tile. (By edges the test took 156.)
TEST(PlaneFrame, TakesCurvesByRuns) {
  const PlaneScene scene = make_drawing({"stroke", "uniform"});
  const PlaneWorld world(scene);
  PlaneFrameOptions options;
  options.width = 640;
  options.height = 360;
  PlaneFrameStats stats;
  render_plane(world, options, &stats);
  const std::uint64_t tiles = 40 * 23;
  EXPECT_LT(stats.tile_lights, 25 * tiles);
}

TEST(PlaneFrame, EqualsTheQueryInLightFieldsOfTheBench) {
  for (LightField field : kLightFields) {
    // The bench's scenes on a quarter of their area, with the same density.
    field.lights /= 16;
    field.boxes /= 16;
    field.lights = std::max(field.lights, 4);
    field.width /= 4;
    field.height /= 4;
    expect_query(make_light_field(field, 3), field.width, field.height, 13,
                 "light field " + std::to_string(field.lights) + "x" + std::to_string(field.boxes));
  }
}

TEST(PlaneFrame, EqualsTheQueryWithOverlappingShapesOfEveryKind) {
  SceneRandom random(11);
  for (int s = 0; s < 18; ++s) {
    PlaneScene scene;
    scene.width = 200;
    scene.height = 150;
    for (int i = 0; i < 14; ++i) {
      const Vec2d c{random.uniform(10, 190), random.uniform(10, 140)};
      const auto v = [&](double r) { return Vec2d{random.uniform(-r, r), random.uniform(-r, r)}; };
      PlaneBody body;
      switch (i % 5) {
        case 0: body = plane_circle(c, random.uniform(3, 15)); break;
        case 1:
          body = plane_circle(c, 1);
          body.x_axis = v(15);
          body.y_axis = v(15);
          break;
        case 2:
          body.shape = PlaneBody::Shape::capsule;
          body.contours = {{c, c + v(25)}};
          body.radius = random.uniform(1, 8);
          break;
        case 3: body = plane_polygon({c, c + v(20), c + v(20), c + v(20), c + v(20)}); break;
        default: body.shape = PlaneBody::Shape::polyline; body.contours = {{c, c + v(30), c + v(30)}};
      }
      if (i % 4 == s % 4) {
        body.light.emplace();
        body.light->radiance = {1, 0.5, 0.05 * i};
        if (s % 3 == 1) body.light->range = 90;
        if (s % 6 == 2) body.light->profile = PlaneProfile::lambert;
        if (s % 6 == 5) body.light->gradient = PlaneGradient{c, c + v(20), {{0, {1, 0, 0}}, {1, {0, 1, 1}}}};
        if (s % 6 == 4) body.light->profile = PlaneProfile::inverse;
        if (s >= 12) {
          body.light->spot_axis = v(1);
          body.light->spot_half_angle = random.uniform(0.1, 3.1);
        }
      }
      scene.bodies.push_back(body);
    }
    // Places are rounded to 2^-25 of a tile of 16 pixels, on both sides of a difference. 1/r is known to 3e-5 at a thirtieth of a pixel,
    // and to 1e-5 from a tenth on.
    const double bound = s % 6 == 4 ? 3e-5 : 1e-5;
    expect_query(scene, 200, 150, 29, "shapes " + std::to_string(s), bound);
  }
}

// No light needs the method that queries every pixel on its own, which is tens of times slower.
TEST(PlaneFrame, TakesLightsOfEveryKindOnPacks) {
  PlaneScene scene;
  const auto add = [&](PlaneBody body) {
    for (int kind = 0; kind < 6; ++kind) {
      PlaneEmission& light = body.light.emplace();
      if (kind == 1) light.profile = PlaneProfile::lambert;
      if (kind == 2) light.profile = PlaneProfile::inverse;
      if (kind == 3) light.range = 100;
      if (kind == 4) light.spot_axis = {1, 0.3}, light.spot_half_angle = 1;
      if (kind == 5) light.gradient = PlaneGradient{{10, 10}, {60, 90}, {{0, {1, 0, 0}}, {0.4, {0, 1, 0}}, {1, {0, 0, 1}}}};
      scene.bodies.push_back(body);
    }
  };
  add(plane_circle({60, 60}, 20));
  PlaneBody ellipse = plane_circle({120, 60}, 20);
  ellipse.y_axis = {5, 7};
  add(ellipse);
  PlaneBody capsule;
  capsule.shape = PlaneBody::Shape::capsule;
  capsule.contours = {{{20, 100}, {60, 110}}};
  capsule.radius = 8;
  add(capsule);
  add(plane_polygon({{200, 200}, {230, 210}, {205, 240}}));
  scene.bodies.push_back(plane_circle({75, 75}, 12));  // an occluder that overlaps some
  scene.bodies.push_back(ellipse);
  scene.bodies.back().light.reset();
  scene.bodies.back().center = {130, 70};
  const PlaneWorld world(scene);
  Budget budget{Limits{}};
  EXPECT_FALSE(prepare_frame(world.impl(), budget).any_general);
}

TEST(PlaneFrame, EqualsTheQueryInDrawingsOfEveryLight) {
  for (const LightPairDrawing& drawing : all_drawings())
    expect_query(make_drawing(drawing), 97, 61, 11, drawing.shape + "-" + drawing.emission, drawing.emission == "inverse" ? 3e-5 : 1e-5);
}

TEST(PlaneFrame, EqualsTheQueryInTheProjectsScenes) {
  for (const char* name : {"lamps", "room", "city", "logo"}) {
    PlaneScene scene = load_plane_scene(test::kSourceDir + "/scenes/plane/" + name + ".svg").scene;
    scene.fit = PlaneFit::stretch;
    // With this size no pixel's centre lies on a line without thickness, where either side is a valid answer.
    expect_query(scene, 97, 61, 7, name);
  }
}

// The same drawing in any unit: identical pixels for powers of two; for other factors each is as near to the query as a frame is.
TEST(PlaneFrame, IsTheSameInAnyUnit) {
  const auto drawing = [](double unit) {
    PlaneScene scene;
    scene.width = 200 * unit;
    scene.height = 150 * unit;
    const auto at = [&](double x, double y) { return Vec2d{x * unit, y * unit}; };
    scene.bodies = {plane_circle(at(40.3, 50.1), 6.02 * unit), plane_polygon({at(100.3, 20.2), at(110.1, 30.7), at(90.6, 90.4)}),
                    plane_polygon({at(150.3, 100.2), at(170.7, 100.4), at(160.1, 120.6)}), plane_circle(at(70.2, 80.3), 10.04 * unit)};
    scene.bodies[0].light.emplace().range = 150 * unit;
    scene.bodies[2].light.emplace().profile = PlaneProfile::lambert;
    return scene;
  };
  const auto frame = [&](double unit) {
    PlaneFrameOptions options;
    options.width = 100;
    options.height = 75;
    return render_plane(PlaneWorld(drawing(unit)), options);
  };
  const Picture one = frame(1);
  EXPECT_GT(std::count_if(one.pixels.begin(), one.pixels.end(), [](Vec3f p) { return p.x > 0.01f; }), 100) << "light there is";
  for (double unit : {0x1p-20, 0.25, 4096.0}) {
    const Picture other = frame(unit);
    EXPECT_TRUE(std::equal(one.pixels.begin(), one.pixels.end(), other.pixels.begin())) << unit;
  }
  for (double unit : {1.0, 1e-6, 0.013, 4000.0}) expect_query(drawing(unit), 100, 75, 1, "in units of " + std::to_string(unit));
}

// Shapes with many edges in front of a light, in numbers that reach the merged spans and the bounded searches of shadows.
TEST(PlaneFrame, EqualsTheQueryBehindOutlinesOfManyEdges) {
  SceneRandom random(5);
  PlaneScene scene;
  scene.width = 160;
  scene.height = 120;
  for (int i = 0; i < 12; ++i) {
    std::vector<Vec2d> outline;
    const Vec2d c{random.uniform(30, 130), random.uniform(20, 100)};
    for (int k = 0; k < 150; ++k) {
      const double t = 2 * M_PI * k / 150, r = 7 * (1 + 0.4 * std::sin((3 + i % 4) * t));
      outline.push_back(c + Vec2d{r * std::cos(t), r * std::sin(t)});
    }
    scene.bodies.push_back(plane_polygon(outline));
  }
  for (Vec2d at : {Vec2d{10, 60}, Vec2d{150, 20}, Vec2d{80, 112}}) {
    scene.bodies.push_back(plane_circle(at, 5));
    scene.bodies.back().light.emplace();
  }
  expect_query(scene, 160, 120, 7, "outlines of many edges");
}

// Curves that emit light, and that others reach into: chains of edges, from outside their hulls and from within.
TEST(PlaneFrame, EqualsTheQueryAmongShiningCurves) {
  SceneRandom random(9);
  PlaneScene scene;
  scene.width = 160;
  scene.height = 120;
  for (int i = 0; i < 6; ++i) {
    std::vector<Vec2d> outline;
    const Vec2d c{30.0 + 50 * (i % 3), 35.0 + 50 * (i / 3)};
    for (int k = 0; k < 90; ++k) {
      const double t = 2 * M_PI * k / 90, r = 18 * (1 + 0.35 * std::sin((2 + i) * t));
      outline.push_back(c + Vec2d{r * std::cos(t), r * std::sin(t)});
    }
    scene.bodies.push_back(plane_polygon(outline));
    if (i % 2 == 0) scene.bodies.back().light.emplace();
  }
  for (int i = 0; i < 10; ++i) {
    const Vec2d c{random.uniform(5, 155), random.uniform(5, 115)};
    scene.bodies.push_back(plane_polygon({c, c + Vec2d{4, random.uniform(-3, 3)}, c + Vec2d{random.uniform(-3, 3), 5}}));
  }
  // A bowl: one chain whose hull contains lit pixels.
  std::vector<Vec2d> bowl{{150, 60}, {150, 118}, {108, 118}};
  for (double t : {0.3, 0.5, 0.7, 0.9, 1.1, 1.3}) bowl.push_back(Vec2d{108, 60} + Vec2d{std::sin(t), std::cos(t)} * 40.0);
  scene.bodies.push_back(plane_polygon(bowl));
  expect_query(scene, 160, 120, 7, "shining curves");
}

// Convex outlines, rings, islands within holes and beside them, spirals: closed runs, holes, bulges and bowls, with bodies in front of
// them, on them and within them.
TEST(PlaneFrame, EqualsTheQueryAroundOutlinesOfEveryTurn) {
  const auto round = [](Vec2d center, double radius, int count, double ripple = 0, double turn = 0) {
    std::vector<Vec2d> outline;
    for (int k = 0; k < count; ++k) {
      const double t = turn + 2 * M_PI * k / count, r = radius * (1 + ripple * std::sin(3 * t));
      outline.push_back(center + Vec2d{r * std::cos(t), r * std::sin(t)});
    }
    return outline;
  };
  std::vector<Vec2d> spiral;
  for (int k = 0; k < 60; ++k) spiral.push_back(Vec2d{100, 75} + Vec2d{std::cos(0.2 * k), std::sin(0.2 * k)} * (8 + 0.7 * k));
  for (int k = 59; k >= 0; --k) spiral.push_back(Vec2d{100, 75} + Vec2d{std::cos(0.2 * k), std::sin(0.2 * k)} * (6.5 + 0.7 * k));
  const std::vector<std::vector<std::vector<Vec2d>>> shapes = {
      {round({60, 60}, 25, 5), round({140, 90}, 30, 64, 0, 0.1)},
      {round({90, 70}, 50, 90), round({90, 70}, 35, 48), round({90, 70}, 12, 7), round({170, 40}, 14, 20)},
      {round({90, 70}, 50, 90, 0.3), round({90, 70}, 20, 48, 0.2), round({30, 130}, 12, 6)},
      {spiral}};
  SceneRandom random(21);
  for (std::size_t s = 0; s < shapes.size(); ++s)
    for (int emission = 0; emission < 5; ++emission) {
      PlaneScene scene;
      scene.width = 200;
      scene.height = 150;
      PlaneBody light = plane_polygon(shapes[s].front());
      light.contours = shapes[s];
      light.even_odd = true;
      light.light.emplace();
      if (emission == 1) light.light->range = 70;
      if (emission == 2) light.light->profile = PlaneProfile::lambert;
      if (emission == 3) light.light->spot_axis = {1, 0.6}, light.light->spot_half_angle = 1.2;
      if (emission == 4) light.light->gradient = PlaneGradient{{20, 30}, {150, 110}, {{0, {1, 0, 0}}, {0.4, {0, 1, 0}}, {1, {0, 0.5, 1}}}};
      scene.bodies = {light};
      for (int i = 0; i < 9; ++i) {
        const Vec2d c{random.uniform(5, 195), random.uniform(5, 145)};
        if (i % 3 == 0)
          scene.bodies.push_back(plane_circle(c, random.uniform(2, 6)));
        else
          scene.bodies.push_back(plane_polygon({c, c + Vec2d{7, random.uniform(-4, 4)}, c + Vec2d{random.uniform(-3, 3), 9}}));
      }
      expect_query(scene, 200, 150, 7, "outlines " + std::to_string(s) + ", " + std::to_string(emission));
    }
}

// A few corners in any order: outlines that cross themselves, so that loops meet at their tips, and concave ones whose runs begin before
// the first corner and end behind it. Uniform lights use a run's chord. Others use its edges, each over the visible part of the chord.
TEST(PlaneFrame, EqualsTheQueryAroundCornersInAnyOrder) {
  PlaneScene scene;
  scene.width = scene.height = 80;
  const auto expect = [&](const std::vector<Vec2d>& corners, int kind, int width, const std::string& what) {
    PlaneBody light = plane_polygon(corners);
    light.light.emplace();
    if (kind == 1) light.light->profile = PlaneProfile::lambert;
    if (kind == 2) light.light->range = 40;
    if (kind == 3) light.light->gradient = PlaneGradient{{20, 20}, {60, 60}, {{0, {1, 0.5, 0}}, {1, {0, 0.5, 1}}}};
    scene.bodies = {light};
    expect_query(scene, width, width, 7, what + ", emission " + std::to_string(kind));
  };
  for (int kind = 0; kind < 4; ++kind) {
    expect({{25.4, 33.5}, {39.5, 19.2}, {30.7, 27.7}, {19.6, 20.0}}, kind, 80, "a spike over the first corner");
    expect({{53.5, 10}, {60.8, 9.5}, {58.1, -1.1}, {61.1, -0.6}, {66.8, 21.2}, {63.2, 7.8}, {77.9, -3.7}, {49.5, 3.7}, {61.7, 19.4}}, kind,
           80, "loops");
    // From close to the chord of the pocket's first two edges, its far end is visible behind the second edge's own line.
    expect({{75, 40}, {30, 25}, {30.2, 27}, {28, 75}, {20, 75}, {20, 15}, {75, 15}}, kind, 640, "a pocket");
  }
  SceneRandom random(3);
  for (int s = 0; s < 80; ++s) {
    const double size = s % 2 == 0 ? 20 : 5;
    const Vec2d center{random.uniform(20, 60), random.uniform(20, 60)};
    std::vector<Vec2d> corners;
    for (int k = 0; k < 4 + s % 6; ++k) corners.push_back(center + Vec2d{random.uniform(-size, size), random.uniform(-size, size)});
    expect(corners, 0, 80, "corners " + std::to_string(s));
    expect(corners, 1 + s % 3, s % 4 == 0 ? 320 : 80, "corners " + std::to_string(s));
  }
}

// The error of quadrature is relative to the light present, in any unit of length: 6e-5 of it was lost in some tiles.
TEST(PlaneFrame, EqualsTheQueryBesideAnEllipseDividedByTheDistance) {
  PlaneScene scene;
  scene.width = scene.height = 80;
  PlaneBody light;
  light.shape = PlaneBody::Shape::ellipse;
  light.center = {40.65, 45.356};
  light.x_axis = {13.333, 0};
  light.y_axis = {0, 5};
  light.light.emplace().profile = PlaneProfile::inverse;
  scene.bodies = {light};
  // Nearer than a pixel, single precision loses the distance.
  const auto apart = [&](Vec2d p) {
    const Vec2d d = p - light.center;
    return d.x * d.x / (14.333 * 14.333) + d.y * d.y / (6 * 6) > 1;
  };
  expect_query(scene, 640, 640, 5, "beside an ellipse", 1e-5, apart);
}

// A gradient cuts a line's edges, and a run may have only some of the parts: from beyond its end, the rest of the edge occludes it.
TEST(PlaneFrame, EqualsTheQueryBehindTheRestOfACutEdge) {
  PlaneScene scene;
  scene.width = scene.height = 80;
  PlaneBody line;
  line.shape = PlaneBody::Shape::polyline;
  line.light.emplace().gradient = PlaneGradient{{55.4, 62.6}, {52, 59.8}, {{0, {1, 0, 0}}, {0.29, {0, 0.25, 1}}, {1, {1, 1, 1}}}};
  line.contours = {{{26.6, 77.1}, {38.8, 67.8}, {50.9, 71.1}}};
  scene.bodies = {line};
  expect_query(scene, 640, 640, 7, "a bend");
  SceneRandom random(4);
  for (int s = 0; s < 40; ++s) {
    const auto somewhere = [&] { return Vec2d{random.uniform(10, 70), random.uniform(10, 70)}; };
    line.contours = {{somewhere(), somewhere(), somewhere(), somewhere()}};
    line.light->gradient->from = somewhere();
    line.light->gradient->to = somewhere();
    scene.bodies = {line};
    expect_query(scene, 320, 320, 7, "line " + std::to_string(s));
  }
}

// From outside, a convex outline of many edges is one light to every tile from which nothing occludes it, with any emission.
TEST(PlaneFrame, TakesAConvexOutlineAsOne) {
  PlaneScene scene;
  scene.width = scene.height = 160;
  std::vector<Vec2d> outline;
  for (int k = 0; k < 40; ++k) outline.push_back(Vec2d{80, 80} + Vec2d{std::cos(0.05 * M_PI * k), std::sin(0.05 * M_PI * k)} * 6.0);
  scene.bodies = {plane_polygon(outline)};
  scene.bodies[0].light.emplace();
  for (bool gradient : {false, true}) {
    if (gradient) scene.bodies[0].light->gradient = PlaneGradient{{70, 70}, {90, 90}, {{0, {1, 0, 0}}, {1, {0, 1, 0}}}};
    PlaneFrameStats stats;
    render_plane(PlaneWorld(scene), {}, &stats);
    const std::uint64_t tiles = 100, around = 4;  // the light lies in four tiles, which see its edges
    EXPECT_GE(stats.tile_lights, tiles - around);
    EXPECT_LT(stats.tile_lights, tiles - around + around * 40);
  }
}

// The square's far corner is in front of the light's edge, and past the tile from the light: it is not beside the light.
TEST(PlaneFrame, EqualsTheQueryAboveACornerThatLooksAwayFromALight) {
  PlaneScene scene;
  scene.width = scene.height = 320;
  scene.bodies = {plane_polygon({{44.3, 116}, {63.5, 17.6}, {90, 110}}), plane_polygon({{16, 216}, {116, 216}, {116, 316}, {16, 316}})};
  scene.bodies[0].light.emplace();
  expect_query(scene, 320, 320, 3, "above a corner");
}

// Pixel centres on outlines, up to rounding: a pixel that is not within a light sees its edge as half of all directions.
TEST(PlaneFrame, EqualsTheQueryOnOutlines) {
  for (double turn : {0.0, 0.2}) {
    PlaneScene scene;
    scene.width = 64;
    scene.height = 36;
    const auto at = [&](double x, double y) { return Vec2d{x - turn * y, y + turn * x}; };
    // Their edges go through the centres of pixels, and between them.
    scene.bodies = {plane_polygon({at(20, 4), at(40, 4), at(40, 14), at(20, 14)}),
                    plane_polygon({at(30, 20), at(45, 20), at(45, 25), at(30, 25)})};
    scene.bodies[0].light.emplace().gradient = PlaneGradient{{20, 0}, {40, 10}, {{0, {1, 0.5, 0}}, {1, {0, 0.5, 1}}}};
    for (int width : {64, 192})
      expect_query(scene, width, width * 9 / 16, 1, fmt::format("on outlines turned by {}, {} wide", turn, width));
  }
  // One pixel of this drawing was dark.
  expect_query(make_drawing({"polygon", "gradient"}), 960, 540, 1, "the drawing of polygons");
}

// A window of a scene much larger than the picture: far lights, and edges at a grazing angle.
TEST(PlaneFrame, EqualsTheQueryInASmallWindow) {
  PlaneScene scene = load_plane_scene(test::kSourceDir + "/scenes/plane/logo.svg").scene;
  scene.fit = PlaneFit::stretch;
  for (const Vec2d corner : {Vec2d{301, 155}, Vec2d{60, 340}, Vec2d{500, 100}}) {
    scene.origin = corner;
    scene.width = scene.height = 2;
    expect_query(scene, 40, 40, 7, "a small window");
  }
}

}  // namespace steradian::plane::frame_test
