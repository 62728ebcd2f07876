// Products of rows on packs against sums in double, by every instruction set.
#include "solve/tile_products.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "core/random.h"

namespace steradian::tile_products_test {

// Each product is a sum of 3072 terms. Lanes add 192 to 768 of them in turn, and a rounding is half an epsilon of a partial sum, which is
// below the sum of the magnitudes: at most 768 epsilon of it.
TEST(TileProducts, AreThoseInDouble) {
  reference::Random random(1);
  for (const std::size_t count : {std::size_t{1}, std::size_t{4}, std::size_t{11}}) {
    std::vector<TileVector> rows(count);
    for (TileVector& row : rows)
      for (TilePlane* plane : {&row.x, &row.y, &row.z})
        for (std::size_t i = 0; i < kTilePixels; ++i) (*plane)[i] = static_cast<float>(random.uniform(-1, 2));
    for (const Simd simd : available_simd()) {
      std::vector<double> products(count * count, -1.0);
      tile_products_for(simd).find(rows.data(), count, products.data());
      double worst = 0;
      for (std::size_t i = 0; i < count; ++i)
        for (std::size_t j = 0; j <= i; ++j) {
          double sum = 0, magnitude = 0;
          for (const auto plane : {&TileVector::x, &TileVector::y, &TileVector::z})
            for (std::size_t k = 0; k < kTilePixels; ++k) {
              const double term = static_cast<double>((rows[i].*plane)[k]) * static_cast<double>((rows[j].*plane)[k]);
              sum += term;
              magnitude += std::fabs(term);
            }
          worst = std::max(worst, std::fabs(products[i * count + j] - sum) / magnitude);
        }
      std::printf("%s, %zu rows: within %.1e of the sum of magnitudes\n", name_of(simd), count, worst);
      EXPECT_LT(worst, 768 * static_cast<double>(std::numeric_limits<float>::epsilon()));
      EXPECT_EQ(count > 1 ? products[1] : -1.0, -1.0) << "above the diagonal nothing is set";
    }
  }
}

}  // namespace steradian::tile_products_test
