// Tubes as lights, capsules and lines: their irradiance without approximation, and polygons that replace them for all other lobes.
// docs/theory/ggx.md, "Round lights".
#pragma once

#include "steradian/area_light.h"  // Capsule
#include "steradian/material.h"    // LobeAxis

namespace steradian {

// Irradiance [radiance times sr] of radiance 1 at a point with a unit normal, of the part above the horizon, in [0, pi]. Exact: the
// outline's arcs and edges in closed form. 0 from inside, and for a radius of 0. Error: docs/measured/accuracy.md, "Float against double",
// capsule.
double capsule_irradiance(const Capsule& capsule, Vec3d position, Vec3d normal);
float capsule_irradiance_float(const Capsule& capsule, Vec3d position, Vec3d normal);

// Irradiance [1/m] of a line whose radiance times width is 1 W/(sr m): the limit of capsule_irradiance over the width
// 2 radius. A capsule at distance m differs from it by at most (pi/2) r/m^2 (1 + 4 r/m).
double line_irradiance(Vec3d end_a, Vec3d end_b, Vec3d position, Vec3d normal);
float line_irradiance_float(Vec3d end_a, Vec3d end_b, Vec3d position, Vec3d normal);

// Distance of a point from the capsule's segment; the point is inside if this is not above the radius.
double distance_to_axis(const Capsule& capsule, Vec3d position);

// Distance along a ray (unit direction) to its point nearest to the capsule's segment; not negative.
double distance_along(const Capsule& capsule, Vec3d origin, Vec3d direction);

// The polygon with that many vertices (6 to 2048) that replaces a capsule for a point outside; its corners are dense where the lobe is
// sharp. No vertices from inside, and for a capsule too thin to have an outline.
PolygonLight polygon_for_lobe(const Capsule& capsule, Vec3d position, const LobeAxis& lobe, int vertices = 8);

// The same with equal steps along the arcs.
PolygonLight polygon_of_equal_steps(const Capsule& capsule, Vec3d position, int vertices = 12);

}  // namespace steradian
