// Recognises closed meshes that approximate tubes with round ends.
#pragma once

#include <optional>
#include <vector>

#include "scene/emitters/merge_polygons.h"
#include "steradian/shape.h"

namespace steradian::scene {

// The capsule of equal area, if the closed mesh approximates one. The tolerances are those of fit_ellipsoid.h, both as fractions of the
// radius, and the rounding of single precision. None for any other mesh, including balls and cylinders with flat ends.
std::optional<Capsule> fit_capsule(const std::vector<Triangle>& triangles, const std::vector<std::size_t>& part);

}  // namespace steradian::scene
