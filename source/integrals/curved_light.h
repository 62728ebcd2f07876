// Disks, ellipses, spheres, ellipsoids, capsules and lines seen by every method: closed forms for the diffuse lobe, polygons in
// their place for the others.
#pragma once

#include "integrals/methods.h"
#include "shapes/shape.h"

namespace steradian::methods {

// What one lobe sends to the view, by a method of the table.
//
// lambert by `exact` is closed. Other methods walk a polygon of 32 vertices (quality high: 48) that gather about the lobe;
// `exact` and `sampled` one of 1024; `reference` compares 512 with 1024, and its bound holds that difference. A line, and a
// capsule thinner than 1e-7 of its distance, is for them a strip across the sight: of a half width, seen, of a thousandth of
// the lobe's width (in float 3 %), and its radiance so much the higher. The error is quadratic in that width; `reference`
// doubles it once and holds the difference in its bound.
RadianceResult curved_light_answer(const AreaLight& light, const ShadingPoint& at, const Material& material, const Row& entry,
                                   const RadianceOptions& options);

}  // namespace steradian::methods
