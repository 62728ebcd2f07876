// Spheres and ellipsoids as lights: their outline, seen from a point, is a planar ellipse.
//
// Needs: constants.glsl frame.glsl
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.

// The ellipse center + axis_a cos t + axis_b sin t, vectors from the shading point [m], and whether it can be seen.
struct EllipsoidOutline {
    vec3 center;
    vec3 axis_a;
    vec3 axis_b;
    mask outside;  // false: the point is inside, no light
};

// Outline of the ellipsoid c + S u, |u| = 1, whose cone of tangents meets the shading point.
//
//   to_center  c - p, from the shading point p to the centre
//   s          S, half axes as columns
//   inverse    S^-1, its columns
//
// Degenerate: a point inside or on the ellipsoid gives outside = false and a finite outline.
// Source: the unit sphere's outline from distance d is the circle of radius sqrt(1 - 1/d^2) at height 1/d above the
// centre; S maps it.
EllipsoidOutline ellipsoid_outline(vec3 to_center, mat3 s, mat3 inverse) {
    vec3 p = -transform(inverse, to_center);
    real d2 = dot(p, p);
    real safe = max(d2, 1.000001);
    real inverse_d = inversesqrt(safe);
    vec3 k = p * inversesqrt(max(d2, smallest_divisor()));
    real rho = sqrt(1.0 - 1.0 / safe);
    mat3 frame = frame_from_normal(k);
    vec3 a = transform(frame, vec3(rho, 0.0, 0.0));
    vec3 b = transform(frame, vec3(0.0, rho, 0.0));
    EllipsoidOutline outline;
    outline.center = to_center + transform(s, k * inverse_d);
    outline.axis_a = transform(s, a);
    outline.axis_b = transform(s, b);
    outline.outside = d2 > 1.000001;
    return outline;
}
