// Exchange areas behind obstacles against exact constants, rays, and laws that hold for any pair.
#include "exchange/obstacles/obstructed.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <string>

#include "exchange/obstacles/hidden_part.h"
#include "night.h"
#include "steradian/view_factors.h"
#include "support/exchange_faces.h"

namespace steradian::exchange::obstructed_test {
namespace {

PlaneElement parallelogram(Vec3d corner, Vec3d a, Vec3d b) {
  return make_element({corner, corner + a, corner + a + b, corner + b}, {}, "element");
}

// A rectangle half way between two unit squares at z = 0 and z = 1.
void add_rectangle(std::vector<ObstacleTriangle>& to, double x0, double x1, double y0, double y1) {
  const Vec3d a{x0, y0, 0.5}, b{x1, y0, 0.5}, c{x1, y1, 0.5}, d{x0, y1, 0.5};
  to.push_back({a, b, c});
  to.push_back({a, c, d});
}

void add_box(std::vector<ObstacleTriangle>& to, Vec3d middle, Vec3d x, Vec3d y, Vec3d z) {
  const auto side = [&](Vec3d corner, Vec3d a, Vec3d b) {
    to.push_back({corner, corner + a, corner + a + b});
    to.push_back({corner, corner + a + b, corner + b});
  };
  const Vec3d corner = middle - x - y - z, a = x * 2.0, b = y * 2.0, c = z * 2.0;
  side(corner, b, a);
  side(corner + c, a, b);
  side(corner, c, b);
  side(corner + a, b, c);
  side(corner, a, c);
  side(corner + b, c, a);
}

struct KnownObstruction {
  std::string name;
  std::vector<ObstacleTriangle> triangles;
  double factor;
};

std::vector<KnownObstruction> known_obstructions() {
  const double open = 0.1998248956983873830416;
  std::vector<KnownObstruction> known = {{"a quarter", {}, 0.1498686717737905372819 * 1.0},
                                         {"the middle", {}, 0.09950629459898478629943},
                                         {"[.1,.6] x [.3,.8]", {}, 0.1112230996693481592149},
                                         {"one half", {}, open / 2},
                                         {"slit", {}, 0.006595735385759188121598},
                                         {"pillar", {}, 0.1965199695942018880014},
                                         {"everything", {}, 0.0},
                                         {"nothing", {}, open}};
  // Three quarters of the unobstructed factor.
  known[0].factor = 0.75 * open;
  add_rectangle(known[0].triangles, 0, 0.5, 0, 0.5);
  add_rectangle(known[1].triangles, 0.25, 0.75, 0.25, 0.75);
  add_rectangle(known[2].triangles, 0.1, 0.6, 0.3, 0.8);
  add_rectangle(known[3].triangles, 0, 1, 0, 0.5);
  add_rectangle(known[4].triangles, 0, 1, 0, 0.49);
  add_rectangle(known[4].triangles, 0, 1, 0.51, 1);
  add_rectangle(known[5].triangles, 0.495, 0.505, 0, 1);
  add_rectangle(known[6].triangles, -1, 2, -1, 2);
  add_rectangle(known[7].triangles, 2, 3, 2, 3);
  return known;
}

TEST(ObstructedExchange, HasTheExactFactorsBehindRectangles) {
  const PlaneElement floor = parallelogram({0, 0, 0}, {1, 0, 0}, {0, 1, 0}), ceiling = parallelogram({0, 0, 1}, {0, 1, 0}, {1, 0, 0});
  for (const KnownObstruction& k : known_obstructions())
    for (const double eps : {1e-4, 1e-6, 1e-8, 1e-10}) {
      const Obstacles obstacles(k.triangles);
      for (const VisibleExchange& h :
           {visible_exchange(floor, ceiling, obstacles, eps), visible_exchange(ceiling, floor, obstacles, eps)}) {
        const double error = std::fabs(h.visible.value - k.factor);
        EXPECT_LE(error, h.visible.error + 0x1p-53) << k.name << " at eps " << eps;
        EXPECT_LE(h.visible.value, h.unobstructed.value) << k.name;
        EXPECT_GE(h.visible.value, 0) << k.name;
        if (eps == 1e-10) {
          EXPECT_LE(error, 1e-9 * 0.2) << k.name;
        }
      }
    }
}

// An L-shaped room of height 1 with walls of lengths 3, 1, 2, 2, 1, 3; the ceiling is face 6, the floor face 7.
std::vector<ViewFactorFace> l_shaped_room(double height) {
  const Vec3d plan[6] = {{0, 0, 0}, {3, 0, 0}, {3, 1, 0}, {1, 1, 0}, {1, 3, 0}, {0, 3, 0}}, up{0, 0, height};
  std::vector<ViewFactorFace> faces;
  ViewFactorFace floor{"floor", {}}, ceiling{"ceiling", {}};
  for (int i = 0; i < 6; ++i) {
    const Vec3d a = plan[i], b = plan[(i + 1) % 6];
    faces.push_back({"wall " + std::to_string(i + 1), {a, a + up, b + up, b}});
    floor.outline.push_back(a);
    ceiling.outline.push_back(plan[5 - i] + up);
  }
  faces.push_back(ceiling);
  faces.push_back(floor);
  return faces;
}

TEST(ObstructedExchange, RowsOfAnLShapedRoomAddUpToOne) {
  // Sharp edges on the way, walls that end on others, a floor that is not convex.
  for (const double height : {0.5, 1.0, 2.0, 3.0})
    for (const double eps : {1e-5, 1e-10}) {
      ViewFactorOptions options;
      options.eps = eps;
      const ViewFactors f = view_factors(l_shaped_room(height), options);
      for (std::size_t i = 0; i < f.size(); ++i) {
        EXPECT_LE(std::fabs(f.row_sums[i] - 1), f.row_errors[i] + 1e-14) << f.names[i] << " at height " << height;
        EXPECT_LE(f.row_errors[i], 4 * eps) << f.names[i];
      }
      EXPECT_EQ(f.between(1, 3), 0);
      EXPECT_LE(f.between(1, 4), f.error_between(1, 4));
      EXPECT_NEAR(f.between(0, 6), f.between(0, 7), f.error_between(0, 6) + f.error_between(0, 7));
    }
}

TEST(ObstructedExchange, HasTheExactFactorsOfPinneyAndBeansRoom) {
  // Test 4 of Pinney and Bean, "A set of analytical tests for internal longwave radiation and view factor calculations", 1988: 30-digit
  // arithmetic. Walls 1 to 6, ceiling 7, floor 8.
  struct Known {
    std::size_t from, to;
    double factor;
  };
  const Known known[] = {{1, 2, 0.11315441430358087},
                         {1, 3, 0.378092897799350},
                         {1, 4, 0.0274734057075117},
                         {1, 5, 0.03289024756308787},
                         {1, 6, 0.1823559036685958},
                         {1, 7, 0.1330165654789368},
                         {1, 8, 0.1330165654789368},
                         {2, 1, 0.3394632429107423},
                         {2, 3, 0.3189967014790500},
                         {2, 4, 0},
                         {2, 5, 0},
                         {2, 6, 0.09867074268926361},
                         {2, 7, 0.1214346564604720},
                         {2, 8, 0.1214346564604720}};
  for (const double eps : {1e-4, 1e-7, 1e-10}) {
    ViewFactorOptions options;
    options.eps = eps;
    const ViewFactors f = view_factors(l_shaped_room(3), options);
    for (const Known& k : known) {
      const double area = f.areas[k.from - 1], factor = f.between(k.from - 1, k.to - 1) / area;
      // The constants have 15 digits.
      EXPECT_LE(std::fabs(factor - k.factor), f.error_between(k.from - 1, k.to - 1) / area + 1e-15)
          << k.from << " to " << k.to << ", eps " << eps;
      if (eps == 1e-10) {
        EXPECT_NEAR(factor, k.factor, 1e-9 * 0.3) << k.from << " to " << k.to;
      }
    }
  }
}

TEST(ObstructedExchange, BothDirectionsAgreeBehindRandomBoxes) {
  std::mt19937 random(45);
  const PlaneElement floor = parallelogram({0, 0, 0}, {1, 0, 0}, {0, 1, 0}),
                     ceiling = parallelogram({-0.2, 0.1, 1}, {0.3, 1, 0}, {1, 0, 0.2});
  for (int i = 0; i < test::by_day_or_night(3, 100); ++i) {
    std::vector<ObstacleTriangle> triangles;
    for (int b = 0; b <= i % 3; ++b) {
      const Vec3d x = normalized(random_place(random)), y = normalized(cross(x, random_place(random))), z = cross(x, y);
      const Vec3d middle = Vec3d{0.5, 0.5, 0.5} + random_place(random) * 0.2;
      add_box(triangles, middle, x * 0.15, y * 0.1, z * 0.05);
    }
    const Obstacles obstacles(triangles);
    const VisibleExchange there = visible_exchange(floor, ceiling, obstacles, 1e-7),
                          back = visible_exchange(ceiling, floor, obstacles, 1e-7);
    EXPECT_LE(std::fabs(there.visible.value - back.visible.value), there.visible.error + back.visible.error) << i;
    EXPECT_LT(there.visible.value, there.unobstructed.value) << i;
    const VisibleExchange coarse = visible_exchange(floor, ceiling, obstacles, 1e-4);
    EXPECT_LE(std::fabs(coarse.visible.value - there.visible.value), coarse.visible.error + there.visible.error) << i;
  }
}

TEST(HiddenPart, AgreesWithRays) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit(0, 1);
  const PlaneElement target = make_element({{0, 0, 1}, {0, 1, 1}, {1, 1, 1}, {0.4, 0.4, 1}, {1, 0, 1}}, {}, "target");
  constexpr int kSide = 300;
  for (int i = 0; i < 40; ++i) {
    std::vector<Vec3d> positions;
    std::vector<std::uint32_t> indices;
    for (int t = 0; t < 4; ++t)
      for (int c = 0; c < 3; ++c) {
        indices.push_back(static_cast<std::uint32_t>(positions.size()));
        positions.push_back(Vec3d{0.5, 0.5, 0.6} + random_place(random) * 0.7);
      }
    const shadow::EdgeMesh mesh = shadow::build_edges(positions, indices);
    const Vec3d p{unit(random), unit(random), 0.2 * unit(random)}, normal{0, 0, 1};
    HiddenPart finder(target, mesh);
    const double hidden = finder.hidden_factor(p, normal);
    EXPECT_TRUE(finder.is_proven()) << i;
    double sum = 0;
    for (int a = 0; a < kSide; ++a)
      for (int b = 0; b < kSide; ++b) {
        const double x = (a + 0.5) / kSide, y = (b + 0.5) / kSide;
        // The notch from the right side to (0.4, 0.4).
        if (x > 0.4 && y > 0.4 - (x - 0.4) * 2 / 3 && y < 0.4 + (x - 0.4)) continue;
        const Vec3d way = Vec3d{x, y, 1} - p;
        bool blocked = false;
        for (std::size_t t = 0; t < indices.size() && !blocked; t += 3) {
          const Vec3d ab = positions[t + 1] - positions[t], ac = positions[t + 2] - positions[t], s = p - positions[t], q = cross(s, ab),
                      h = cross(way, ac);
          const double det = dot(ab, h), u = dot(s, h) / det, v = dot(way, q) / det, at = dot(ac, q) / det;
          blocked = u >= 0 && v >= 0 && u + v <= 1 && at > 0 && at < 1;
        }
        const double r2 = dot(way, way);
        if (blocked) sum += way.z * way.z / (std::numbers::pi * r2 * r2) / (kSide * kSide);
      }
    // A grid of midpoints errs by the cells that an outline of some sides crosses, of which half cancel at random.
    EXPECT_NEAR(hidden, sum, 20.0 / (kSide * std::sqrt(kSide)) * 0.32) << i;
  }
}

TEST(ObstructedExchange, AdjacentObstaclesNeverAddAnything) {
  // Boxes that touch or cross both elements, the case in which repaired factors exceed 1.
  std::mt19937 random(31);
  std::uniform_real_distribution<double> unit(0, 1);
  const PlaneElement floor = parallelogram({0, 0, 0}, {1, 0, 0}, {0, 1, 0}), wall = parallelogram({0, 0, 0}, {0, 0, 1}, {1, 0, 0});
  for (int i = 0; i < 60; ++i) {
    std::vector<ObstacleTriangle> triangles;
    const double x = unit(random), size = 0.02 + 0.2 * unit(random);
    // Standing on the floor, on the floor and the wall, or through both.
    const double y = i % 3 == 0 ? 0.1 + unit(random) : i % 3 == 1 ? size : 0.0, z = i % 3 == 2 ? 0.0 : size;
    add_box(triangles, {x, y, z}, {size, 0, 0}, {0, size, 0}, {0, 0, size});
    const VisibleExchange h = visible_exchange(floor, wall, Obstacles(triangles), 1e-5);
    EXPECT_GE(h.visible.value, 0) << i;
    EXPECT_LE(h.visible.value, h.unobstructed.value) << i;
    EXPECT_LE(h.visible.error, 1e-4 * h.unobstructed.value) << i;
    const VisibleExchange back = visible_exchange(wall, floor, Obstacles(triangles), 1e-5);
    EXPECT_LE(std::fabs(h.visible.value - back.visible.value), h.visible.error + back.visible.error) << i;
  }
}

}  // namespace
}  // namespace steradian::exchange::obstructed_test
