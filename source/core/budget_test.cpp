#include "core/budget.h"

#include <gtest/gtest.h>

namespace steradian::budget_test {
namespace {

template <class F>
std::string refusal(F f) {
  try {
    f();
  } catch (const Error& e) {
    return e.what();
  }
  return "";
}

TEST(Budget, RefusesWhatExceedsItAndNamesTheOption) {
  Budget budget({.memory = 3'000'000'000, .work = 5'000'000});
  budget.take_memory("a.glb", "its buffers", 2'000'000'000);
  EXPECT_EQ(refusal([&] { budget.take_memory("a.glb: meshes[3]", "its vertices", 1'500'000'000); }),
            "a.glb: meshes[3]: would take 1.5 GB of memory for its vertices, 1 GB of 3 GB are left (raise the limit with "
            "--max-memory, or use less)");
  EXPECT_EQ(budget.memory_taken(), 2'000'000'000u) << "what is refused must not count";
  budget.take_memory("a.glb", "the rest", 1'000'000'000);
  EXPECT_NE(refusal([&] { budget.take_memory("a.glb", "one more", 1); }), "");
  budget.give_back_memory(10);
  budget.take_memory("a.glb", "ten more", 10);
  EXPECT_EQ(refusal([&] { budget.take_work("a.svg: path 2", "its crossings", 5'000'001); }),
            "a.svg: path 2: would take 5 million steps for its crossings, 5 million steps of 5 million steps are left "
            "(raise the limit with --max-work, or use less)");
  budget.take_work("a.svg", "its crossings", 5'000'000);
  EXPECT_NE(refusal([&] { budget.take_work("a.svg", "its crossings", 1); }), "");
}

TEST(Budget, CannotBeOverflown) {
  Budget budget({.memory = 1000, .work = 1000});
  budget.take_memory("x", "y", 999);
  EXPECT_NE(refusal([&] { budget.take_memory("x", "y", ~std::uint64_t{0}); }), "");
  EXPECT_NE(refusal([&] { budget.take_work("x", "y", ~std::uint64_t{0}); }), "");
  budget.give_back_memory(~std::uint64_t{0});
  EXPECT_EQ(budget.memory_taken(), 0u);
}

TEST(Budget, SaysWhatWasBuiltWhenTheMachineRunsOut) {
  Budget budget;
  budget.take_memory("a.glb: images[0]", "its texels", 1 << 20);
  EXPECT_EQ(std::string(budget.out_of_memory().what()),
            "a.glb: images[0]: the machine ran out of memory after 1.05 MB, the last of them 1.05 MB for its texels (free "
            "some memory, or use less)");
}

}  // namespace
}  // namespace steradian::budget_test
