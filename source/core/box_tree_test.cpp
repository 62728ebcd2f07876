#include "core/box_tree.h"

#include <gtest/gtest.h>

#include "core/random.h"

namespace steradian::box_tree_test {

namespace {

Vec3d anywhere(reference::Random& random) { return {random.uniform(), random.uniform(), random.uniform()}; }

}  // namespace

TEST(Box, AnEmptyBoxAddsNothing) {
  Box3f box;
  box.add(Box3f{});
  EXPECT_TRUE(box.is_empty());
  box.add(Vec3f{1, 2, 3});
  box.add(Box3f{});
  EXPECT_EQ(box.low, (Vec3f{1, 2, 3}));
  EXPECT_EQ(box.high, (Vec3f{1, 2, 3}));
  EXPECT_FALSE(box.meets({}));
}

// Every search finds the points of a box, in the order of the tree's leaves.
TEST(BoxTree, FindsWhatABoxContains) {
  reference::Random random(1);
  for (const std::size_t count : {0, 1, 4, 5, 300}) {
    std::vector<Vec3d> points(count);
    for (Vec3d& p : points) p = anywhere(random);
    const BoxTree<Box3d> tree(
        count,
        [&](std::uint32_t i) {
          return Box3d{points[i], points[i]};
        },
        Halving{4});
    std::vector<std::uint32_t> sorted = tree.order();
    std::sort(sorted.begin(), sorted.end());
    for (std::uint32_t i = 0; i < count; ++i) EXPECT_EQ(sorted.at(i), i);
    for (int search = 0; search < 20; ++search) {
      Box3d box;
      for (int k = 0; k < 2; ++k) box.add(anywhere(random));
      std::vector<std::uint32_t> found, expected;
      tree.any_leaf([&](const auto& node) { return box.meets(node.volume); },
                    [&](std::uint32_t first, std::uint32_t last) {
                      EXPECT_TRUE(last - first == 4 || last == count || count < 4);
                      for (std::uint32_t k = first; k < last; ++k)
                        if (box.contains(points[tree.order()[k]])) found.push_back(tree.order()[k]);
                      return false;
                    });
      for (const std::uint32_t i : tree.order())
        if (box.contains(points[i])) expected.push_back(i);
      EXPECT_EQ(found, expected);
      EXPECT_EQ(tree.any_leaf([](const auto&) { return true; }, [](std::uint32_t first, std::uint32_t last) { return first < last; }),
                count > 0);
    }
  }
}

}  // namespace steradian::box_tree_test
