#include "plane/svg/stroke.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "plane/exact/outline.h"
#include "plane/exact/random.h"

namespace steradian::plane::stroke_test {
namespace {

using svg::Cap;
using svg::Join;
using svg::Stroke;

std::vector<PlaneBody> bodies_of(const std::string& inside) {
  return load_plane_scene_from_text("<svg viewBox='0 0 100 100'>" + inside + "</svg>", "test.svg").scene.bodies;
}

// Is p in a stroke of straight segments, by the definition of SVG? Pieces: a rectangle for each segment, caps, and corners. `doubtful`: it
// is nearer than the margin to an edge of one of them.
struct Answer {
  bool within = false, doubtful = false;
};

class Definition {
 public:
  Definition(std::vector<Vec2d> line, bool closed, const Stroke& stroke, double margin)
      : line_(std::move(line)), closed_(closed), stroke_(stroke), margin_(margin) {}

  Answer at(Vec2d p) const {
    Answer answer;
    const std::size_t n = line_.size();
    for (std::size_t i = 0; i + (closed_ ? 0 : 1) < n; ++i) segment(answer, p, i);
    for (std::size_t i = closed_ ? 0 : 1; i + (closed_ ? 0 : 1) < n; ++i) corner(answer, p, i);
    return answer;
  }

 private:
  Vec2d along(std::size_t i) const {
    const Vec2d v = line_[(i + 1) % line_.size()] - line_[i % line_.size()];
    return v / length(v);
  }

  // `inside`: signed distance to the edge of a piece, positive within.
  void piece(Answer& answer, double inside) const {
    answer.within |= inside > 0;
    answer.doubtful |= std::fabs(inside) < margin_;
  }

  void segment(Answer& answer, Vec2d p, std::size_t i) const {
    const Vec2d t = along(i), q = p - line_[i];
    const double r = stroke_.radius, whole = length(line_[(i + 1) % line_.size()] - line_[i]);
    const bool first = !closed_ && i == 0, last = !closed_ && i + 2 == line_.size(), square = stroke_.cap == Cap::square;
    const double before = first && square ? r : 0, behind = last && square ? r : 0;
    piece(answer, std::min({dot(q, t) + before, whole + behind - dot(q, t), r - std::fabs(cross(t, q))}));
    if (stroke_.cap != Cap::round) return;
    if (first) piece(answer, r - length(q));
    if (last) piece(answer, r - length(p - line_[i + 1]));
  }

  void corner(Answer& answer, Vec2d p, std::size_t i) const {
    const std::size_t n = line_.size();
    const Vec2d a = along(i + n - 1), b = along(i), q = p - line_[i];
    const double r = stroke_.radius, turn = std::atan2(cross(a, b), dot(a, b)), half = std::cos(0.5 * turn);
    if (stroke_.join == Join::round) return piece(answer, r - length(q));
    // The outer side: normals away from the turn.
    const double side = turn > 0 ? -1 : 1;
    const Vec2d m = Vec2d{-a.y, a.x} * side, k = Vec2d{-b.y, b.x} * side, middle = (m + k) / length(m + k);
    const bool sharp = stroke_.join == Join::miter && half * stroke_.miter_limit >= 1;
    const double wedge = std::min(dot(q, a), -dot(q, b));  // between the ends of both rectangles
    const double edge = sharp ? std::min(r - dot(q, m), r - dot(q, k)) : r * half - dot(q, middle);
    piece(answer, std::min(wedge, edge));
  }

  std::vector<Vec2d> line_;
  bool closed_;
  Stroke stroke_;
  double margin_;
};

void expect_definition(SceneRandom& random, const Stroke& stroke, int i) {
  std::vector<Vec2d> line;
  const int n = 3 + i % 5;
  for (int k = 0; k < n; ++k) line.push_back({random.uniform(20, 80), random.uniform(20, 80)});
  if (i % 3 == 1)  // a tight bend of many points
    for (int k = 1; k < 40; ++k)
      line.push_back(line[static_cast<std::size_t>(n) - 1] + Vec2d{3 * std::cos(k * 0.1) - 3, 3 * std::sin(k * 0.1)});
  const bool closed = i % 2 == 0;
  const Definition definition(line, closed, stroke, 2e-3);
  const PlaneBody body = svg::stroke_of(line, closed, stroke, 1e-3);
  for (int k = 0; k < 400; ++k) {
    const Vec2d p{random.uniform(0, 100), random.uniform(0, 100)};
    const Answer answer = definition.at(p);
    if (answer.doubtful) continue;  // within the flattening's tolerance of an edge
    ASSERT_EQ(contains(body, p), answer.within) << "stroke " << i << " of radius " << stroke.radius << " at " << p.x << ", " << p.y;
  }
}

}  // namespace

TEST(Stroke, HoldsWhatCapsAndJoinsDefine) {
  SceneRandom random(8);
  int i = 0;
  for (const Cap cap : {Cap::butt, Cap::round, Cap::square})
    for (const Join join : {Join::miter, Join::round, Join::bevel})
      for (int k = 0; k < 24; ++k) expect_definition(random, {random.uniform(0.5, 9), cap, join, k % 2 == 0 ? 4.0 : 1.5}, i++);
}

TEST(Stroke, IsABodyOfItsWidthWithAnyCap) {
  const char* kLine = "<path d='M20 50H80' fill='none' stroke='#000' stroke-width='10' ";
  const struct {
    const char* cap;
    double x;  // the end
  } kCaps[] = {{"", 80}, {"stroke-linecap='butt'", 80}, {"stroke-linecap='square'", 85}, {"style='stroke-linecap:round'", 85}};
  for (const auto& [cap, x] : kCaps) {
    const auto bodies = bodies_of(std::string(kLine) + cap + "/>");
    ASSERT_EQ(bodies.size(), 1u) << cap;
    EXPECT_TRUE(contains(bodies[0], {50, 54.9})) << cap;
    EXPECT_FALSE(contains(bodies[0], {50, 55.1})) << cap;
    EXPECT_TRUE(contains(bodies[0], {x - 0.1, 50})) << cap;
    EXPECT_FALSE(contains(bodies[0], {x + 0.1, 50})) << cap;
    EXPECT_NEAR(bounds_of(bodies[0]).high.x, x, 1e-9) << cap;
  }
}

TEST(Stroke, OfCornersFollowsTheJoin) {
  const auto corner = [](const std::string& join) {
    return bodies_of("<polyline points='20,80 50,80 50,20' fill='none' stroke='#000' stroke-width='10' " + join + "/>").at(0);
  };
  const Vec2d tip{54.9, 84.9}, arc{53.4, 83.4}, cut{52.4, 82.4};
  EXPECT_TRUE(contains(corner(""), tip)) << "the corner is sharp, as everywhere in SVG";
  EXPECT_FALSE(contains(corner("stroke-linejoin='round'"), tip));
  EXPECT_TRUE(contains(corner("stroke-linejoin='round'"), arc));
  EXPECT_FALSE(contains(corner("stroke-linejoin='bevel'"), arc));
  EXPECT_TRUE(contains(corner("stroke-linejoin='bevel'"), cut));
  EXPECT_FALSE(contains(corner("stroke-miterlimit='1.2'"), arc)) << "longer corners are cut off";
}

TEST(Stroke, OfClosedShapesIsARing) {
  for (const std::string shape : {"<rect x='20' y='20' width='60' height='60'", "<circle cx='50' cy='50' r='30'"}) {
    const auto bodies = bodies_of(shape + " fill='none' stroke='#000' stroke-width='8'/>");
    ASSERT_EQ(bodies.size(), 1u) << shape;
    EXPECT_FALSE(contains(bodies[0], {50, 50})) << shape;
    EXPECT_TRUE(contains(bodies[0], {50, 23.9})) << shape;
    EXPECT_TRUE(contains(bodies[0], {16.1, 50})) << shape;
    EXPECT_FALSE(contains(bodies[0], {50, 24.1})) << shape;
  }
}

TEST(Stroke, OfAStretchedLineIsStretched) {
  const auto bodies = bodies_of(
      "<g transform='scale(1 4)'><path d='M10 5H90' stroke='#000' fill='none' stroke-width='2'/>"
      "<path d='M50 0V20' stroke='#000' fill='none' stroke-width='2' stroke-linecap='round'/></g>");
  ASSERT_EQ(bodies.size(), 2u);
  EXPECT_NEAR(bounds_of(bodies[0]).size().y, 8, 1e-9) << "the width is that of the element's own coordinates";
  // Both ends are as far within as curves may be: 1e-5 of 100 units.
  EXPECT_NEAR(bounds_of(bodies[1]).size().x, 2, 2e-3);
  EXPECT_NEAR(bounds_of(bodies[1]).size().y, 88, 2e-3);
}

TEST(Stroke, WithoutAWidthIsALine) {
  for (const std::string width : {"", "stroke-width='0'"}) {
    const auto bodies = bodies_of("<path d='M20 50H80V90' fill='none' stroke='#000' " + width + "/>");
    ASSERT_EQ(bodies.size(), 1u);
    EXPECT_EQ(bodies[0].shape, PlaneBody::Shape::polyline) << width;
  }
  const auto textured =
      bodies_of("<path class='light' d='M20 50H80' fill='none' stroke='#fff' stroke-width='4' data-texture='red; blue'/>");
  for (const PlaneBody& line : textured) EXPECT_EQ(line.shape, PlaneBody::Shape::polyline);
}

TEST(Stroke, OfBackAndForthAndDotsKeepsItsWidth) {
  const Stroke round{5, Cap::butt, Join::round, 4};
  const PlaneBody back = svg::stroke_of({{20, 50}, {80, 50}, {40, 50}}, false, round, 1e-3);
  EXPECT_TRUE(contains(back, {84.9, 50})) << "the round corner where it turns back";
  EXPECT_FALSE(contains(back, {19.9, 50}));
  EXPECT_TRUE(contains(svg::stroke_of({{20, 50}, {80, 50}}, true, round, 1e-3), {15.1, 50}));
  EXPECT_FALSE(contains(svg::stroke_of({{20, 50}, {80, 50}}, true, {5, Cap::round, Join::bevel, 4}, 1e-3), {19, 50}));
  EXPECT_TRUE(contains(svg::stroke_of({{50, 50}, {50, 50}}, false, {5, Cap::square, Join::miter, 4}, 1e-3), {54.9, 45.1}));
  EXPECT_TRUE(svg::stroke_of({{50, 50}, {50, 50}}, false, {5, Cap::butt, Join::miter, 4}, 1e-3).contours.empty());
}

// A stroke of the width of many pictures has a bounded number of points.
TEST(Stroke, OfAnyWidthIsBounded) {
  for (const char* width : {"1e-9", "1e6", "1e18", "1e200"}) {
    const auto bodies = bodies_of(
        std::string("<path d='M20 50H80V90L30 20' fill='none' stroke='#000' stroke-linejoin='round' stroke-width='") + width + "'/>");
    ASSERT_EQ(bodies.size(), 1u) << width;
    EXPECT_LT(bodies[0].contours[0].size(), 30'000u) << width;
  }
}

}  // namespace steradian::plane::stroke_test
