// Round lights behind triangles: the flat polygon that represents a round light.
#pragma once

#include <optional>
#include <vector>

#include "shadow/edges/segments.h"
#include "steradian/area_light.h"

namespace steradian::shadow {

// The polygon that a point sees of a round light, in a plane close to the light. Occluders must stand before the plane exactly if they
// stand before the light. A sphere's plane is that of its silhouette. A tube's plane contains its axis and faces the point; near the axis,
// it crosses the nearer ball.
//
//   corners  of equal area: 24 are 4.5e-5 rms off in penumbrae
//   returns  no vertices if nothing is visible
PreparedPolygon polygon_of_round(const AreaLight& area, Vec3d position, int corners);

// The outline of a tube in up to three flat parts: the segments of circles in which the two ends are seen, and the rectangle between them.
// Each lies inside the tube: whatever stands outside of the tube and before the parts stands before the tube. Empty from inside.
std::vector<PreparedPolygon> parts_of_tube(const Capsule& tube, Vec3d radiance, Vec3d position, int corners);

// The same for a sphere or an ellipsoid, returned as a frame along the axes of its visible ellipse, without contours. Returns none if
// nothing is visible.
std::optional<LightFrame> frame_of_ellipsoid(const Ellipsoid& light, Vec3d position, int corners);

// The contour of such a frame, and its segments, which are the same for all such frames.
std::vector<Corner> contour_of_ellipse(const LightFrame& frame, int corners);
std::vector<Segment> outline_of_ellipse(int corners);

}  // namespace steradian::shadow
