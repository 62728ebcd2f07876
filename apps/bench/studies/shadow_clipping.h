// Shadows by clipping polygons, as KT, Sakurikar and Narayanan publish them ("Fast analytic soft shadows from area lights", 2021, triangle
// mode): the light less one triangle after the other. For comparison; written from the paper's description.
#pragma once

#include <vector>

#include "core/random.h"
#include "shadow/edges.h"
#include "shadow/segments.h"
#include "steradian/polygon_light.h"

namespace steradian::studies {

// scaled: by a random factor within 1 %, each triangle anew, which keeps corners and edges from coinciding.
enum class Degenerate { scaled, as_they_are };
// Which triangles count: of closed meshes those that face the point are enough.
enum class Facing { front, any };

// What is left of the light, as contours in walk order for the point; the holes of what is left run the other way.
//
// In single precision, in the plane z = 1 of the shading frame, 1e-3 above the horizon. A triangle inside of a polygon becomes a hole,
// against which no later triangle is clipped: where such shadows overlap, they count twice, as published.
PreparedPolygon clipped_light(const PreparedPolygon& light, const shadow::EdgeMesh& mesh, const shadow::Viewpoint& from, Facing facing,
                              Degenerate degenerate, reference::Random& random);

}  // namespace steradian::studies
