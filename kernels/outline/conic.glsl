// Arcs of conics in space: the boundary integral of irradiance along them, in closed form.
//
// A curve u(tau) = u0 + u1 tau + u2 tau^2, seen from the origin, bounds a region of directions; its share of the region's
// irradiance vector is  1/2 INT u x u' / |u|^2 dtau,  a quadratic over a quartic. The quartic |u|^2 is positive: its
// two conjugate pairs of roots, the poles, say where the curve passes the origin and how closely, and the integral is a
// sum of residues times logarithms. Straight edges, circles and ellipses are such curves, and so is the half vector of
// a light's edge stretched by a GGX surface (ggx_closed_form.glsl). docs/theory/ggx.md has the derivation.
// Needs: constants.glsl inverse_trig.glsl complex.glsl quartic.glsl gauss_legendre.glsl
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.

// A prepared arc, in units of tau in which the poles' distances from 0 have the product 1.
//   u0..u2      the curve
//   begin, end  its ends in tau; equal where the arc has no length
//   scale       the unit: tau as the caller counted it is scale times tau here
//   z1, z2      poles: roots of |u|^2 with positive imaginary part
//   sweep       the angles under which the poles see the arc [rad], in [0, pi]
struct ConicArc {
    vec3 u0;
    vec3 u1;
    vec3 u2;
    real begin;
    real end;
    real scale;
    vec2 z1;
    vec2 z2;
    vec2 sweep;
};

// The derivative of the quartic at its root z, formed from the roots: d4 (z - conj z)(z - o)(z - conj o). Formed from the
// coefficients it would cost float 5 to 40 times the error.
//
//   z, o     a root and the root of the other pair
vec2 conic_slope(vec2 z, vec2 o, real d4) {
    real x = z.x - o.x;
    real y2 = (z.y - o.y) * (z.y + o.y);
    real s = 2.0 * d4 * z.y;
    return vec2(-2.0 * x * z.y, x * x - y2) * s;
}

// One step of Durand and Kerner for the root z of u.u, evaluated from the vectors: the quartic's coefficients have lost
// the digits that small imaginary parts need.
//
//   returns  the new root, with positive imaginary part
//
// The step is at most half the way to the other root plus the height above the axis, so that no start runs away.
vec2 conic_pole_step(ConicArc arc, vec2 z, vec2 o, real d4) {
    vec3 re = arc.u0 + arc.u1 * z.x + arc.u2 * (z.x * z.x - z.y * z.y);
    vec3 im = (arc.u1 + arc.u2 * (2.0 * z.x)) * z.y;
    vec2 value = vec2(dot(re - im, re + im), 2.0 * dot(re, im));
    vec2 step = complex_quotient(value, conic_slope(z, o, d4));
    vec2 apart = z - o;
    real apart2 = dot(apart, apart);
    real longest = 0.5 * sqrt(apart2) + z.y;
    step = step * min(longest * inversesqrt(max(dot(step, step), smallest_divisor())), 1.0);
    mask free = apart2 > 1.0e-12 * (1.0 + dot(z, z));
    vec2 next = z - select(free, step, vec2(0.0, 0.0));
    return vec2(next.x, max(abs(next.y), 1.0e-9));
}

// Gauss and Seidel's sweeps over the two poles until both stand still.
//
// Number of sweeps: 2 or 3 at ordinary widths and views; a pole much nearer to the axis than its start comes down by half a
// sweep, which makes up to 16 at alpha = 1.0e-4 and grazing views.
// Error: in float, poles to 1.0e-3 of their height at least, and since steps square, mostly to rounding.
QuarticPoles conic_polish_poles(ConicArc arc, QuarticPoles start) {
    QuarticPoles poles = start;
    real d4 = dot(arc.u2, arc.u2);
    int sweeps = 16;
    real tolerance = 1.0e-6;
    if (real_digits() > 24) {
        sweeps = 24;
        tolerance = 1.0e-16;
    }
    mask moving = arc.end > arc.begin;
    for (int i = 0; i < sweeps; i++) {
        mask moves = mask_none();
        // One pole, then the other: each turn swaps them.
        for (int k = 0; k < 2; k++) {
            vec2 z = conic_pole_step(arc, poles.z1, poles.z2, d4);
            vec2 step = z - poles.z1;
            moves = moves || dot(step, step) > tolerance * z.y * z.y;
            z = select(moving, z, poles.z1);
            poles.z1 = poles.z2;
            poles.z2 = z;
        }
        moving = moving && moves;
        // At the end: devices that mask lanes instead of jumping would go through a sweep for nobody.
        if (!any_lane(moving)) {
            break;
        }
    }
    return poles;
}

// The angle under which a pole sees the arc [rad], in [0, pi].
real conic_sweep(vec2 z, real begin, real end) {
    return trig_atan2_unwrapped(z.y * (end - begin), z.y * z.y + (begin - z.x) * (end - z.x));
}

// An arc in its unit, whose poles are still to be found: all of conic_prepare that costs little.
//
//   u0..u2      the curve; the origin must not lie on it
//   begin, end  ends in tau, begin <= end
//
// Degenerate: |u2| below 1.0e-6 |u0| (1.0e-12 in double) is replaced by a little of u0, which leaves the curve's direction at
// tau = 0 as it is.
ConicArc conic_scaled(vec3 u0, vec3 u1, vec3 u2, real begin, real end) {
    real least = 1.0e-12;
    if (real_digits() > 24) {
        least = 1.0e-24;
    }
    real d0 = max(dot(u0, u0), smallest_divisor());
    real d4 = dot(u2, u2);
    real ratio = sqrt(d0 / max(d4, least * d0));
    ConicArc arc;
    arc.scale = sqrt(ratio);
    arc.u0 = u0;
    arc.u1 = u1 * arc.scale;
    arc.u2 = select(d4 > least * d0, u2, u0 * sqrt(least)) * ratio;
    arc.begin = begin / arc.scale;
    arc.end = end / arc.scale;
    arc.z1 = vec2(0.0, 1.0);
    arc.z2 = vec2(0.0, 1.0);
    arc.sweep = vec2(0.0, 0.0);
    return arc;
}

// The poles of a scaled arc.
QuarticPoles conic_poles(ConicArc arc) {
    real inverse = 1.0 / max(dot(arc.u2, arc.u2), smallest_divisor());
    QuarticPoles poles = quartic_poles_approximate(
        dot(arc.u0, arc.u0) * inverse, 2.0 * dot(arc.u0, arc.u1) * inverse,
        (dot(arc.u1, arc.u1) + 2.0 * dot(arc.u0, arc.u2)) * inverse, 2.0 * dot(arc.u1, arc.u2) * inverse);
    return conic_polish_poles(arc, poles);
}

// A scaled arc and its poles, found now or kept from before: conic_prepare is conic_with_poles(arc, conic_poles(arc)).
ConicArc conic_with_poles(ConicArc scaled, QuarticPoles poles) {
    ConicArc arc = scaled;
    arc.z1 = poles.z1;
    arc.z2 = poles.z2;
    arc.sweep = vec2(conic_sweep(arc.z1, arc.begin, arc.end), conic_sweep(arc.z2, arc.begin, arc.end));
    return arc;
}

// Prepares an arc. Arguments and degenerate case: conic_scaled.
ConicArc conic_prepare(vec3 u0, vec3 u1, vec3 u2, real begin, real end) {
    ConicArc arc = conic_scaled(u0, u1, u2, begin, end);
    return conic_with_poles(arc, conic_poles(arc));
}

// A place on an arc by its share of the angle C under which both poles together see it: in C the integrand is smooth
// wherever the arc passes.
//   tau      between the arc's begin and end
//   density  dC/dtau
struct ConicNode {
    real tau;
    real density;
};

// The place where C is a given share of its way from the arc's begin to its end.
//
//   share    in [0, 1]
//
// C(tau) is the argument of (b1 + i (tau - p1))(b2 + i (tau - p2)) with poles p + i b, so that tau is the root of a quadratic.
ConicNode conic_node(ConicArc arc, real share) {
    real p1 = arc.z1.x;
    real p2 = arc.z2.x;
    real b1 = arc.z1.y;
    real b2 = arc.z2.y;
    vec2 start = complex_product(vec2(b1, arc.begin - p1), vec2(b2, arc.begin - p2));
    real total = arc.sweep.x + arc.sweep.y;
    // The angle is in [0, 2 pi]: half a turn less, and the sign.
    vec2 turned = complex_product(complex_sign(start), -complex_unit(share * total - pi()));
    real s = turned.y;
    real c = turned.x;
    real linear_term = c * (b1 + b2) - s * (p1 + p2);
    real constant_term = s * p1 * p2 - c * (b1 * p2 + b2 * p1) - s * b1 * b2;
    real root = sqrt(max(linear_term * linear_term - 4.0 * s * constant_term, 0.0));
    mask positive = linear_term >= 0.0;
    real top = select(positive, -2.0 * constant_term, root - linear_term);
    real bottom = select(positive, linear_term + root, 2.0 * s);
    mask usable = abs(bottom) > smallest_divisor();
    real tau = select(usable, top / select(usable, bottom, 1.0), arc.begin);
    ConicNode node;
    node.tau = clamp(tau, arc.begin, arc.end);
    real x1 = node.tau - p1;
    real x2 = node.tau - p2;
    node.density = b1 / (x1 * x1 + b1 * b1) + b2 / (x2 * x2 + b2 * b2);
    return node;
}

// Half of INT u x u' / |u|^2 dtau as residues.
//
//   z, o     a pole and the other one
//   sweep    the angle under which z sees the arc
vec3 conic_residue(ConicArc arc, vec2 z, vec2 o, real sweep) {
    vec3 n0 = cross(arc.u0, arc.u1);
    vec3 n1 = cross(arc.u0, arc.u2) * 2.0;
    vec3 n2 = cross(arc.u1, arc.u2);
    vec3 re = n0 + n1 * z.x + n2 * (z.x * z.x - z.y * z.y);
    vec3 im = (n1 + n2 * (2.0 * z.x)) * z.y;
    real x0 = arc.begin - z.x;
    real x1 = arc.end - z.x;
    real y2 = z.y * z.y;
    vec2 logarithm = vec2(0.5 * log((x1 * x1 + y2) / (x0 * x0 + y2)), sweep);
    vec2 factor = complex_quotient(logarithm, conic_slope(z, o, dot(arc.u2, arc.u2)));
    return re * factor.x - im * factor.y;
}

// The same integral as conic_residue sums, by Gauss and Legendre in the angle C, for poles that nearly coincide, where residues
// cancel. 8 nodes, twice.
//
//   wanted   where the value counts; others may be left at 0
vec3 conic_vector_approximate(ConicArc arc, mask wanted) {
    vec3 sum = vec3(0.0, 0.0, 0.0);
    real total = arc.sweep.x + arc.sweep.y;
    for (int i = 0; i < 16; i++) {
        if (!any_lane(wanted)) {
            break;
        }
        int part = i / 8;
        vec2 rule = gauss_legendre_node(8, i - 8 * part);
        ConicNode node = conic_node(arc, 0.5 * (rule.x + real(part)));
        vec3 u = arc.u0 + (arc.u1 + arc.u2 * node.tau) * node.tau;
        vec3 du = arc.u1 + arc.u2 * (2.0 * node.tau);
        sum = sum + cross(u, du) * (0.25 * rule.y * total / (node.density * max(dot(u, u), smallest_divisor())));
    }
    return sum;
}

// An arc's share of the irradiance vector: 1/2 INT u x u' / |u|^2 dtau [rad].
//
// Error: docs/measured/accuracy.md, "Float against double", conic vector.
vec3 conic_vector(ConicArc arc) {
    vec3 e = conic_residue(arc, arc.z1, arc.z2, arc.sweep.x) + conic_residue(arc, arc.z2, arc.z1, arc.sweep.y);
    // Poles nearer to each other than this share of their heights, squared: residues lose the inverse of the share, and the
    // quadrature, whose nearest singularity recedes as poles meet, is good to the digits that remain.
    real close = 1.0e-2;
    if (real_digits() > 24) {
        close = 1.0e-6;
    }
    vec2 apart = arc.z1 - arc.z2;
    mask meet = dot(apart, apart) < close * arc.z1.y * arc.z2.y && arc.end > arc.begin;
    if (any_lane(meet)) {
        e = select(meet, conic_vector_approximate(arc, meet), e);
    }
    return e;
}
