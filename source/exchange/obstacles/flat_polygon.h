// Convex polygons in the plane of an element: the pieces over which a hidden part is integrated.
#pragma once

#include <vector>

#include "exchange/obstacles/shadow_events.h"
#include "steradian/vector2.h"

namespace steradian::exchange {

// Corners run counter-clockwise.
using FlatPolygon = std::vector<Vec2d>;

inline double cross2(Vec2d a, Vec2d b) { return a.x * b.y - a.y * b.x; }

double area_of(const FlatPolygon& p);
Vec2d centroid_of(const FlatPolygon& p, double area);

// The part of a convex polygon on the left of a line (side 1), or on its right (side -1). Corners up to `near` from the line lie on it.
FlatPolygon part_beside(const FlatPolygon& p, Vec2d from, Vec2d along, double side, double near);

// Cuts a segment to the part inside a convex polygon; false if there is none. Segments along an edge lie outside.
bool clip_to_polygon(EventSegment& s, const FlatPolygon& p, double near);

// A quadrangle with bilinear coordinates from 0 to 1; a triangle has d = a.
struct FlatQuad {
  struct PlaceOnQuad {
    Vec2d at;
    double area;  // of the place, for an area of 1 of the coordinates
  };

  PlaceOnQuad at(double s, double t) const {
    const Vec2d along_s = (b - a) * (1 - t) + (c - d) * t, along_t = (d - a) * (1 - s) + (c - b) * s;
    return {(a * (1 - s) + b * s) * (1 - t) + (d * (1 - s) + c * s) * t, cross2(along_s, along_t)};
  }

  Vec2d a, b, c, d;
};

// Cuts a convex polygon into quadrangles and one triangle about its first corner. Calls use(quad) until it returns false. Returns true if
// it never did.
template <class Use>
bool for_each_quad(const FlatPolygon& p, Use use) {
  for (std::size_t i = 1; i + 1 < p.size(); i += 2)
    if (!use(FlatQuad{p[0], p[i], p[i + 1], i + 2 < p.size() ? p[i + 2] : p[0]})) return false;
  return true;
}

}  // namespace steradian::exchange
