// Visible parts by the tree of lines and slopes, against the lower envelope by angles; weights against quadrature.
#include "plane/bounce/outlook.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <numbers>

#include "plane/bounce/weigh.h"
#include "plane/exact/random.h"

namespace steradian::plane::outlook_test {
namespace {

using std::numbers::pi;

// Boxes, lines and rounds that cut each other. In `kind` 1 some are flush with others, in 2 there are more cuts than the tree accepts.
PlaneScene scene_of(int kind, SceneRandom& random) {
  PlaneScene scene;
  scene.width = scene.height = 1000;
  const int count = kind == 2 ? 200 : 40;
  for (int i = 0; i < count; ++i) {
    Vec2d c{random.uniform(0, 1000), random.uniform(0, 1000)};
    double t = random.uniform(0, pi), h = kind == 2 ? 900 : random.uniform(5, 120);
    if (kind == 1) c = {50 * std::round(c.x / 50), 50 * std::round(c.y / 50)}, t = 0, h = 50;
    const Vec2d x{h * std::cos(t), h * std::sin(t)}, y = Vec2d{-x.y, x.x} * (kind == 1 ? 0.5 : random.uniform(0.1, 1));
    PlaneBody body = plane_polygon({c - x - y, c + x - y, c + x + y, c - x + y});
    if (kind == 2 || i % 5 == 4) {
      body = {};
      body.shape = PlaneBody::Shape::polyline;
      body.contours = {{c - x, c + x, c + y}};
    } else if (i % 5 == 3) {
      body = plane_circle(c, h);
    } else if (i % 5 == 2 && kind == 0) {
      body = {};
      body.shape = PlaneBody::Shape::capsule;
      body.contours = {{c - x, c + x}};
      body.radius = 0.3 * h;
    }
    body.albedo = Vec3d{1, 1, 1};
    if (i % 3 == 0) body.light.emplace();
    scene.bodies.push_back(body);
  }
  return scene;
}

}  // namespace

TEST(PlaneOutlook, SeesWhatTheLowerEnvelopeSees) {
  for (int kind : {0, 1, 2}) {
    SceneRandom random(static_cast<std::uint64_t>(31 + kind));
    const PlaneWorld owner(scene_of(kind, random));
    const World& world = owner.impl();
    const Outlook outlook(world);
    std::vector<const Curve*> curves;
    for (const Curve& c : world.curves) curves.push_back(&c);
    const BoundaryElements elements(world, 1e9, 1);
    int places = 0, directions = 0;
    std::vector<SeenPart> parts;
    for (std::size_t k = 0; places < 60; k = (k + 7) % elements.all().size()) {
      const BoundaryElement& element = elements.all()[k];
      const ElementPlace place = place_on(world, element, random.uniform(0.05, 0.95));
      if (!is_open(world, place)) continue;
      ++places;
      outlook.look(&world.curves[element.curve], place.at, place.normal, parts);
      for (std::size_t i = 0; i < parts.size(); ++i) {
        EXPECT_LT(parts[i].begin, parts[i].end);
        if (i > 0) {
          EXPECT_LE(parts[i - 1].end, parts[i].begin);
        }
      }
      std::vector<const Curve*> others = curves;
      std::erase(others, &world.curves[element.curve]);
      const std::vector<Visible> envelope = lower_envelope(others, place.at, world.scene.bodies, {-1});
      const double middle = angle_of(place.normal);
      for (int i = 0; i < 200; ++i) {
        const double turn = random.uniform(-0.499, 0.499) * pi, slope = std::tan(turn), angle = std::remainder(middle + turn, 2 * pi);
        const Visible* seen = nullptr;
        bool close = false;  // to an end, where rounding decides
        for (const Visible& v : envelope) {
          if (v.begin <= angle && angle < v.end) seen = &v;
          close |= std::fabs(v.begin - angle) < 1e-9 || std::fabs(v.end - angle) < 1e-9;
        }
        const SeenPart* part = nullptr;
        for (const SeenPart& p : parts)
          if (p.begin <= slope && slope < p.end) part = &p;
        if (close) continue;
        ++directions;
        ASSERT_EQ(part == nullptr, seen == nullptr) << "kind " << kind << ", place " << places << ", turn " << turn;
        if (part == nullptr || part->curve == seen->curve) continue;
        // Another edge at the same place is accepted: of the same body, or equally bright.
        const Vec2d u{std::cos(angle), std::sin(angle)};
        EXPECT_NEAR(distance_along(*part->curve, part->back, place.at, u), distance_along(*seen->curve, seen->back, place.at, u), 1e-6)
            << "kind " << kind << ", place " << places << ", turn " << turn;
        EXPECT_EQ(part->curve->body, seen->curve->body);
      }
    }
    std::printf("kind %d: %zu curves, %d directions from %d places\n", kind, world.curves.size(), directions, places);
    EXPECT_GT(directions, 5000);
  }
}

// Reference: ten thousand steps of the angle, for walls near and far, long and short.
TEST(PlaneOutlook, WeighsPiecesAsQuadratureDoes) {
  SceneRandom random(3);
  double worst = 0;
  for (int repeat = 0; repeat < 20; ++repeat) {
    PlaneScene scene;
    scene.width = scene.height = 1000;
    const Vec2d a{random.uniform(0, 1000), random.uniform(0, 1000)}, b{random.uniform(0, 1000), random.uniform(0, 1000)};
    PlaneBody line;
    line.shape = PlaneBody::Shape::polyline;
    line.contours = {{a, b}};
    line.color = {1, 1, 1};
    scene.bodies.push_back(line);
    const PlaneWorld owner(scene);
    const World& world = owner.impl();
    const BoundaryElements elements(world, std::pow(10, random.uniform(0.5, 3)), 1);
    const Vec2d from{random.uniform(0, 1000), random.uniform(0, 1000)};
    const double t = random.uniform(-pi, pi);
    const Vec2d normal{std::cos(t), std::sin(t)};
    const std::vector<Visible> seen = lower_envelope({&world.curves[0]}, from, world.scene.bodies, {-1});
    for (const Vec2d* cosine : {static_cast<const Vec2d*>(nullptr), &normal})
      for (const Visible& piece : seen)
        weigh(world, elements, piece, from, cosine, [&](std::size_t k, double w0, double w1) {
          const BoundaryElement& e = elements.all()[k];
          const auto [low, high] = ends_of(world, e);
          double begin = angle_of(low - from);
          const double width = std::atan2(cross(low - from, high - from), dot(low - from, high - from));
          double sum0 = 0, sum1 = 0;
          for (int i = 0; i < 10'000; ++i) {
            const double f = begin + width * (i + 0.5) / 10'000;
            const Vec2d u{std::cos(f), std::sin(f)};
            const double weight = std::fabs(width) / 10'000 * (cosine != nullptr ? dot(u, *cosine) : 1);
            const Vec2d at = from + u * distance_along(world.curves[0], piece.back, from, u);
            sum0 += weight;
            sum1 += weight * dot(at - e.middle, e.along) / e.half;
          }
          // A piece that crosses the angle pi is split in two.
          if (piece.begin > -pi && piece.end < pi) {
            worst = std::max({worst, std::fabs(w0 - sum0), std::fabs(w1 - sum1)});
            EXPECT_NEAR(w0, sum0, 2e-7 * std::fabs(width)) << "repeat " << repeat;
            EXPECT_NEAR(w1, sum1, 2e-7 * std::fabs(width)) << "repeat " << repeat;
          }
        });
  }
  std::printf("weights: within %.1e of quadrature\n", worst);
}

}  // namespace steradian::plane::outlook_test
