// Recognises closed meshes that stand for tubes with round ends.
#pragma once

#include <optional>
#include <vector>

#include "scene/merge_polygons.h"
#include "steradian/shape.h"

namespace steradian::scene {

// The capsule of the area of a closed mesh that stands for one: by the tolerances of fit_ellipsoid.h, both shares of the
// radius, and the rounding of single precision. None for any other mesh, a ball and a cylinder with flat ends among them.
std::optional<Capsule> fit_capsule(const std::vector<Triangle>& triangles, const std::vector<std::size_t>& part);

}  // namespace steradian::scene
