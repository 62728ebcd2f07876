// Far lights: one surface element in the place of a light, and how far off that and what is interpolated can be.
//
// The irradiance vector of a light does not depend on the receiver's normal as long as no horizon cuts the light, and is smooth
// in the receiver's place: so one polynomial over the places of many receivers may stand for the light. Both bounds here rest on one
// fact. Along any line, the k-th derivative of an element's vector over k! is at most (k + 1) |area| / R^(k + 2), R the distance: in the
// plane of the line the vector is a sum of 1/r^2 and 1/conj(r)^2, whose coefficients are U_k(cos) and k + 1. It is sharp towards the
// element, and holds for r / r^3, the vector of spheres and points, too.
// Frame: any. Vectors go from the receiver to the light. Errors are shares of |area| / R^2, what an element sends at most; R is
// the least distance between any receiver and any point of the light.
// Needs: constants.glsl
// Topics: far_element, far_ball, far_error, far_grazing
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.

// Irradiance vector of an element of radiance 1; 0 from behind.
//
//   area  unit normal to the lit side, times the area [m^2]
//   r     to the element [m]
//
// Degenerate: at the element it is finite.
vec3 far_element_vector(vec3 area, vec3 r) {
    real inverse = 1.0 / max(dot(r, r), smallest_divisor());
    return (r * inverse) * (max(-dot(area, r), 0.0) * inverse);
}

// Irradiance vector of a ball of radiance 1 that covers 1 m^2, wholly above the horizon: exact at any distance.
//
// Source: Lambert 1760. Degenerate: at the centre it is finite.
vec3 far_ball_vector(vec3 r) {
    real inverse = inversesqrt(max(dot(r, r), smallest_divisor()));
    return (r * inverse) * (inverse * inverse);
}

// Error of one element in the light's centroid: what is linear over the light it has exactly.
//
//   deviation2  mean square distance of the light's points from the centroid
//   distance2   R^2 > 0
real far_error_of_one(real deviation2, real distance2) { return 3.0 * deviation2 / distance2; }

// Error of four elements with the light's first and second moments (light_elements.glsl).
//
//   third      mean cubed distances from the centroid, the light's and the elements' together
//   fourth     the same of fourth powers
//   symmetric  the light is its own mirror image about its centroid: then no cubic part is left
real far_error_of_four(real third, real fourth, mask symmetric, real distance2) {
    real by_third = 4.0 * third * inversesqrt(distance2);
    real by_fourth = 5.0 * fourth / distance2;
    return select(symmetric, min(by_third, by_fourth), by_third) / distance2;
}

// Error of one element of a flat light, clamped to 0 below the receiver's horizon, where the horizon may cut the light.
//
//   top           greatest height of the light above the horizon [m], not negative
//   deviation_up  root of the mean square height of the light's points about its centroid's
//   deviation     root of deviation2
//   distance      R > 0
//
// The irradiance is the mean of max(height, 0) times k = -n'.r / r^4, whose slope is at most 3 / R^4. With k held, a mean differs from the
// centroid's value by half of the mean distance of the heights from it at most; what k changes is the second part. Nor do both
// exceed top / R.
real far_error_across_horizon(real top, real deviation_up, real deviation, real distance) {
    real inverse = 1.0 / distance;
    return min(top * inverse, (0.5 * deviation_up + 3.0 * top * deviation * inverse) * inverse);
}

// Error of a polynomial through Chebyshev's nodes along an axis.
//
//   nodes     their number, at least 1
//   reach     half the length of the interval
//   distance  R > 0
real far_error_of_nodes(int nodes, real reach, real distance) {
    real step = reach / (2.0 * distance);
    real power = 2.0 * real(nodes + 1);
    for (int i = 0; i < nodes; i++) {
        power = power * step;
    }
    return power;
}

// Upper bound of Schlick's (1 - v.h)^5 where the cosine of half the angle between view and light is at least c, and of how fast it
// turns with the light's direction [1/rad].
vec2 far_grazing(real c) {
    real x = clamp(1.0 - c, 0.0, 1.0);
    real x2 = x * x;
    return vec2(x2 * x2 * x, 2.5 * x2 * x2 * sqrt(max(1.0 - (1.0 - x) * (1.0 - x), 0.0)));
}

// Error of a polynomial through Chebyshev's nodes of the vector times (1 - v.h)^5, v the direction to an eye that stays.
//
//   view_distance  least distance of the receivers from the eye, > 0
//   least_square   least square of v.h over receivers and light: (1 + v.l) / 2
//
// By Cauchy's inequality over discs of three radii in the complex plane. A step of radius rho times a unit vector turns l by at most
// x = rho / (R - rho), v by y alike, and v.l by x + y + x y; the vector grows to 1 / (R - rho)^2.
// Degenerate: large where v.h may vanish, at the root's singularity.
real far_error_of_grazing_nodes(int nodes, real reach, real distance, real view_distance, real least_square) {
    real room = min(distance, view_distance);
    real best = 1.0e6;
    for (int k = 1; k < 4; k++) {
        real rho = 0.2 * real(k) * room;
        real x = rho / (distance - rho);
        real y = rho / (view_distance - rho);
        real left = least_square - 0.5 * (x + y + x * y);
        real grazing = far_grazing(sqrt(max(left, 0.0))).x;
        real step = reach / (2.0 * rho);
        real growth = 1.0 + x;
        real power = 2.0 * growth * growth * grazing;
        for (int i = 0; i < nodes; i++) {
            power = power * step;
        }
        best = select(left > 0.0, min(best, power), best);
    }
    return best;
}
