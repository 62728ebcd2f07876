#include "solve/tile_products.h"

#include <algorithm>

#include "core/pack.h"

STERADIAN_BEGIN_ISA
namespace {

constexpr std::size_t kSide = 4;  // rows of a block of products, whose sums stay in registers

// The products of rows first_i and on with rows first_j and on. At the end of the rows, a block repeats the last one.
void add_block(const TileVector* rows, std::size_t count, std::size_t first_i, std::size_t first_j, double* products) {
  PackReal sums[kSide][kSide];
  for (auto& of_row : sums)
    for (PackReal& sum : of_row) sum = PackReal(0.0);
  for (TilePlane TileVector::*plane : {&TileVector::x, &TileVector::y, &TileVector::z}) {
    const float *a[kSide], *b[kSide];
    for (std::size_t k = 0; k < kSide; ++k) {
      a[k] = (rows[std::min(first_i + k, count - 1)].*plane).data();
      b[k] = (rows[std::min(first_j + k, count - 1)].*plane).data();
    }
    for (std::size_t at = 0; at < kTilePixels; at += kLanes) {
      const PackReal others[kSide] = {load(b[0] + at), load(b[1] + at), load(b[2] + at), load(b[3] + at)};
      for (std::size_t i = 0; i < kSide; ++i) {
        const PackReal own = load(a[i] + at);
        for (std::size_t j = 0; j < kSide; ++j) sums[i][j] = sums[i][j] + own * others[j];
      }
    }
  }
  for (std::size_t i = 0; i < kSide && first_i + i < count; ++i)
    for (std::size_t j = 0; j < kSide && first_j + j <= first_i + i; ++j)
      products[(first_i + i) * count + first_j + j] = static_cast<double>(xsimd::hadd(sums[i][j].v));
}

void find(const TileVector* rows, std::size_t count, double* products) {
  for (std::size_t i = 0; i < count; i += kSide)
    for (std::size_t j = 0; j <= i; j += kSide) add_block(rows, count, i, j, products);
}

}  // namespace

const TileProducts& tile_products() {
  static constexpr TileProducts table = {find};
  return table;
}

STERADIAN_END_ISA
