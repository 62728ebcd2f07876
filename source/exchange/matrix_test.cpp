// The matrix of view factors against single pairs, closed boxes, and itself in parts.
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <cstdio>
#include <random>

#include "core/simd.h"
#include "exchange/pairs/pair.h"
#include "night.h"
#include "steradian/error.h"
#include "steradian/view_factors.h"
#include "support/exchange_faces.h"

namespace steradian::exchange::matrix_test {
namespace {

bool same_entries(const ViewFactors& a, const ViewFactors& b) {
  if (a.blocks.size() != b.blocks.size()) return false;
  for (std::size_t i = 0; i < a.blocks.size(); ++i)
    if (a.blocks[i].columns != b.blocks[i].columns || a.blocks[i].values != b.blocks[i].values || a.blocks[i].errors != b.blocks[i].errors)
      return false;
  return a.row_sums == b.row_sums && a.row_errors == b.row_errors;
}

TEST(ViewFactors, RowsOfAClosedCubeAddUpToOneWithinTheirErrors) {
  for (const double eps : {1e-3, 1e-6, 1e-9}) {
    ViewFactorOptions options;
    options.eps = eps;
    const ViewFactors factors = view_factors(turned_cube(8), options);
    for (std::size_t i = 0; i < factors.size(); ++i) {
      EXPECT_LE(std::fabs(factors.row_sums[i] - 1), factors.row_errors[i] + 1e-14) << "row " << i << " at eps " << eps;
      EXPECT_LE(factors.row_errors[i], std::max(eps, 1e-12)) << i;
    }
  }
}

// Houses hide each other in part, by edges of several at a time: each entry is within its error of a much finer run.
TEST(ViewFactors, ErrorsHoldInATown) {
  const std::vector<ViewFactorFace> faces = town(test::by_day_or_night(4, 7));
  ViewFactorOptions coarse, fine;
  coarse.eps = 1e-4;
  fine.eps = 1e-7;
  const ViewFactors factors = view_factors(faces, coarse), judge = view_factors(faces, fine);
  double largest = 0;
  for (std::size_t i = 0; i < faces.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const double error = factors.error_between(i, j) + judge.error_between(i, j),
                   difference = std::fabs(factors.between(i, j) - judge.between(i, j));
      EXPECT_LE(difference, error + 1e-13) << i << ", " << j << ": " << factors.between(i, j) << " or " << judge.between(i, j);
      if (difference > 1e-13) largest = std::max(largest, difference / error);
    }
  std::printf("largest difference over error %.2g\n", largest);
}

TEST(ViewFactors, PairsAgreeWithSinglePairs) {
  std::mt19937 random(45);
  std::uniform_real_distribution<double> place(-1, 1);
  const auto point = [&] {
    const double x = place(random), y = place(random), z = place(random);
    return Vec3d{x, y, z};
  };
  std::vector<ViewFactorFace> faces;
  for (int i = 0; i < 60; ++i) {
    const Vec3d corner = point() * 4.0, a = point(), b = point();
    if (i % 3 == 0)
      faces.push_back({"", {corner, corner + a, corner + a + b, corner + b}});
    else if (i % 3 == 1)
      faces.push_back({"", {corner, corner + a, corner + b}});
    else
      faces.push_back({"", {corner, corner + a, corner + a * 0.7 + b * 0.6, corner + b}});
  }
  std::vector<PlaneElement> elements;
  for (const ViewFactorFace& f : faces) elements.push_back(make_element(f.outline, f.holes, "face"));
  for (const double eps : {1e-3, 1e-6, 1e-10}) {
    ViewFactorOptions options;
    options.eps = eps;
    options.obstruction = Obstruction::off;
    const ViewFactors factors = view_factors(faces, options);
    for (std::size_t i = 0; i < faces.size(); ++i)
      for (std::size_t j = 0; j < i; ++j) {
        const ExchangeArea h = exchange_area(elements[i], elements[j], 1e-14);
        const double error = factors.error_between(i, j);
        EXPECT_LE(std::fabs(factors.between(i, j) - h.value), error + h.error) << i << ", " << j << " at eps " << eps;
        EXPECT_EQ(factors.between(i, j), factors.between(j, i));
        EXPECT_LE(error, eps * h.value * (1 + 1e-6) + 1e-14) << i << ", " << j;
      }
  }
}

TEST(ViewFactors, AnyNumberOfThreadsAndPartsGivesTheSameBits) {
  const std::vector<ViewFactorFace> faces = turned_cube(6);
  const ViewFactors whole = view_factors(faces);
  {
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    EXPECT_TRUE(same_entries(whole, view_factors(faces)));
  }
  std::vector<ViewFactors> parts;
  for (const int part : {2, 3, 1}) {
    ViewFactorOptions options;
    options.part = part;
    options.parts = 3;
    parts.push_back(view_factors(faces, options));
  }
  EXPECT_TRUE(same_entries(whole, merge_view_factors(parts)));
  EXPECT_THROW(merge_view_factors({parts[0], parts[2]}), Error);            // a part is missing
  EXPECT_THROW(merge_view_factors({parts[0], parts[1], parts[1]}), Error);  // a part comes twice
  parts[1].areas[0] *= 2;
  EXPECT_THROW(merge_view_factors(parts), Error);  // another scene
}

TEST(ViewFactors, GroupsAddUp) {
  const std::vector<ViewFactorFace> faces = turned_cube(3);
  const ViewFactors factors = view_factors(faces);
  std::vector<std::size_t> groups;
  for (std::size_t i = 0; i < faces.size(); ++i) groups.push_back(i < 27 ? 0 : 1);
  const ViewFactors halves = grouped_view_factors(factors, groups, {"three faces", "the other three"});
  EXPECT_NEAR(halves.areas[0], 3, 1e-12);
  EXPECT_NEAR(halves.row_sums[0], 1, halves.row_errors[0]);
  // Three faces of a cube: floor, top and a wall. Each pair of faces has 0.2 within 2e-4.
  EXPECT_NEAR(halves.own[0], 2 * (0.1998248956983874 + 2 * 0.2000437760754032), 1e-6);
  EXPECT_NEAR(halves.between(1, 0), 3 - halves.own[0], 1e-6);
}

TEST(ViewFactors, RefusesBadFacesAndOptionsByName) {
  ViewFactorOptions options;
  options.eps = 0;
  EXPECT_THROW(view_factors(turned_cube(1), options), UsageError);
  options.eps = 1e-6;
  options.part = 3;
  options.parts = 2;
  EXPECT_THROW(view_factors(turned_cube(1), options), UsageError);
  try {
    view_factors({{"lid", {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}}});
    FAIL() << "a face without area is taken";
  } catch (const Error& e) {
    EXPECT_NE(std::string(e.what()).find("lid"), std::string::npos) << e.what();
  }
  EXPECT_EQ(view_factors({}).size(), 0u);
}

TEST(ViewFactors, EveryInstructionSetAgrees) {
  // Sums of other lengths round otherwise: the sixteen operations of kProductRounding.
  const std::vector<ViewFactorFace> faces = turned_cube(4);
  const ViewFactors widest = view_factors(faces);
  for (const Simd simd : available_simd()) {
    setenv("STERADIAN_SIMD", name_of(simd), 1);
    const ViewFactors other = view_factors(faces);
    unsetenv("STERADIAN_SIMD");
    for (std::size_t i = 0; i < faces.size(); ++i)
      for (std::size_t j = 0; j < i; ++j)
        EXPECT_NEAR(other.between(i, j), widest.between(i, j), 2 * widest.error_between(i, j)) << name_of(simd);
  }
}

}  // namespace
}  // namespace steradian::exchange::matrix_test
