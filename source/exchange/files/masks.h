// Masks: surfaces that lie on another one, face to face, as the floor of a cupboard lies on the floor of its room.
#pragma once

#include <cstddef>
#include <vector>

#include "steradian/view_factors.h"

namespace steradian::exchange {

// A mask and the covered part of its base exchange with each other alone.
struct FaceMask {
  std::size_t row = 0, base = 0;  // rows of the matrix
  double area = 0;                // [m2]
};

// Puts masks into a matrix whose rows of masks are empty and whose bases lack the covered parts: F from a mask to its base is 1, and the
// area of the base grows by that of the mask.
ViewFactors with_masks(const ViewFactors& factors, const std::vector<FaceMask>& masks);

}  // namespace steradian::exchange
