// PolygonLight: a flat light of any outline, with holes: the form in scenes, and the prepared form for the integrals.
#pragma once

#include <cstddef>
#include <limits>
#include <vector>

#include "steradian/vector.h"

namespace steradian {

// The lit side is the one from which the outline runs counter-clockwise. Holes run in reverse; either order is accepted.
struct PolygonLight {
  std::vector<Vec3d> vertices;
  std::vector<std::vector<Vec3d>> holes;
  Vec3d radiance{1, 1, 1};  // linear RGB, W/(m2 sr) or nits
  bool two_sided = false;
};

// Four points that represent a small flat light: center +- reach_a and center +- reach_b, a quarter of the area each. They have the
// centroid and second moments of its area (kernels/outline/light_elements.glsl). They are infinitely far apart until they are set, so that
// no light counts as small by mistake. An example is the part of a light that occluders leave visible.
struct LightQuarters {
  Vec3d center;
  Vec3d reach_a{std::numeric_limits<double>::infinity(), 0, 0}, reach_b;
};

// A light prepared for walks: every contour is in walk order (the reverse of the stored order, see kernels/outline/polygon.glsl).
struct PreparedPolygon {
  std::vector<Vec3d> vertices;        // of all contours, one after the other
  std::vector<std::size_t> contours;  // start of each contour, and the number of vertices at the end; one of two vertices is a single edge,
                                      // not closed
  Vec3d normal;                       // unit, to the lit side; zero for a light without area
  Vec3d centroid;                     // mean of the outline's vertices
  double area = 0;                    // of the outline without the holes [m2]
  LightQuarters quarters;
  Vec3d radiance{1, 1, 1};
  bool two_sided = false;

  // +1 if p sees the lit side, -1 if it sees the back, 0 in the plane or for a light without area.
  int side_of(Vec3d p) const;
};

// Reverses into walk order, drops repeated vertices, and orients the holes against the outline. Throws Error for fewer than three vertices,
// a vertex that is not finite, and vertices further than 1e-5 of the light's size off its plane.
PreparedPolygon prepare_polygon(const PolygonLight& light);

// Irradiance [radiance times sr] of radiance 1 at a point with a unit normal, in double, in [0, pi].
// 0 from behind (unless two-sided), and in the light's plane. Error: docs/measured/accuracy.md, "polygon irradiance".
double polygon_irradiance(const PreparedPolygon& light, Vec3d position, Vec3d normal);
float polygon_irradiance_float(const PreparedPolygon& light, Vec3d position, Vec3d normal);

// Solid angle [sr], in [0, 2 pi], of the whole light (no horizon). 0 from behind, unless two-sided.
double polygon_solid_angle(const PreparedPolygon& light, Vec3d position);

}  // namespace steradian
