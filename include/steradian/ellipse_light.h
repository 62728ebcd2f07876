// Disks, ellipses, spheres and ellipsoids as lights: their irradiance without approximation, and polygons that replace them for all other
// lobes. docs/theory/ggx.md, "Round lights".
#pragma once

#include "steradian/area_light.h"  // Ellipse, silhouette
#include "steradian/material.h"    // LobeAxis
#include "steradian/shading_point.h"

namespace steradian {

// Irradiance [radiance times sr] of radiance 1 at a point with a unit normal, of the part above the horizon, in [0, pi].
// Exact: arcs of the ellipse in closed form. 0 from behind (the side from which x cross y points away) and in its plane.
// Error: docs/measured/accuracy.md, "Float against double", ellipse.
double ellipse_irradiance(const Ellipse& ellipse, Vec3d position, Vec3d normal);
float ellipse_irradiance_float(const Ellipse& ellipse, Vec3d position, Vec3d normal);

// The same for an ellipsoid center + x u + y v + z w, |(u,v,w)| = 1; 0 from inside.
double ellipsoid_irradiance(const Ellipsoid& ellipsoid, Vec3d position, Vec3d normal);

// The polygon with that many vertices (even, 6 to 64) that replaces an ellipse for a point; its corners are dense where the lobe is sharp.
// 8 vertices serve a Phong lobe to 0.75 % of it, 12 to 0.1 %.
PolygonLight polygon_for_lobe(const Ellipse& ellipse, Vec3d position, const LobeAxis& lobe, int vertices = 8);

// The same with equal steps, for wide lobes: GGX and similar ones, 12 vertices.
PolygonLight polygon_of_equal_steps(const Ellipse& ellipse, Vec3d position, int vertices = 12);

}  // namespace steradian
