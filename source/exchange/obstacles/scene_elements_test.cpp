// Scenes whose corners are rounded to 32 bits, as files store them, against the same scenes in double.
#include "exchange/obstacles/scene_elements.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "exchange/obstacles/obstructed.h"
#include "night.h"

namespace steradian::exchange::scene_elements_test {
namespace {

// A box whose faces look inwards or outwards.
void add_box(std::vector<ViewFactorFace>& to, Vec3d low, Vec3d high, bool inwards) {
  const auto side = [&](Vec3d o, Vec3d a, Vec3d b) {
    std::vector<Vec3d> outline{o, o + a, o + a + b, o + b};
    if (inwards) std::reverse(outline.begin(), outline.end());
    to.push_back({"face " + std::to_string(to.size()), outline});
  };
  const Vec3d size = high - low, x{size.x, 0, 0}, y{0, size.y, 0}, z{0, 0, size.z};
  side(low, y, x);
  side(low + z, x, y);
  side(low, x, z);
  side(low + y, z, x);
  side(low, z, y);
  side(low + x, y, z);
}

// A room of 4 x 3 x 5 m with a box in it. Each face is one face, or cut into n x n faces.
std::vector<ViewFactorFace> furnished_room(int n) {
  std::vector<ViewFactorFace> whole, cut;
  add_box(whole, {0, 0, 0}, {4, 3, 5}, true);
  add_box(whole, {1, 1, 1}, {2, 1.5, 3}, false);
  for (const ViewFactorFace& face : whole) {
    const Vec3d o = face.outline[0], a = (face.outline[1] - o) / n, b = (face.outline[3] - o) / n;
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j) {
        const auto at = [&](int k, int l) { return o + a * k + b * l; };
        cut.push_back({face.name, {at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)}});
      }
  }
  return cut;
}

std::vector<ViewFactorFace> turned_and_rounded(std::vector<ViewFactorFace> faces, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  const auto vector = [&] {
    const double x = normal(random), y = normal(random), z = normal(random);
    return Vec3d{x, y, z};
  };
  const Frame frame = Frame::from_normal(normalized(vector()));
  const Vec3d shift = vector();
  for (ViewFactorFace& face : faces)
    for (Vec3d& v : face.outline) v = static_cast<Vec3d>(static_cast<Vec3f>(frame.to_world(v) + shift));
  return faces;
}

TEST(SceneElements, CornersRoundedTo32BitsChangeNoFactorMore) {
  for (const int n : {1, 3}) {
    const std::vector<ViewFactorFace> faces = furnished_room(n);
    const ViewFactors exact = view_factors(faces);
    for (unsigned seed = 1; seed <= test::by_day_or_night(1u, 3u); ++seed) {
      const ViewFactors rounded = view_factors(turned_and_rounded(faces, seed));
      for (std::size_t i = 0; i < exact.size(); ++i) {
        // Corners move by 2^-24 of at most 16 m. A strip of that width around both faces and around the shadows of the twelve edges of the
        // box on both is uncertain. It is no longer than 14 perimeters.
        const auto& outline = faces[i].outline;
        const double perimeter = 2 * (length(outline[1] - outline[0]) + length(outline[2] - outline[1]));
        const double strip = 14 * perimeter * 16 * 0x1p-24;
        EXPECT_NEAR(rounded.row_sums[i], 1, rounded.row_errors[i] + strip / exact.areas[i])
            << "n " << n << ", seed " << seed << ", row " << i;
        for (std::size_t j = 0; j < i; ++j)
          EXPECT_NEAR(rounded.between(i, j), exact.between(i, j), rounded.error_between(i, j) + exact.error_between(i, j) + strip)
              << "n " << n << ", seed " << seed << ", pair " << i << ", " << j;
      }
    }
  }
}

TEST(SceneElements, NeighboursInOneRoundedPlaneExchangeNothing) {
  const SceneElements scene = scene_elements(turned_and_rounded(furnished_room(3), 4), {}, Obstruction::on);
  for (std::size_t i = 0; i < 9; ++i)
    for (std::size_t j = 0; j < i; ++j) EXPECT_TRUE(in_front_of(scene.elements[i], scene.elements[j]).is_empty()) << i << ", " << j;
}

// A sheet that rises from the edge of a target by less than the finder tells apart hides all of it from a wall on this edge.
TEST(SceneElements, SheetsNearTheTargetCountInTheError) {
  const PlaneElement target = make_element({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {}, "target");
  const PlaneElement wall = make_element({{0, 0, 0}, {0, 1, 0}, {0, 1, 1}, {0, 0, 1}}, {}, "wall");
  for (const double rise : {1e-9, 1e-8, 1e-6, 1e-3}) {
    const Obstacles sheet({{Vec3d{0, 0, 0}, {1, 0, rise}, {1, 1, rise}}, {Vec3d{0, 0, 0}, {1, 1, rise}, {0, 1, 0}}});
    const ExchangeArea h = visible_exchange(wall, target, sheet, 1e-8).visible;
    EXPECT_LE(h.value, h.error + 1e-15) << rise;
    EXPECT_LE(h.error, 1e-12 / rise + 1e-8) << rise;
  }
}

}  // namespace
}  // namespace steradian::exchange::scene_elements_test
