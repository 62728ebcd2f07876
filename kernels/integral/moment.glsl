// Axial moments of spherical polygons: the integral of max(u.r, 0)^n over a light, for the Phong lobe about r.
//
// With m = n + 1, theta the angle from r and psi the azimuth about r,
//     m * moment = closed integral over the outline of (1 - max(cos theta, 0)^m) dpsi
// for any real n > -1, as long as -r is not inside (docs/theory/moments.md derives it). No parity of n, no solid angle, no
// vertices on the lobe's equator. On an edge, phi is the angle along its great circle from the foot, the point
// nearest to r, where u.r = c; s = sin of the angle from r to the circle's plane; x = u.r = c cos phi and
// y = c sin phi. The edge's share is
//     sign(s) * ( |s| * integral of (1 - x^m)/(1 - x^2) dphi  over the part in front of the lobe's equator
//                 + the azimuth that the part behind sweeps ).
// moment_edge finds what every method shares; the methods, a file each, integrate the part in front.
//
// Frame: any; r is the unit axis. Edges in walk order (kernels/outline/polygon.glsl), clipped to the surface's horizon
// (kernels/outline/horizon_clip.glsl) before, so that -r cannot be inside a light.
// Source: Arvo, "Applications of irradiance tensors to the simulation of non-Lambertian phenomena", 1995; Lecocq,
// Dufay, Sourimant, Marvie, "Analytic approximations for real-time area light shading", 2017. The form without
// parity is this project's own.
// Needs: constants.glsl inverse_trig.glsl
// Topics: moment
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.

// One edge, seen from the lobe's axis.
//   side            sign of s, +1 or -1; 0 for an edge without length
//   s, c            |s| and the cosine that belongs to it
//   x0, y0, x1, y1  the ends of the part in front, (c cos phi, c sin phi); equal where there is none
//   log_c           -log(c^2), accurate for c near 1
//   swept           azimuth that the part behind sweeps, positive [rad]
struct MomentEdge {
    real side;
    real s;
    real c;
    real x0;
    real y0;
    real x1;
    real y1;
    real log_c;
    real swept;
};

// log(1 + z) for z >= 0. Error: relative 3e-7 in float, 1e-13 in double.
real moment_log_1_plus(real z) {
    real near = 0.25;
    if (real_digits() > 24) {
        near = 0.01;
    }
    // Twice the inverse hyperbolic tangent of t; the next term is t^10 / 11.
    real t = z / (2.0 + z);
    real t2 = t * t;
    real series = 2.0 * t * (1.0 + t2 * (0.333333333333333333 + t2 * (0.2 + t2 * (0.142857142857142857 + t2 * 0.111111111111111111))));
    return select(z < near, series, log(1.0 + z));
}

// 1 - exp(-x) for x >= 0. Error: relative 3e-7 in float, 1e-13 in double.
real moment_1_minus_exp(real x) {
    real near = 0.25;
    if (real_digits() > 24) {
        near = 0.001;
    }
    real result = 1.0 - exp(-x);
    mask small = x < near;
    if (any_lane(small)) {
        // Taylor, nested; the next term is x^6 / 5040.
        real series = x * (1.0 - 0.5 * x * (1.0 - 0.333333333333333333 * x * (1.0 - 0.25 * x * (1.0 - 0.2 * x * (1.0 - 0.166666666666666667 * x)))));
        result = select(small, series, result);
    }
    return result;
}

// Angle in [0, pi] from the direction (w x0, y0) to (w x1, y1): the definite integral of atan(tan(phi) / w).
real moment_angle(real w, real x0, real y0, real x1, real y1) {
    return trig_atan2_unwrapped(w * (x0 * y1 - x1 * y0), w * w * x0 * x1 + y0 * y1);
}

// -log(1 - s2), from s2 where it is small and from c2 = 1 - s2 where that is. Error: relative 3e-6 in float, 1e-13.
real moment_minus_log_cosine2(real s2, real c2) {
    real near = 0.05;
    if (real_digits() > 24) {
        near = 0.001;
    }
    real result = -log(c2);
    mask small = s2 < near;
    if (any_lane(small)) {
        // Taylor; the next term is s2^7 / 7.
        real series = s2 * (1.0 + s2 * (0.5 + s2 * (0.333333333333333333 + s2 * (0.25 + s2 * (0.2 + s2 * 0.166666666666666667)))));
        result = select(small, series, result);
    }
    return result;
}

// Prepares one edge.
//
//   a, b     unit directions of the edge's ends, in walk order
//   r        unit axis of the lobe
//
// Degenerate: a = b, a = -b or a zero vector gives an edge that adds nothing. An axis within 1e-3 of the normal of
// the edge's plane sees the whole edge near its equator, where the integrand is 1: all of it counts as swept.
MomentEdge moment_edge(vec3 a, vec3 b, vec3 r) {
    real pole2 = 1.0e-6;
    if (real_digits() > 24) {
        pole2 = 1.0e-14;
    }
    vec3 n = cross(a, b - a);  // of a short edge, too, with all its digits
    real n2 = dot(n, n);
    mask has_length = n2 > smallest_divisor();
    n = n * inversesqrt(max(n2, smallest_divisor()));
    real s = dot(n, r);
    vec3 q = cross(n, r);
    // The share vanishes with s, like s sqrt(n/2) in the highlight: a floor of 1e-10 would show there.
    real s2 = clamp(s * s, smallest_divisor(), 1.0);
    real c2 = clamp(dot(q, q), pole2, 1.0);

    MomentEdge edge;
    edge.side = select(has_length, select(s < 0.0, -1.0, 1.0), 0.0);
    edge.s = s2 * inversesqrt(s2);
    edge.c = c2 * inversesqrt(c2);
    edge.log_c = moment_minus_log_cosine2(s2, c2);
    real x0 = dot(a, r);
    real y0 = dot(a, q);
    real x1 = dot(b, r);
    real y1 = dot(b, q);
    edge.x0 = x0;
    edge.y0 = y0;
    edge.x1 = x1;
    edge.y1 = y1;
    edge.swept = 0.0;
    mask behind0 = x0 <= 0.0;
    mask behind1 = x1 <= 0.0;
    mask pole = x0 * x0 + y0 * y0 < pole2;
    if (any_lane(behind0 || behind1 || pole)) {
        // The lobe's equator cuts the circle at phi = -pi/2 and pi/2.
        mask none = (behind0 && behind1) || pole;
        edge.x0 = select(behind0 || none, 0.0, x0);
        edge.y0 = select(none, edge.c, select(behind0, -edge.c, y0));
        edge.x1 = select(behind1 || none, 0.0, x1);
        edge.y1 = select(behind1 || none, edge.c, y1);
        real whole = moment_angle(edge.s, x0, y0, x1, y1);
        real in_front = moment_angle(edge.s, edge.x0, edge.y0, edge.x1, edge.y1);
        real swept = select(none, whole, max(whole - in_front, 0.0));
        if (any_lane(pole)) {
            real arc = trig_atan2(sqrt(n2), dot(a, b));
            swept = select(pole, arc, swept);
        }
        edge.swept = select(behind0 || behind1 || pole, swept, 0.0);
    }
    return edge;
}

// The edge's share of m times the moment.
//
//   front    |s| times the integral of (1 - x^m)/(1 - x^2) over the part in front, by any method
real moment_edge_share(MomentEdge edge, real front) {
    return edge.side * (front + edge.swept);
}

// Radiance of an energy-normalised Phong lobe of albedo 1 under radiance 1, in [0, 1].
//
//   sum      of the edges' shares
//   reversed true where the light is seen from behind, so that the walk ran the wrong way round
//
// Source: Lecocq et al. 2017, eq. 10: (n + 1)/(2 pi) times the moment; without foreshortening.
real moment_phong_radiance(real sum, mask reversed) {
    return clamp(select(reversed, -sum, sum) * inverse_two_pi(), 0.0, 1.0);
}
