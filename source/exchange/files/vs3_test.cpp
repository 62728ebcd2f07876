#include "exchange/files/vs3.h"

#include <gtest/gtest.h>

#include <cstring>

#include "steradian/error.h"
#include "support/gltf_test_file.h"

namespace steradian::exchange::vs3_test {
namespace {

// A closed room of 4 x 5 x 3 m, and a cupboard of 2 x 1 x 1 m on its floor. Surface 12 is the bottom of the cupboard.
const std::string kRoom =
    "F 3\nV 1 0 0 0\nV 2 4 0 0\nV 3 4 5 0\nV 4 0 5 0\nV 5 0 0 3\nV 6 4 0 3\nV 7 4 5 3\nV 8 0 5 3\n"
    "V 11 1 2 0\nV 12 3 2 0\nV 13 3 3 0\nV 14 1 3 0\nV 15 1 2 1\nV 16 3 2 1\nV 17 3 3 1\nV 18 1 3 1\n"
    "S 1 1 2 3 4 0 0 0.5 floor\nS 2 8 7 6 5 0 0 0.5 ceiling\nS 3 1 5 6 2 0 0 0.5 south\nS 4 2 6 7 3 0 0 0.5 east\n"
    "S 5 3 7 8 4 0 0 0.5 north\nS 6 4 8 5 1 0 0 0.5 west\n"
    "S 7 11 12 16 15 0 0 0.5 front\nS 8 12 13 17 16 0 0 0.5 right\nS 9 13 14 18 17 0 0 0.5 back\nS 10 14 11 15 18 0 0 0.5 left\n"
    "S 11 15 16 17 18 0 0 0.5 top\n";
const std::string kBottom = "M 12 14 13 12 11 1 0 0.5 bottom\n";

SceneFaces read(const std::string& text, FaceOptions options = {}) {
  Budget budget;
  return read_vs3(scene::write_test_file("masks.vs3", text + "E\n"), options, budget);
}

ViewFactors factors_of(const SceneFaces& scene, double eps = 1e-8) {
  ViewFactorOptions options;
  options.eps = eps;
  options.obstacles = scene.obstacles;
  return with_masks(grouped_view_factors(view_factors(scene.faces, options), scene.groups, scene.group_names), scene.masks);
}

// A mask sees its base alone, and the rows of a closed room add up to 1, with the area of the whole floor.
TEST(Vs3Masks, CoverTheirBaseAndKeepTheRoomClosed) {
  const SceneFaces scene = read(kRoom + kBottom);
  ASSERT_EQ(scene.faces.size(), 11u);
  ASSERT_EQ(scene.group_names.size(), 12u);
  ASSERT_EQ(scene.masks.size(), 1u);
  const ViewFactors f = factors_of(scene);
  for (std::size_t i = 0; i < f.size(); ++i) EXPECT_NEAR(f.row_sums[i], 1, f.row_errors[i] + 1e-12) << f.names[i];
  EXPECT_EQ(f.areas[0], 20);
  EXPECT_EQ(f.areas[11], 2);
  EXPECT_EQ(f.between(0, 11), 2) << "F from the mask to the floor is 1, from the floor to the mask 0.1";
  EXPECT_EQ(f.row_errors[11], 0);
  for (std::size_t j = 1; j < 11; ++j) EXPECT_EQ(f.between(11, j), 0) << f.names[j];
  // Every other factor is that of a floor with a hole, and the same with the floor as two combined surfaces.
  const SceneFaces hole = read(kRoom + "N 12 14 13 12 11 1 0 0.5 nothing\n");
  ViewFactorOptions options;
  options.eps = 1e-8;
  const ViewFactors without = view_factors(hole.faces, options);
  for (std::size_t i = 0; i < 11; ++i)
    for (std::size_t j = 0; j < i; ++j) EXPECT_NEAR(f.between(i, j), without.between(i, j), 1e-7) << f.names[i] << " " << f.names[j];
}

// A door touches the edge of its wall, and a cupboard stands at the wall, in its corner: subsurfaces and masks that touch their base.
TEST(Vs3Subsurfaces, MayTouchTheEdgesOfTheirBase) {
  std::string room = kRoom;
  for (const auto& [from, to] : {std::pair{"V 11 1 2 0", "V 11 0 0 0"},
                                 {"V 12 3 2 0", "V 12 2 0 0"},
                                 {"V 13 3 3 0", "V 13 2 1 0"},
                                 {"V 14 1 3 0", "V 14 0 1 0"},
                                 {"V 15 1 2 1", "V 15 0 0 1"},
                                 {"V 16 3 2 1", "V 16 2 0 1"},
                                 {"V 17 3 3 1", "V 17 2 1 1"},
                                 {"V 18 1 3 1", "V 18 0 1 1"}})
    room.replace(room.find(from), std::string(from).size(), to);
  // The cupboard's front and left side lie on walls: they and the floor have masks. The east wall has a door and a window above it.
  for (const char* side : {"S 7 11 12 16 15 0 0 0.5 front\n", "S 10 14 11 15 18 0 0 0.5 left\n"})
    room.erase(room.find(side), std::strlen(side));
  room += "V 21 4 1 0\nV 22 4 2 0\nV 23 4 2 2\nV 24 4 1 2\nV 25 4 1 2.5\nV 26 4 2 2.5\n";
  const std::string masks = "M 12 14 13 12 11 1 0 .5 bottom\nM 13 11 12 16 15 3 0 .5 front\nM 14 14 11 15 18 6 0 .5 left\n";
  const std::string openings = "S 15 21 24 23 22 4 0 .5 door\nS 16 24 25 26 23 4 0 .5 window\n";
  for (const double divide : {0.0, 2.0}) {
    FaceOptions options;
    options.by = divide > 0 ? FacesBy::node : FacesBy::face;
    options.divide = divide;
    const ViewFactors f = factors_of(read(room + masks + openings, options), 1e-7);
    double area = 0;
    for (std::size_t i = 0; i < f.size(); ++i) {
      EXPECT_NEAR(f.row_sums[i], 1, f.row_errors[i] + 1e-12) << f.names[i] << " divided by " << divide;
      EXPECT_LT(f.row_errors[i], 1e-5) << f.names[i] << " divided by " << divide;
      area += f.areas[i];
    }
    EXPECT_NEAR(area, 94 + 10, 1e-9) << "the room, and the cupboard twice where it touches";
  }
}

// Combined surfaces, elements and backs with a mask keep its factors.
TEST(Vs3Masks, BelongToGroups) {
  std::string parts = kRoom;
  parts.replace(parts.find("S 2 8 7 6 5 0 0"), 15, "S 2 8 7 6 5 0 1");  // the ceiling is combined with the floor
  FaceOptions by_node;
  by_node.by = FacesBy::node;
  by_node.divide = 2;
  const SceneFaces scene = read(parts + kBottom, by_node);
  EXPECT_EQ(scene.group_names.size(), 11u);
  EXPECT_GT(scene.faces.size(), 20u);
  const ViewFactors f = factors_of(scene, 1e-6);
  EXPECT_EQ(f.names[0], "floor");
  EXPECT_NEAR(f.areas[0], 40, 1e-12);
  EXPECT_EQ(f.between(0, 10), 2);
  for (std::size_t i = 0; i < f.size(); ++i) EXPECT_NEAR(f.row_sums[i], 1, f.row_errors[i] + 1e-12) << f.names[i];
  FaceOptions divided;
  divided.divide = 2;
  EXPECT_THROW(read(kRoom + kBottom, divided), UsageError);
  FaceOptions two_sided;
  two_sided.two_sided = true;
  EXPECT_EQ(read(kRoom + kBottom, two_sided).group_names.size(), 23u) << "11 surfaces, their backs, and the mask";
}

TEST(Vs3Masks, OnNothingAreRefusedByTheirLine) {
  for (const auto& [line, words] : {std::pair{"M 12 14 13 12 11 0 0 0.5 x\n", "is no other surface"},
                                    {"M 12 14 13 12 11 99 0 0.5 x\n", "is no other surface"},
                                    {"M 12 11 12 13 14 1 0 0.5 x\n", "face the same side"},
                                    {"O 12 1 2 3 4\nM 13 14 13 12 11 12 0 0.5 x\n", "no radiating surface"}})
    try {
      read(kRoom + line);
      ADD_FAILURE() << line;
    } catch (const Error& e) {
      EXPECT_NE(std::string(e.what()).find(words), std::string::npos) << e.what();
      EXPECT_NE(std::string(e.what()).find("masks.vs3:"), std::string::npos) << e.what();
    }
  // An obstruction needs no more than its corners.
  EXPECT_EQ(read(kRoom + "O 12 14 13 12 11\n").obstacles.size(), 2u);
}

}  // namespace
}  // namespace steradian::exchange::vs3_test
