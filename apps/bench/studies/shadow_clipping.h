// Shadows by clipping polygons, as published by KT, Sakurikar and Narayanan ("Fast analytic soft shadows from area lights", 2021, triangle
// mode): the light minus one triangle after the other. For comparison; written from the paper's description.
#pragma once

#include <vector>

#include "core/random.h"
#include "shadow/edges/edges.h"
#include "shadow/edges/segments.h"
#include "steradian/polygon_light.h"

namespace steradian::studies {

// scaled: each triangle is scaled by a random factor within 1 %, which prevents coinciding corners and edges.
enum class Degenerate { scaled, as_they_are };
// The triangles that count. For closed meshes the triangles that face the point are enough.
enum class CountedTriangles { front, any };

// The visible part of the light, as contours in walk order for the point; its holes run in the opposite order.
//
// Computed in single precision, in the plane z = 1 of the shading frame, 1e-3 above the horizon. A triangle inside a polygon becomes a
// hole. No later triangle is clipped against it, so such shadows count twice if they overlap, as published.
PreparedPolygon clipped_light(const PreparedPolygon& light, const shadow::EdgeMesh& mesh, const shadow::Viewpoint& from,
                              CountedTriangles facing, Degenerate degenerate, reference::Random& random);

}  // namespace steradian::studies
