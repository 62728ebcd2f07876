// Outlines of bodies, and the crossings of their curves.
#pragma once

#include <vector>

#include "core/box.h"
#include "steradian/plane.h"

namespace steradian::plane {

// Outlines: the segments and arcs of bodies, which rays can hit.

// An ellipse as the image of the unit circle: center + x cos(tau) + y sin(tau).
struct PlaneEllipse {
  Vec2d center, x, y;
  // Maps to the space where it is the unit circle around the origin.
  Vec2d to_unit(Vec2d p) const {
    const double det = cross(x, y);
    const Vec2d v = p - center;
    return {cross(v, y) / det, cross(x, v) / det};
  }
  Vec2d at(double tau) const { return center + x * std::cos(tau) + y * std::sin(tau); }
};

struct Curve {
  enum class Kind { segment, arc };
  Kind kind = Kind::segment;
  bool two_sided = false;  // both faces block and emit; else only the outer one is visible from outside
  int body = 0;
  Vec2d a, b;            // segment, the body to the left of a -> b; arc: its ends
  PlaneEllipse ellipse;  // arc: counter-clockwise (cross(x, y) > 0) from tau0 over tau_span
  double tau0 = 0, tau_span = 0;
};

// Curves of a body. Throws Error if values are not finite, or the body is empty.
std::vector<Curve> outline_of(const PlaneBody& body, int index);

// Is p in the body or on its edge? Always false for polylines.
bool contains(const PlaneBody& body, Vec2d p);

// The gradient's radiance at a point.
Vec3d radiance_at(const PlaneEmission& emission, Vec2d p);

// Places on a curve, from 0 at its start to 1 at its end, at which the gradient has a stop: rising, including 0 and 1.
std::vector<double> gradient_cuts(const PlaneGradient& gradient, const Curve& curve);

// The part of a curve between two such places.
Curve part_of(const Curve& curve, double from, double to);

// Radiance at the ends of a segment on which it is linear.
struct RadianceEnds {
  Vec3d a, b;
};
RadianceEnds radiance_ends(const PlaneEmission& emission, Vec2d a, Vec2d b);

// With a margin for points that are on the outline up to rounding.
Box2d bounds_of(const PlaneBody& body);

// Crossings of two curves.

struct Crossings {
  int count = 0;
  Vec2d at[4];
};

// Crossings of the whole lines and ellipses that the curves lie on, at most four; some may lie beyond the curves' ends.
Crossings intersect(const Curve& a, const Curve& b);

// Real roots in [low, high] of the polynomial c[0] + c[1] x + ... + c[degree] x^degree, degree at most 4.
struct Roots {
  int count = 0;
  double at[4];
};
Roots real_roots(const double* c, int degree, double low, double high);

}  // namespace steradian::plane
