// Every claim about the six lines, on random blockers, against the exact query.
#include "plane/frame/events/event_lines.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "plane/exact/random.h"
#include "plane/exact/world.h"
#include "steradian/kernels.h"
#include "steradian/plane.h"

namespace steradian::plane::event_lines_test {
namespace {

using D = Real<double>;
using Lines = EventLines<D>;

// A light of radius 1 at the origin and one blocker, a polygon or, without vertices, a disk.
struct Pair {
  std::vector<Vec2d> vertices;
  Vec2d center;
  double radius = 0;

  Lines lines() const {
    if (vertices.empty()) return round_event_lines<D>(center.x, center.y, radius, 1.0);
    std::vector<D> x, y;
    for (std::size_t k = 0; k <= vertices.size(); ++k) {
      x.push_back(vertices[k % vertices.size()].x);
      y.push_back(vertices[k % vertices.size()].y);
    }
    return convex_event_lines<D>(x.data(), y.data(), static_cast<int>(vertices.size()), 1.0);
  }
  PlaneScene scene() const {
    PlaneScene scene;
    scene.origin = {-20, -20};
    scene.width = scene.height = 40;
    scene.bodies.push_back(plane_circle({0, 0}, 1));
    scene.bodies.back().light.emplace();
    PlaneBody body = plane_circle(center, radius);
    if (vertices.size() == 2) {
      body.shape = PlaneBody::Shape::polyline;
      body.contours = {vertices};
    } else if (!vertices.empty()) {
      body = plane_polygon(vertices);
    }
    scene.bodies.push_back(body);
    return scene;
  }
  // The places at which P sees vertices first .. last, and a round blocker's end or begin.
  double place(Vec2d p, int k) const {
    const Vec2d v = vertices[static_cast<std::size_t>(k)];
    return Kernels<double>().plane_place_on_light({v.x, v.y}, {v.x - p.x, v.y - p.y}).v;
  }
  double tangent(Vec2d p, double side) const {
    const Vec2d k = center - p, a = -p;
    const double t = std::sqrt(dot(k, k) - radius * radius);
    return (t * cross(a, k) + side * radius * dot(a, k)) / dot(k, k);
  }
  double end(Vec2d p, const Lines& l) const {
    if (vertices.empty()) return tangent(p, 1);
    return over_chain(
        l.end_first, l.end_last, [&](double a, int k) { return std::max(a, place(p, k)); }, -1e9);
  }
  double begin(Vec2d p, const Lines& l) const {
    if (vertices.empty()) return tangent(p, -1);
    return over_chain(
        l.begin_first, l.begin_last, [&](double a, int k) { return std::min(a, place(p, k)); }, 1e9);
  }
  template <class F>
  double over_chain(D first, D last, F f, double value) const {
    const int count = static_cast<int>(vertices.size());
    for (int k = static_cast<int>(first.v);; k = (k + 1) % count) {
      value = f(value, k);
      if (k == static_cast<int>(last.v)) return value;
    }
  }
};

Pair random_pair(SceneRandom& random) {
  for (;;) {
    Pair pair;
    const double angle = random.uniform(0, 2 * std::numbers::pi), size = random.uniform(0.2, 6);
    pair.center = Vec2d{std::cos(angle), std::sin(angle)} * random.uniform(1, 10);
    if (random.uniform() < 0.2) {
      pair.radius = size * 0.5;
      if (length(pair.center) > pair.radius + 1) return pair;
      continue;
    }
    // Vertices on an ellipse form a convex polygon.
    const int count = 2 + static_cast<int>(random.uniform() * 6.99);
    const double turn = random.uniform(0, 2 * std::numbers::pi), flat = random.uniform(0.05, 1);
    const Vec2d x = Vec2d{std::cos(turn), std::sin(turn)} * size, y = Vec2d{-std::sin(turn), std::cos(turn)} * (size * flat);
    std::vector<double> places;
    for (int k = 0; k < count; ++k) places.push_back(random.uniform(0, 2 * std::numbers::pi));
    std::sort(places.begin(), places.end());
    for (double t : places) pair.vertices.push_back(pair.center + x * std::cos(t) + y * std::sin(t));
    bool apart = true;
    double turns = 0;
    for (std::size_t k = 0; k < pair.vertices.size(); ++k) {
      const Vec2d p = pair.vertices[k], q = pair.vertices[(k + 1) % pair.vertices.size()], e = q - p;
      const double t = std::clamp(-dot(p, e) / dot(e, e), 0.0, 1.0);
      apart = apart && length(p + e * t) > 1 && length(e) > 0.01;
      turns += std::atan2(cross(p, q), dot(p, q));
    }
    if (apart && std::fabs(turns) < 1) return pair;
  }
}

double share_between(Vec2d p, double from, double to) {
  const double d = length(p);
  from = std::clamp(from, -1.0, 1.0);
  to = std::clamp(to, -1.0, 1.0);
  return to > from ? (std::asin(to / d) - std::asin(from / d)) / (2 * std::numbers::pi) : 0;
}

}  // namespace

TEST(EventLines, DecideWhatABlockerTakesFromARoundLight) {
  SceneRandom random(5);
  int nothing = 0, hidden = 0, low = 0, high = 0, within = 0;
  for (int n = 0; n < 10000; ++n) {
    const Pair pair = random_pair(random);
    const Lines lines = pair.lines();
    const PlaneWorld world(pair.scene());
    for (int m = 0; m < 40; ++m) {
      const Vec2d p{random.uniform(-18, 18), random.uniform(-18, 18)};
      if (length(p) < 1.01 || world.impl().occluder_at(p) >= 0) continue;
      const auto at = [&](const EventLine<D>& e) { return e.at(p.x, p.y).v; };
      const double value = world.query(p).radiance.x, open = share_between(p, -1, 1);
      const bool beyond = at(lines.separator) > 0 && at(lines.chord) > 0;
      const bool from_low = beyond && at(lines.outer_low) > 0, to_high = beyond && at(lines.outer_high) > 0;
      double expected = 0;
      if (at(lines.inner_low) < 0 || at(lines.inner_high) < 0 || at(lines.separator) < 0) {
        expected = open;
        ++nothing;
      } else if (from_low && to_high) {
        ++hidden;
      } else if (from_low) {
        expected = share_between(p, pair.end(p, lines), 1);
        ++low;
      } else if (to_high) {
        expected = share_between(p, -1, pair.begin(p, lines));
        ++high;
      } else {
        // The lines say that a part is occluded.
        EXPECT_LT(value, open + 1e-12);
        ++within;
        continue;
      }
      ASSERT_NEAR(value, expected, 1e-9) << "pair " << n << ", " << pair.vertices.size() << " vertices, from " << p.x << ", " << p.y
                                         << ": nothing " << nothing << ", low " << low << ", high " << high;
    }
  }
  std::printf("nothing %d, hidden %d, low %d, high %d, from within %d\n", nothing, hidden, low, high, within);
  EXPECT_GT(std::min({hidden, low, high, within}), 300);
}

// The shadow of a square in front of a disk; values by hand and by the closed form.
TEST(EventLines, KnowTheShadowOfASquare) {
  Pair square;
  square.vertices = {{9, -1}, {11, -1}, {11, 1}, {9, 1}};
  const Lines l = square.lines();
  const PlaneWorld world(square.scene());
  const struct {
    double x, y, share;
  } cases[] = {{20, 0, 0}, {20, 1, 0}, {20, 1.5, 0.003253776}, {20, 2.5, 0.009677733}, {20, 3.5, 0.015683592}, {40, 3, 0.002307676}};
  for (const auto& c : cases) {
    const Vec2d p{c.x, c.y};
    EXPECT_NEAR(world.query(p).radiance.x, c.share, 1e-9);
    const bool taken = l.inner_low.at(c.x, c.y).v > 0 && l.inner_high.at(c.x, c.y).v > 0 && l.separator.at(c.x, c.y).v > 0;
    if (!taken) {
      EXPECT_NEAR(share_between(p, -1, 1), c.share, 1e-9);
    } else if (l.outer_low.at(c.x, c.y).v > 0) {
      EXPECT_NEAR(share_between(p, square.end(p, l), 1), c.share, 1e-9);
    } else {
      EXPECT_NEAR(share_between(p, -1, square.begin(p, l)), c.share, 1e-9);
    }
  }
}

}  // namespace steradian::plane::event_lines_test
