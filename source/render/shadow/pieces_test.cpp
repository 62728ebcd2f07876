// Parts of lights in one pack: points near their part next to points far from theirs.
#include <gtest/gtest.h>

#include <array>

#include "render/direct/lobe_packs.h"

namespace steradian::pieces_test {
namespace {

constexpr std::size_t kPoints = 16;

// A square in direction z, in walk order.
void add_square(packed::Pieces& pieces, std::size_t point, float half, float distance) {
  const std::array<Vec3f, 4> corners = {
      Vec3f{-half, -half, distance}, {half, -half, distance}, {half, half, distance}, {-half, half, distance}};
  for (std::size_t k = 0; k < 4; ++k) pieces.set_edge(point, k, corners[k], corners[(k + 1) % 4]);
}

// The closed form at equal points. If asked for, every other point sees a square from so far that elements replace it.
std::array<float, kPoints> radiance(bool some_are_far) {
  packed::Pieces pieces;
  pieces.add_block(4);
  for (std::size_t i = 0; i < kPoints; ++i) {
    const bool far = some_are_far && i % 2 == 1;
    add_square(pieces, i, 0.2f, far ? 100.0f : 1.0f);
    if (far) pieces.set_elements(i, {{0, 0, 100}, {0.16, 0, 0}, {0, 0.16, 0}}, {0, 0, -0.16});
  }
  PackLight light;
  light.radiance = {1, 1, 1};
  light.shape = pieces;
  alignas(64) std::array<float, kPoints> zero{}, nx, ny{}, nz, tx, alpha, plain, fresnel;
  nx.fill(0.6f);
  nz.fill(0.8f);
  tx.fill(0);
  alpha.fill(0.3f);
  const VectorArrays none{zero.data(), zero.data(), zero.data()}, up{nx.data(), ny.data(), nz.data()};
  const Points points{kPoints, none, up, up, {tx.data(), ny.data(), tx.data()}, alpha.data(), alpha.data()};
  lobe_packs_for(active_simd())[methods::Procedure::closed_form](light, points, {}, {plain.data(), fresnel.data()});
  return plain;
}

TEST(Pieces, NearPartsDoNotMindFarOnesInTheirPack) {
  const std::array<float, kPoints> alone = radiance(false), mixed = radiance(true);
  for (std::size_t i = 0; i < kPoints; i += 2) {
    EXPECT_GT(alone[i], 0.01f) << i;
    EXPECT_EQ(mixed[i], alone[i]) << i;
    EXPECT_GT(mixed[i + 1], 0) << i;
  }
}

}  // namespace
}  // namespace steradian::pieces_test
