// Products of a tile's residuals and their derivatives, summed over its pixels and channels on packs: the normal equations.
#pragma once

#include "core/simd.h"
#include "render/tile/tile.h"

namespace steradian::solving {

struct TileProducts {
  // Sets products[i * count + j], for j <= i, to the sum of rows[i] times rows[j]. Sums are of single precision, as their terms are.
  void (*find)(const TileVector* rows, std::size_t count, double* products);
};

}  // namespace steradian::solving

namespace steradian {

using solving::TileProducts;
STERADIAN_DECLARE_PACK_TABLE(TileProducts, tile_products)

}  // namespace steradian
