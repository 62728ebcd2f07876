// Disks, ellipses, spheres, ellipsoids, capsules and lines under every method: closed forms for the diffuse lobe, polygons for the other
// lobes.
#pragma once

#include "integrals/methods.h"
#include "shapes/shape.h"

namespace steradian::methods {

// The light relative to the point, in units in which its largest number is 1: no square leaves the range of double. A line's radiance times
// width is per unit of length, too. Throws Error if a number is then not finite.
//
//   unit  receives the unit, if it is not 1
AreaLight seen_from(const AreaLight& light, Vec3d position, double* unit = nullptr);

// Radiance that one lobe sends to the view, by a method of the table.
//
// lambert by `exact` has a closed form. Other methods walk a polygon of 32 vertices (quality high: 48) that gather about the lobe. `exact`
// and `sampled` use one of 1024. `reference` compares 512 with 1024, and its bound includes the difference. A line, and a capsule thinner
// than 1e-7 of its distance, is for them a strip across the line of sight. Its half width subtends a thousandth of the lobe's width (in
// float 3 %), and its radiance is higher in proportion. The error is quadratic in that width; `reference` doubles it once and includes the
// difference in its bound.
RadianceResult curved_light_answer(const AreaLight& light, const ShadingPoint& at, const Material& material, const Row& entry,
                                   const RadianceOptions& options);

// The strip of that kind that stands for a line seen from the origin, in walk order from its lit side. Its first and last corners lie
// beside end_a, the others beside end_b. No corners if the line points at the origin.
//
//   radiance  times width
PolygonLight strip_of_line(const Line& line, Vec3d radiance, const ShadingPoint& at, const Material& material, Precision precision);

}  // namespace steradian::methods
