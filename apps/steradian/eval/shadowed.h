// Occluded lights in `steradian eval`.
#pragma once

#include <functional>

#include "eval/query.h"
#include "integrals/outline_derivatives.h"
#include "shadow/region/derivatives.h"

namespace steradian::eval {

// The radiance that one lobe sends to the view from one of the query's lights behind query.occluders, by a method of the table. The point
// is moved off its surface along the geometric normal. Nothing below that normal's horizon arrives. In the plane of a face that stands on
// the surface, the answer is the mean of both sides.
//
// Polygons: the visible part is exact, and the method integrates over it. Round lights: the value without occluders times the visible
// fraction of a polygon of 24 corners (quality high: 48). `reference` and `sampled` share none of it: they take the light's true surface
// and every triangle, by quadrature and by rays.
RadianceResult shadowed_answer(const Query& query, const Light& source, const ShadingPoint& at, const Material& material,
                               const methods::Row& entry, RadianceOptions options, const std::function<RadianceResult()>& unoccluded);

// Derivatives past occluders.
struct ShadowedDerivatives {
  OutlineDerivatives light;                  // by the light's parts and the point
  std::vector<shadow::ByChannel> occluders;  // by the positions of the triangles; equal positions that move together count at the first
};

// Derivatives of one lobe under any light with an extent. A round light is a polygon of 96 corners that are points of it, as the point sees
// it (quality high: 192). What an occluder hides between that polygon and a ball's surface does not count. Throws Error for unsupported
// lobes, methods and lights. They are derivatives of the lobe itself; the method's value differs from it by its error.
ShadowedDerivatives shadowed_derivatives(const Query& query, const AreaLight& light, const Material& material, const methods::Row& entry);

}  // namespace steradian::eval
