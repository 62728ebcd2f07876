// Contribution of a visible piece of a light to a point: closed forms of kernels/plane/plane.glsl, in double.
#pragma once

#include "plane/exact/envelope.h"

namespace steradian::plane {

// Adds to `sum` the integral over the piece's directions of radiance, and of radiance times direction (not yet divided by 2 pi). There are
// closed forms, except for arcs with anything else than a uniform radiance (and, on circles, a range): those use Gauss-Legendre to 1e-10.
// Moments of a disk with a range have no closed form: `radiance` omits them.
enum class EmissionParts { radiance, radiance_and_moments };
void add_emission(const Visible& piece, const PlaneEmission& emission, Vec2d from, EmissionParts parts, PlaneLight& sum);

// The inside of a light: its radiance at the point, the same in all directions of the piece.
void add_interior(const Visible& piece, const PlaneEmission& emission, Vec2d from, PlaneLight& sum);

// Radiance along one ray that hits the curve at distance r, for sampled rays.
Vec3d radiance_along(const Curve& curve, const PlaneEmission& emission, Vec2d from, Vec2d u, double r);

// Does a spot send light to the point from direction u?
bool within_spot(const PlaneEmission& emission, Vec2d u);

}  // namespace steradian::plane
