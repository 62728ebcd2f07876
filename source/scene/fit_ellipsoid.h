// Recognises meshes and outlines that stand for ellipsoids and ellipses, so that they can be lights of those shapes.
#pragma once

#include <optional>
#include <vector>

#include "scene/merge_polygons.h"
#include "shapes/shape.h"
#include "steradian/area_light.h"

namespace steradian::scene {

// Tolerances of both: corners lie on the shape to kOnShape of its size, and no face or edge comes nearer to its centre
// than kNearestFace of the way. A ball of 32 segments and 16 rings has 0.990, a circle of 16 corners 0.981; a cube, whose
// corners lie on a sphere as well, has 0.577.
inline constexpr double kOnShape = 1e-4;
inline constexpr double kNearestFace = 0.98;

// The ellipsoid, its half axes at right angles, of the area of a closed mesh that stands for one. None for any other mesh.
std::optional<Ellipsoid> fit_ellipsoid(const std::vector<Triangle>& triangles, const std::vector<std::size_t>& part);

// The ellipse of the area of a flat outline that stands for one; x cross y points to where it runs counter-clockwise.
std::optional<Ellipse> fit_ellipse(const std::vector<Vec3d>& outline);

}  // namespace steradian::scene
