// PlaneElement: a plane polygon with holes that exchanges radiation from its front.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "steradian/vector.h"

namespace steradian::exchange {

// The outline runs counter-clockwise as seen from the front, holes run clockwise. More than one outline is fine: integrals along contours
// only need the sum.
struct PlaneElement {
  std::vector<std::vector<Vec3d>> contours;
  Vec3d normal, centroid;
  double area = 0, radius = 0;  // radius: of the ball about the centroid
  double off_plane = 0;         // largest height of a corner above or below the plane: files round corners to 32 bits
  // Half edges of a parallelogram, or of a quadrilateral that rounding keeps from being one; zero vectors for any other shape.
  Vec3d half_a, half_b;
  // A product rule on the parallelogram then errs by skew / R of A1 A2 / (pi R^2) at the least distance R: docs/theory/view_factors.md.
  double skew = 0;

  bool is_empty() const { return contours.empty(); }
  bool is_parallelogram() const { return dot(half_a, half_a) > 0; }
};

// Vertices may lie this far off the plane, as a fraction of the element's size. The corners of 32-bit files need it.
inline constexpr double kOffPlane = 1e-6;

// Corners lie in the plane of another element up to this many times what the corners of both are off their planes.
inline constexpr double kInPlane = 2;

// Makes an element from its corners. Repeated corners are dropped, and holes are turned against the outline. The normal is that of the
// outline. Throws Error at `place` if there are fewer than three corners, a coordinate that is not finite, no area, or a corner off the
// plane by more than kOffPlane of the size.
PlaneElement make_element(const std::vector<Vec3d>& outline, const std::vector<std::vector<Vec3d>>& holes, const std::string& place);

// True if a corner lies further off the plane of its polygon than make_element accepts.
bool is_bent(const std::vector<Vec3d>& outline);

// The part of an element in front of the plane of another one. Corners that are nearer to the plane than rounding, or than corners are
// off their planes, lie in it.
PlaneElement in_front_of(const PlaneElement& element, const PlaneElement& plane);

// Cuts an element by a plane; `side` is 1 for the part in front of it and -1 for the part behind.
PlaneElement cut_element(const PlaneElement& element, Vec3d point, Vec3d normal, int side);

// The same element with its front on the other side.
PlaneElement turned_over(const PlaneElement& element);

// True if no contour touches or crosses itself or another one.
bool is_simple(const PlaneElement& element);

// Triangles that cover the element. Holes may touch the outline and each other. None if contours cross, or if the outline touches itself.
std::optional<std::vector<PlaneElement>> split_element(const PlaneElement& element);

// The same. Throws Error at `place` if there are none.
std::vector<PlaneElement> triangles_of_element(const PlaneElement& element, const std::string& place);

}  // namespace steradian::exchange
