// Round lights behind triangles: the flat polygon that stands for one.
#pragma once

#include <optional>
#include <vector>

#include "shadow/segments.h"
#include "steradian/area_light.h"

namespace steradian::shadow {

// The polygon that a point sees of a round light, in a plane close to the light: what stands before the light, and nothing
// else, must stand before the plane. A sphere's is its silhouette; a tube's holds its axis and faces the point, and near its
// axis crosses its nearer ball.
//
//   corners  of equal area: 24 are 4.5e-5 rms off in penumbrae (docs/shadows.md)
//   returns  no vertices where nothing is seen
PreparedPolygon polygon_of_round(const AreaLight& area, Vec3d position, int corners);

// The same for a sphere or an ellipsoid at once as a frame, along the axes of the ellipse that it seems to be; without contours.
// Nothing where nothing is seen.
std::optional<LightFrame> frame_of_ellipsoid(const Ellipsoid& light, Vec3d position, int corners);

// The contour of such a frame, and its segments, which are the same for all of them.
std::vector<Corner> contour_of_ellipse(const LightFrame& frame, int corners);
std::vector<Segment> outline_of_ellipse(int corners);

}  // namespace steradian::shadow
