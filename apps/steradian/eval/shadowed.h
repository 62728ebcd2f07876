// Lights behind triangles in `steradian eval`.
#pragma once

#include <functional>

#include "eval/query.h"

namespace steradian::eval {

// What one lobe sends to the view of one of the query's lights behind query.occluders, by a method of the table. The point is moved off its
// surface along the geometric normal, and nothing below that normal's horizon arrives.
//
// Polygons: the visible part is exact, and the method integrates over it; `sampled` asks rays. Round lights: the value without
// occluders times the share that arrives of a polygon of 24 corners (quality high: 48); `reference` and `sampled` take one of 512.
RadianceResult shadowed_answer(const Query& query, const Light& source, const ShadingPoint& at, const Material& material,
                               const methods::Row& entry, const RadianceOptions& options,
                               const std::function<RadianceResult()>& unoccluded);

}  // namespace steradian::eval
