// Recognition of round lights in meshes: tubes, ellipsoids and ellipses.
#pragma once

#include <optional>
#include <vector>

#include "scene/emitters/merge_polygons.h"
#include "shapes/shape.h"
#include "steradian/area_light.h"
#include "steradian/shape.h"

namespace steradian::scene {

// Recognises closed meshes that approximate tubes with round ends.

// The capsule of equal area, if the closed mesh approximates one. The tolerances are those of ellipsoids below, both as fractions of the
// radius, and the rounding of single precision. None for any other mesh, including balls and cylinders with flat ends.
std::optional<Capsule> fit_capsule(const std::vector<Triangle>& triangles, const std::vector<std::size_t>& part);

// Recognises meshes and outlines that approximate ellipsoids and ellipses, so that they become lights of those shapes.

// Tolerances for both shapes. Corners lie on the shape to kOnShape of its size. No face or edge comes nearer to the centre than
// kNearestFace of the radius. A ball of 32 segments and 16 rings has 0.990, a circle of 16 corners 0.981. A cube, whose corners also lie on
// a sphere, has 0.577.
inline constexpr double kOnShape = 1e-4;
inline constexpr double kNearestFace = 0.98;

// The ellipsoid of equal area, if the closed mesh approximates one. Its half axes are at right angles. None for any other mesh.
std::optional<Ellipsoid> fit_ellipsoid(const std::vector<Triangle>& triangles, const std::vector<std::size_t>& part);

// The ellipse of equal area, if the flat outline approximates one. x cross y points to the side from which the outline runs
// counter-clockwise.
std::optional<Ellipse> fit_ellipse(const std::vector<Vec3d>& outline);

}  // namespace steradian::scene
