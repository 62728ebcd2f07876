// The mean of a textured light as one lobe weighs it, over cells of it (texture_tree.h).
#pragma once

#include <optional>

#include "integrals/ltc/texture_cells.h"

namespace steradian {

// The mean radiance. Nothing where the lobe is too narrow for the cells: what it sees is then a part of the texture that is
// larger than its texels, and a look-up serves.
//
// A cell's radiance is its own mean and first moments, against the lobe's values at its four elements; what both leave out, as
// the lobe's smoothness and the texture's deviation bound it, is summed, and the worst cell split, until the sum is small.
//   texels  those of the tree: below its smallest cells, the texture is what lies between them
std::optional<Vec3f> mean_under(const TextureTree& tree, const TextureView<double>& view, const PlaneTexels& texels);

}  // namespace steradian
