// The exact method against rays, in scenes of every kind.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "plane/exact/emission.h"
#include "plane/exact/outline.h"
#include "plane/exact/random.h"
#include "plane/exact/world.h"
#include "steradian/error.h"
#include "support/plane_families.h"

namespace steradian::plane::world_test {
namespace {

using std::numbers::pi;

// Evenly spaced rays. The integrand has a finite number of jumps, each of at most `largest` radiance. Every jump adds at most one step of
// angle, 2 pi / count, to the sum of 2 pi.
Vec3d mean_of_rays(const PlaneWorld& world, Vec2d p, int count) {
  const auto& impl = world.impl();
  p = p * impl.scale;
  const auto inside = impl.inside(p);
  if (inside.dark) return {};
  Vec3d sum;
  for (int i = 0; i < count; ++i) {
    const double angle = 2 * pi * (i + 0.5) / count;
    const Vec2d u{std::cos(angle), std::sin(angle)};
    const RayHit hit = impl.grid.first_hit(p, u, inside.body);
    if (hit.curve == nullptr) continue;
    const auto& light = impl.scene.bodies[static_cast<std::size_t>(hit.curve->body)].light;
    if (!light) continue;
    sum += hit.curve->body == inside.body ? radiance_at(*light, p) : radiance_along(*hit.curve, *light, p, u, hit.distance);
  }
  return sum / static_cast<double>(count);
}

void expect_rays(const PlaneWorld& world, Vec2d p, int rays, double bound, const std::string& what) {
  const Vec3d exact = world.query(p).radiance, sampled = mean_of_rays(world, p, rays);
  EXPECT_NEAR(exact.x, sampled.x, bound) << what << " at (" << p.x << ", " << p.y << ")";
  EXPECT_NEAR(exact.y, sampled.y, bound) << what << " at (" << p.x << ", " << p.y << ")";
  EXPECT_NEAR(exact.z, sampled.z, bound) << what << " at (" << p.x << ", " << p.y << ")";
}

PlaneWorld world_of(std::vector<PlaneBody> bodies) {
  PlaneScene scene;
  scene.width = scene.height = 100;
  scene.bodies = std::move(bodies);
  return PlaneWorld(scene);
}

PlaneBody lit(PlaneBody body, PlaneEmission emission = {}) {
  body.light = emission;
  return body;
}

PlaneBody box(double x, double y, double w, double h) { return plane_polygon({{x, y}, {x + w, y}, {x + w, y + h}, {x, y + h}}); }

PlaneBody capsule(Vec2d a, Vec2d b, double r) {
  PlaneBody body;
  body.shape = PlaneBody::Shape::capsule;
  body.contours = {{a, b}};
  body.radius = r;
  return body;
}

PlaneBody ellipse(Vec2d c, Vec2d x, Vec2d y) {
  PlaneBody body = plane_circle(c, 1);
  body.x_axis = x;
  body.y_axis = y;
  return body;
}

}  // namespace

// 1e5 evenly spaced rays: a jump costs at most 1e-5 of the emission, and jumps of opposite sign cancel in part. Three of them, the
// specification's bound of 3e-5, are not exceeded here.
TEST(PlaneExact, AgreesWithHundredThousandRaysOnAllFamilies) {
  for (int family = 1; family <= kPlaneFamilies; ++family) {
    double worst = 0, squares = 0;
    int points = 0;
    for (std::uint64_t s = 0; s < 4; ++s) {
      const PlaneWorld world(make_plane_family(family, s));
      for (Vec2d p : points_outside(world, 6, s + 77)) {
        const double error = std::fabs(world.query(p).radiance.x - mean_of_rays(world, p, 100'000).x);
        worst = std::max(worst, error);
        squares += error * error;
        ++points;
        EXPECT_LE(error, 3e-5) << plane_family_name(family) << ", seed " << s << " at (" << p.x << ", " << p.y << ")";
      }
    }
    std::printf("family %2d: rms %.1e, largest %.1e of %d points\n", family, std::sqrt(squares / points), worst, points);
  }
}

TEST(PlaneExact, UnoccludedCircleIsItsAngle) {
  const PlaneWorld world = world_of({lit(plane_circle({50, 50}, 10))});
  EXPECT_NEAR(world.query({50, 10}).radiance.x, std::asin(10.0 / 40) / pi, 1e-15);
  EXPECT_NEAR(world.query({50, 10}).moment_y.x, 2 * (10.0 / 40) / (2 * pi), 1e-15);
  EXPECT_NEAR(world.query({50, 10}).moment_x.x, 0, 1e-15);
}

TEST(PlaneExact, InsideALightItsEmissionComesFromEverywhereNothingInsideBlocks) {
  PlaneEmission e;
  e.radiance = {2, 3, 4};
  const PlaneWorld alone = world_of({lit(box(10, 10, 80, 80), e)});
  EXPECT_NEAR(alone.query({50, 30}).radiance.y, 3, 1e-14);
  // An outside occluder does not matter; one inside occludes its angle.
  const PlaneWorld with = world_of({lit(box(10, 10, 80, 80), e), box(95, 0, 5, 100), plane_circle({50, 50}, 10)});
  EXPECT_NEAR(with.query({50, 30}).radiance.x, 2 * (1 - 2 * std::asin(0.5) / (2 * pi)), 1e-14);
}

// The range applies to the light outside. Within it, a box further away than the range blocks the same.
TEST(PlaneExact, InsideALightWithARangeWhatIsBeyondItBlocks) {
  PlaneBody light = lit(plane_circle({50, 50}, 40));
  light.light->range = 20;
  const PlaneWorld world = world_of({light, box(80, 49, 2, 2)});
  // Its near side, from distances of 30 and 60.
  EXPECT_NEAR(world.query({50, 50}).radiance.x, 1 - std::atan2(1, 30) / M_PI, 1e-12);
  EXPECT_NEAR(world.query({20, 50}).radiance.x, 1 - std::atan2(1, 60) / M_PI, 1e-12);
}

TEST(PlaneExact, OnALightsEdgeAPointIsInside) {
  const PlaneWorld world = world_of({lit(plane_circle({22, 190}, 4))});
  for (Vec2d p : {Vec2d{22, 186}, {26, 190}, {18, 190}}) EXPECT_NEAR(world.query(p).radiance.x, 1, 1e-12) << p.x << ", " << p.y;
}

// Points on its edge up to rounding; rounding puts some within. A box outside of the light occludes nothing.
TEST(PlaneExact, OnALightsEdgeWhatIsOutsideDoesNotBlock) {
  const PlaneWorld world = world_of({lit(plane_polygon({{20, 20}, {60, 28}, {58, 60}, {18, 60}})), box(30, 5, 20, 10)});
  int within = 0;
  for (int k = 1; k < 40; ++k) {
    const Vec2d p{20.0 + k, 20 + 0.2 * k};
    const double light = world.query(p).radiance.x;
    const bool inside = std::fabs(light - 1) < 1e-12;
    within += inside;
    EXPECT_TRUE(inside || std::fabs(light - 0.5) < 1e-9) << k << ": " << light;
  }
  EXPECT_GT(within, 0);
}

TEST(PlaneExact, InsideSeveralLightsTheLastShines) {
  PlaneEmission red, blue;
  red.radiance = {1, 0, 0};
  blue.radiance = {0, 0, 1};
  const PlaneWorld world = world_of({lit(plane_circle({45, 50}, 20), red), lit(plane_circle({55, 50}, 20), blue)});
  EXPECT_NEAR(world.query({50, 50}).radiance.z, 1, 1e-14);
  EXPECT_NEAR(world.query({50, 50}).radiance.x, 0, 1e-14);
  EXPECT_NEAR(world.query({27, 50}).radiance.x + world.query({27, 50}).radiance.z, 1, 1e-14);
}

TEST(PlaneExact, InsideAnOccluderIsDarkEvenWithinALight) {
  const PlaneWorld world = world_of({lit(box(0, 0, 50, 50)), box(40, 0, 60, 50)});
  EXPECT_EQ(world.query({45, 25}).radiance.x, 0);
  EXPECT_EQ(world.query({80, 25}).radiance.x, 0);
  EXPECT_EQ(world.query({50, 25}).radiance.x, 0) << "on the edge of the light, in the occluder";
}

TEST(PlaneExact, OfCoincidentEdgesTheLightIsSeen) {
  // A lamp in the wall, its face flush with the wall's: from above the light is the same as without the wall.
  const PlaneWorld flush = world_of({lit(box(40, 50, 20, 5)), box(0, 50, 100, 20)});
  for (Vec2d p : {Vec2d{50, 20}, {10, 40}, {99, 49}, {50, 49.99}}) {
    const Vec2d a = Vec2d{40, 50} - p, b = Vec2d{60, 50} - p;
    EXPECT_NEAR(flush.query(p).radiance.x, std::atan2(std::fabs(cross(a, b)), dot(a, b)) / (2 * pi), 1e-12) << p.x;
  }
  EXPECT_EQ(flush.query({50, 80}).radiance.x, 0) << "behind the wall";
  // A lamp on the wall: no light behind the wall.
  const PlaneWorld on = world_of({box(0, 50, 100, 20), lit(box(40, 45, 20, 5))});
  EXPECT_EQ(on.query({50, 80}).radiance.x, 0);
  EXPECT_NEAR(on.query({50, 44}).radiance.x, world_of({lit(box(40, 45, 20, 5))}).query({50, 44}).radiance.x, 1e-12);
}

TEST(PlaneExact, LightsOccludeLights) {
  PlaneEmission red, blue;
  red.radiance = {1, 0, 0};
  blue.radiance = {0, 0, 1};
  const PlaneWorld world = world_of({lit(box(40, 40, 20, 2), red), lit(box(30, 60, 40, 2), blue)});
  const Vec3d v = world.query({50, 20}).radiance;
  EXPECT_NEAR(v.x, 2 * std::atan2(10, 20) / (2 * pi), 1e-14);
  EXPECT_NEAR(v.z, 2 * (std::atan2(20, 40) - std::atan2(10, 20)) / (2 * pi), 1e-14) << "wholly hidden";
}

TEST(PlaneExact, OverlappingShapesOfEveryKindAgreeWithRays) {
  SceneRandom random(5);
  for (int s = 0; s < 30; ++s) {
    std::vector<PlaneBody> bodies;
    for (int i = 0; i < 9; ++i) {
      const Vec2d c{random.uniform(10, 90), random.uniform(10, 90)};
      const auto v = [&](double r) { return Vec2d{random.uniform(-r, r), random.uniform(-r, r)}; };
      PlaneBody body;
      switch (i % 5) {
        case 0: body = plane_circle(c, random.uniform(3, 15)); break;
        case 1: body = ellipse(c, v(15), v(15)); break;
        case 2: body = capsule(c, c + v(25), random.uniform(1, 8)); break;
        case 3: body = plane_polygon({c, c + v(20), c + v(20), c + v(20), c + v(20)}); break;
        default: body.shape = PlaneBody::Shape::polyline; body.contours = {{c, c + v(30), c + v(30)}};
      }
      if (i % 3 == 0) {
        body.light.emplace();
        body.light->radiance = {1, 0.5, 0.1 * i};
      }
      bodies.push_back(body);
    }
    const PlaneWorld world = world_of(bodies);
    // Up to some twenty visible jumps: 20 of 1 / 40000 each bounds the rays' error.
    for (int k = 0; k < 6; ++k)
      expect_rays(world, {random.uniform(0, 100), random.uniform(0, 100)}, 40'000, 5e-4, "scene " + std::to_string(s));
  }
}

// Every emission against rays: jumps and a smooth integrand; with 2e5 rays the error is at most 6 jumps of 5e-6.
TEST(PlaneEmissionKinds, AgreeWithRays) {
  const auto check = [](const char* what, const PlaneEmission& e) {
    const std::vector<PlaneBody> shapes = {box(40, 40, 20, 12), plane_circle({50, 50}, 12), ellipse({50, 50}, {15, 5}, {-4, 9}),
                                           capsule({40, 45}, {60, 55}, 6)};
    for (const PlaneBody& shape : shapes) {
      const PlaneWorld world = world_of({lit(shape, e), box(30, 30, 12, 3), plane_circle({66, 52}, 3)});
      for (Vec2d p : {Vec2d{50, 20}, {20, 25}, {80, 50}, {45, 90}, {33, 48}, {90, 95}}) expect_rays(world, p, 200'000, 3e-5, what);
    }
  };
  PlaneEmission e;
  e.radiance = {1, 0.5, 0.25};
  check("uniform", e);
  e.profile = PlaneProfile::lambert;
  check("lambert", e);
  e.profile = PlaneProfile::inverse;
  check("inverse", e);
  e.profile = PlaneProfile::uniform;
  for (double range : {15.0, 30.0, 60.0, 500.0}) {
    e.range = range;
    check("range", e);
    e.profile = PlaneProfile::lambert;
    check("range and lambert", e);
    e.profile = PlaneProfile::uniform;
  }
  e.gradient = PlaneGradient{{42, 40}, {58, 50}, {{0.1, {1, 0, 0}}, {0.5, {0, 1, 0}}, {0.8, {0, 0, 1}}}};
  check("gradient and range", e);
  e.range = std::numeric_limits<double>::infinity();
  check("gradient", e);
  e.profile = PlaneProfile::lambert;
  check("gradient and lambert", e);
  e.profile = PlaneProfile::uniform;
  e.spot_axis = {0.3, 1};
  e.spot_half_angle = 0.6;
  check("spot", e);
}

TEST(PlaneEmissionKinds, MomentsAgreeWithRays) {
  PlaneEmission e;
  e.radiance = {1, 0.5, 0.25};
  for (int kind = 0; kind < 8; ++kind) {
    e.profile = static_cast<PlaneProfile>(kind % 3);
    e.range = kind < 3 ? std::numeric_limits<double>::infinity() : 45;
    if (kind >= 6) e.gradient = PlaneGradient{{42, 40}, {58, 50}, {{0.1, {1, 0, 0}}, {0.8, {0, 0, 1}}}};
    for (const PlaneBody& shape : {box(40, 40, 20, 12), plane_circle({50, 50}, 12)}) {
      const PlaneWorld world = world_of({lit(shape, e), box(30, 30, 12, 3)});
      for (Vec2d p : {Vec2d{50, 20}, {20, 25}, {80, 50}}) {
        // Stratified and random: a jump errs by at most one of 20000 sectors; there are two jumps for each body.
        const PlaneLight exact = world.query(p), rays = world.query(p, PlaneMethod::sampled, {20'000, 3});
        EXPECT_NEAR(exact.moment_x.x, rays.moment_x.x, 2e-4) << kind;
        EXPECT_NEAR(exact.moment_y.x, rays.moment_y.x, 2e-4) << kind;
        EXPECT_NEAR(exact.moment_y.z, rays.moment_y.z, 2e-4) << kind;
      }
    }
  }
}

TEST(PlanePar, IsExactForDisjointConvexBodies) {
  for (int family : {1, 2}) {
    const FamilyError e = measure_family(family, PlaneMethod::par, 40, 60);
    EXPECT_LT(e.mean_percent, 1e-9) << plane_family_name(family) << ", " << e.points << " points";
    EXPECT_EQ(e.off_percent, 0);
  }
}

namespace {

// The fraction of the turn that `par` finds for a lamp seen from above, past one box. The lamp's near face is from (40, 22) to (60, 22).
double par_past(const PlaneBody& occluder) {
  return world_of({lit(box(40, 20, 20, 2)), occluder}).query({50, 90}, PlaneMethod::par).radiance.x;
}
double turns(double from, double to, double distance) {
  return (std::atan2(to - 50, distance) - std::atan2(from - 50, distance)) / (2 * pi);
}

}  // namespace

// The three cases of the published depth test, each with a box that occludes and one that does not. The angles are those of the tangent
// vertices.
TEST(PlanePar, IntervalsThatDoNotMeetLeaveTheLight) {
  EXPECT_NEAR(par_past(box(75, 50, 10, 5)), turns(40, 60, 68), 1e-14) << "nearer than the lamp";
  EXPECT_NEAR(par_past(box(90, 5, 5, 5)), turns(40, 60, 68), 1e-14) << "farther";
}

TEST(PlanePar, AKeyRayThatCrossesTheChordIsOccluded) {
  EXPECT_NEAR(par_past(box(20, 48, 30, 2)), turns(50, 60, 68), 1e-14) << "the intervals overlap in part";
  EXPECT_NEAR(par_past(box(20, 48, 60, 2)), 0, 1e-14) << "the lamp's interval is within the box's";
  // The key rays end at the lamp: behind it they cross nothing.
  EXPECT_NEAR(par_past(box(20, 5, 30, 2)), turns(40, 60, 68), 1e-14);
  EXPECT_NEAR(par_past(box(0, 5, 100, 2)), turns(40, 60, 68), 1e-14);
}

TEST(PlanePar, ABoxWithinTheLightsIntervalIsJudgedByItsOwnKeyRays) {
  EXPECT_NEAR(par_past(box(48, 48, 4, 2)), turns(40, 60, 68) - turns(48, 52, 40), 1e-14);
  EXPECT_NEAR(par_past(box(48, 5, 4, 2)), turns(40, 60, 68), 1e-14) << "its key rays cross the lamp's chord: it is behind";
}

// The error of the published heuristic. It was measured on other random scenes of the same kind: the size is the same, not the digits.
TEST(PlanePar, ErrsWhereItsAssumptionsFail) {
  std::printf("%s", plane_error_table(12, 120).c_str());
  const struct {
    int family;
    double low, high;
  } kMean[] = {{3, 3, 30}, {4, 20, 120}, {6, 0.3, 4}, {7, 30, 200}, {8, 5, 30}, {9, 8, 60}, {10, 0.01, 1}};
  for (const auto& k : kMean) {
    const FamilyError e = measure_family(k.family, PlaneMethod::par, 12, 120);
    EXPECT_GT(e.mean_percent, k.low) << plane_family_name(k.family);
    EXPECT_LT(e.mean_percent, k.high) << plane_family_name(k.family);
  }
  EXPECT_GT(measure_family(5, PlaneMethod::par, 12, 120).off_percent, 3) << "light leaks out of the box";
}

// From inside, the two extreme vertices span an arbitrary angle. The ratio is the mean of that angle over the turn, on polygons of the
// families' kind. An earlier measurement on others gave 47.5 %.
TEST(PlanePar, SeesHalfOfALightFromInside) {
  SceneRandom random(3);
  double sum = 0;
  int count = 0;
  for (std::uint64_t s = 1; s <= 60; ++s) {
    const PlaneScene scene = make_plane_family(1, s);
    const PlaneWorld world(scene);
    for (const PlaneBody& b : scene.bodies) {
      if (!b.light) continue;
      const Box2d box = bounds_of(b);
      for (int i = 0; i < 100; ++i) {
        const Vec2d p{random.uniform(box.low.x, box.high.x), random.uniform(box.low.y, box.high.y)};
        if (!contains(b, p)) continue;
        EXPECT_NEAR(world.query(p).radiance.x, b.light->radiance.x, 1e-12) << "nothing else is in there";
        sum += world.query(p, PlaneMethod::par).radiance.x / b.light->radiance.x;
        ++count;
      }
    }
  }
  std::printf("inside a light: `par` gives %.1f %% of the true value, mean of %d points\n", 100 * sum / count, count);
  // A mean over 60 polygons varies by a few percent.
  EXPECT_NEAR(sum / count, 0.475, 0.02);
}

TEST(PlanePar, RefusesLightsThatDoNotShineAlike) {
  const auto with = [](auto change) {
    PlaneScene scene;
    scene.bodies.push_back(plane_circle({256, 256}, 20));
    scene.bodies.back().name = "lamp";
    change(scene.bodies.back().light.emplace());
    return PlaneWorld(scene);
  };
  EXPECT_GT(with([](PlaneEmission&) {}).query({100, 100}, PlaneMethod::par).radiance.x, 0);
  const PlaneWorld worlds[] = {with([](PlaneEmission& e) { e.range = 300; }),
                               with([](PlaneEmission& e) { e.profile = PlaneProfile::lambert; }), with([](PlaneEmission& e) {
                                 e.spot_axis = {1, 0};
                                 e.spot_half_angle = 1;
                               }),
                               with([](PlaneEmission& e) {
                                 e.gradient = PlaneGradient{{0, 0}, {512, 0}, {{0, {1, 1, 1}}}};
                               })};
  for (const PlaneWorld& world : worlds) {
    try {
      world.query({100, 100}, PlaneMethod::par);
      ADD_FAILURE() << "answered";
    } catch (const Error& e) {
      EXPECT_NE(std::string(e.what()).find("lamp"), std::string::npos) << e.what();
    }
    EXPECT_NO_THROW(world.query({100, 100}));
  }
}

// A bow tie is two triangles. The outline of two overlapping squares is the union's, or the region in one of them alone.
TEST(PlaneOutline, IsTakenApartWhereItCrossesItself) {
  const auto outline = [](std::vector<std::vector<Vec2d>> contours, bool even_odd) {
    PlaneBody body = plane_polygon(contours.front());
    body.contours = std::move(contours);
    body.even_odd = even_odd;
    return outline_of(body, 0);
  };
  const auto one_sided = [](const std::vector<Curve>& curves) {
    return std::none_of(curves.begin(), curves.end(), [](const Curve& c) { return c.two_sided; });
  };
  const std::vector<Curve> tie = outline({{{0, 0}, {10, 10}, {10, 0}, {0, 10}}}, false);
  EXPECT_EQ(tie.size(), 6u);
  EXPECT_TRUE(one_sided(tie));
  double area = 0;
  for (const Curve& c : tie) area += 0.5 * cross(c.a, c.b);
  EXPECT_NEAR(area, 50, 1e-12) << "the body to the left of every edge";
  const std::vector<Vec2d> one{{0, 0}, {10, 0}, {10, 10}, {0, 10}}, other{{5, 5}, {15, 5}, {15, 15}, {5, 15}};
  EXPECT_EQ(outline({one, other}, false).size(), 8u);
  EXPECT_EQ(outline({one, other}, true).size(), 12u);
  EXPECT_TRUE(one_sided(outline({one, other}, true)));
}

TEST(PlaneSampled, ApproachesExact) {
  const PlaneWorld world(make_plane_family(8, 1));
  for (Vec2d p : points_outside(world, 20, 9))
    // At most 40 jumps (20 bodies), each in one of 4000 sectors.
    EXPECT_NEAR(world.query(p).radiance.x, world.query(p, PlaneMethod::sampled, {4000, 1}).radiance.x, 40.0 / 4000);
}

TEST(PlaneMarched, ApproachesExactUpToItsHitDistance) {
  const PlaneWorld world = world_of({lit(plane_circle({50, 50}, 10)), box(30, 30, 10, 10)});
  for (Vec2d p : {Vec2d{10, 10}, {90, 20}, {50, 80}})
    EXPECT_NEAR(world.query(p).radiance.x, world.query(p, PlaneMethod::marched, {2000, 1}).radiance.x, 4.0 / 2000 + 1e-3);
}

TEST(PlaneWorld, RefusesWhatIsNotANumberWithTheBodysName) {
  PlaneBody bad = box(0, 0, std::nan(""), 1);
  bad.name = "lamp7";
  try {
    world_of({bad});
    FAIL();
  } catch (const Error& e) {
    EXPECT_NE(std::string(e.what()).find("lamp7"), std::string::npos) << e.what();
  }
}

}  // namespace steradian::plane::world_test
