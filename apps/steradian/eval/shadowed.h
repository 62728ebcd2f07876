// Lights behind triangles in `steradian eval`.
#pragma once

#include <functional>

#include "eval/query.h"
#include "shadow/derivatives.h"

namespace steradian::eval {

// What one lobe sends to the view of one of the query's lights behind query.occluders, by a method of the table. The point is moved off its
// surface along the geometric normal, and nothing below that normal's horizon arrives.
//
// Polygons: the visible part is exact, and the method integrates over it; `sampled` asks rays. Round lights: the value without
// occluders times the share that arrives of a polygon of 24 corners (quality high: 48); `reference` and `sampled` take one of 512.
RadianceResult shadowed_answer(const Query& query, const Light& source, const ShadingPoint& at, const Material& material,
                               const methods::Row& entry, const RadianceOptions& options,
                               const std::function<RadianceResult()>& unoccluded);

// What `derivatives` adds past occluders.
struct ShadowedDerivatives {
  RadianceDerivatives light;                 // by the vertices as stored; not by the normal
  shadow::ByChannel position{};              // by the point
  std::vector<shadow::ByChannel> occluders;  // by the positions of the triangles; where some are equal and move together, at the first
};

// Of one lobe under a polygon. Throws Error for lobes and methods that have none. Of the lobe itself, from which the method's value differs
// by its error.
ShadowedDerivatives shadowed_derivatives(const Query& query, const PolygonLight& light, const Material& material,
                                         const methods::Row& entry);

}  // namespace steradian::eval
