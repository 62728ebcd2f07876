// The edge of a light as the GGX lobe sees it: a curve whose distance from the origin is a quartic.
//
// A light edge is an arc l(angle). The half vector, stretched by the surface's widths, runs along a conic:
//   U(tau) = S (l + v) (1 + tau^2) = u0 + u1 tau + u2 tau^2,  tau = tan(angle/2),  S = diag(1/ax, 1/ay, 1).
// Everything the lobe's integral needs of the edge is in |U|^2, a positive quartic: its two pairs of poles say where
// the edge passes the lobe and how closely. docs/ggx.md has the derivation.
// Frame: z the surface normal, x and y the directions of the widths. Walk order, as polygon.glsl has it.
// Needs: inverse_trig.glsl complex.glsl quartic.glsl
// Topics: ggx
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.

// What the lobe's integrals need of the view and the surface.
//   v        unit view, z > 0
//   w        (ax v_x, ay v_y, v_z): w.u is v.h in stretched space
//   ax, ay   widths: roughness squared, at least 1.0e-4
//   masking  the view's |v|' / v_z of Smith's shadowing, at least 1
struct GgxView {
    vec3 v;
    vec3 w;
    real ax;
    real ay;
    real masking;
};

// A prepared edge. In units in which the poles' distances from 0 have the product 1.
//   u0..u2      the conic
//   begin, end  its ends in tau; equal where the edge has no length
//   z1, z2      poles: roots of |U|^2 with positive imaginary part
//   sweep       the angles under which the poles see the edge [rad], in [0, pi]
struct GgxEdge {
    vec3 u0;
    vec3 u1;
    vec3 u2;
    real begin;
    real end;
    vec2 z1;
    vec2 z2;
    vec2 sweep;
};

// Prepares a view.
//
// Degenerate: a view at or below the surface counts as v_z = 1.0e-6; callers give 0 for it.
GgxView ggx_view(vec3 v, real ax, real ay) {
    GgxView view;
    real z = max(v.z, 1.0e-6);
    view.v = vec3(v.x, v.y, z);
    view.w = vec3(ax * v.x, ay * v.y, z);
    view.ax = ax;
    view.ay = ay;
    view.masking = sqrt(dot(view.w, view.w)) / z;
    return view;
}

// d4 (z - conj z)(z - o)(z - conj o): the derivative of the quartic at its root z, from the roots. From the coefficients
// it would cost float 5 to 40 times the error.
//
//   z, o     a root and the root of the other pair
vec2 ggx_quartic_slope(vec2 z, vec2 o, real d4) {
    real x = z.x - o.x;
    real y2 = (z.y - o.y) * (z.y + o.y);
    real s = 2.0 * d4 * z.y;
    return vec2(-2.0 * x * z.y, x * x - y2) * s;
}

// One step of Durand and Kerner for the root z of U.U, evaluated from the vectors: the quartic's coefficients have lost
// the digits that small imaginary parts need.
//
//   returns  the new root, with positive imaginary part
//
// The step is at most half the way to the other root plus the height above the axis, so that no start runs away.
vec2 ggx_pole_step(GgxEdge edge, vec2 z, vec2 o, real d4) {
    vec3 re = edge.u0 + edge.u1 * z.x + edge.u2 * (z.x * z.x - z.y * z.y);
    vec3 im = (edge.u1 + edge.u2 * (2.0 * z.x)) * z.y;
    vec2 value = vec2(dot(re - im, re + im), 2.0 * dot(re, im));
    vec2 step = complex_quotient(value, ggx_quartic_slope(z, o, d4));
    vec2 apart = z - o;
    real apart2 = dot(apart, apart);
    real longest = 0.5 * sqrt(apart2) + z.y;
    step = step * min(longest * inversesqrt(max(dot(step, step), 1.0e-30)), 1.0);
    mask free = apart2 > 1.0e-12 * (1.0 + dot(z, z));
    vec2 next = z - select(free, step, vec2(0.0, 0.0));
    return vec2(next.x, max(abs(next.y), 1.0e-9));
}

// Gauss and Seidel's sweeps over the two poles until both stand still.
//
// Number of sweeps: 2 or 3 at ordinary widths and views; a pole much nearer to the axis than its start comes down by half a
// sweep, which makes up to 16 at alpha = 1.0e-4 and grazing views.
// Error: in float, poles to 1.0e-3 of their height at least, and since steps square, mostly to rounding.
QuarticPoles ggx_polish_poles(GgxEdge edge, QuarticPoles start) {
    QuarticPoles poles = start;
    real d4 = dot(edge.u2, edge.u2);
    int sweeps = 16;
    real tolerance = 1.0e-6;
    if (real_digits() > 24) {
        sweeps = 24;
        tolerance = 1.0e-16;
    }
    mask moving = edge.end > edge.begin;
    for (int i = 0; i < sweeps; i++) {
        if (any_lane(moving)) {
            vec2 z1 = ggx_pole_step(edge, poles.z1, poles.z2, d4);
            vec2 z2 = ggx_pole_step(edge, poles.z2, z1, d4);
            vec2 step1 = z1 - poles.z1;
            vec2 step2 = z2 - poles.z2;
            poles.z1 = select(moving, z1, poles.z1);
            poles.z2 = select(moving, z2, poles.z2);
            moving = moving && (dot(step1, step1) > tolerance * z1.y * z1.y || dot(step2, step2) > tolerance * z2.y * z2.y);
        }
    }
    return poles;
}

// The angle under which a pole sees the edge [rad], in [0, pi].
real ggx_sweep(vec2 z, real begin, real end) {
    return trig_atan2_unwrapped(z.y * (end - begin), z.y * z.y + (begin - z.x) * (end - z.x));
}

// The conic of an edge, before it has poles.
//
//   a, b     unit directions of the ends, in walk order, not below the horizon
//
// tau counts from the edge's middle; where the middle is near the view, and u2 = S (v - l) would vanish, from the end that
// is further from it.
// Degenerate: a = b, and a = -b, which spans no plane, give an edge of no length. If even the end is the view, u2 is
// replaced by a little of u0, which does not change the curve's direction there.
GgxEdge ggx_conic(GgxView view, vec3 a, vec3 b) {
    vec3 chord = b - a;
    vec3 sum = a + b;
    real chord2 = dot(chord, chord);
    real sum2 = dot(sum, sum);
    mask usable = chord2 > 1.0e-30 && sum2 > 1.0e-12;
    vec3 middle = sum * inversesqrt(max(sum2, 1.0e-30));
    vec3 along = chord * inversesqrt(max(chord2, 1.0e-36));
    real half_sine = 0.5 * sqrt(chord2);
    real half_cosine = max(0.5 * sqrt(sum2), 1.0e-6);

    mask from_end = dot(middle, view.v) > 0.9;
    real side = select(from_end, select(dot(chord, view.v) > 0.0, -1.0, 1.0), 0.0);
    real turn_cosine = select(from_end, half_cosine, 1.0);
    vec3 base = middle * turn_cosine + along * (side * half_sine);
    vec3 q = along * turn_cosine - middle * (side * half_sine);
    real reach = select(usable, half_sine / (half_cosine + select(from_end, 0.0, 1.0)), 0.0);

    real x = 1.0 / view.ax;
    real y = 1.0 / view.ay;
    vec3 near = view.v + base;
    vec3 far = view.v - base;
    GgxEdge edge;
    edge.u0 = vec3(near.x * x, near.y * y, near.z);
    edge.u1 = vec3(q.x * x, q.y * y, q.z) * 2.0;
    edge.u2 = vec3(far.x * x, far.y * y, far.z);
    edge.begin = select(side < 0.0, 0.0, -reach);
    edge.end = select(side > 0.0, 0.0, reach);

    // Scale tau so that |u0| = |u2|.
    real least = 1.0e-12;
    if (real_digits() > 24) {
        least = 1.0e-24;
    }
    real d0 = max(dot(edge.u0, edge.u0), 1.0e-30);
    real d4 = dot(edge.u2, edge.u2);
    edge.u2 = select(d4 > least * d0, edge.u2, edge.u0 * sqrt(least));
    real ratio = sqrt(d0 / max(d4, least * d0));
    real scale = sqrt(ratio);
    edge.u1 = edge.u1 * scale;
    edge.u2 = edge.u2 * ratio;
    edge.begin = edge.begin / scale;
    edge.end = edge.end / scale;
    return edge;
}

// Prepares an edge: its conic, poles and their angles.
//
//   a, b     unit directions of the ends, in walk order, not below the horizon
//
// Degenerate: see ggx_conic.
GgxEdge ggx_edge(GgxView view, vec3 a, vec3 b) {
    GgxEdge edge = ggx_conic(view, a, b);
    real d4 = dot(edge.u2, edge.u2);
    real scale = 1.0 / max(d4, 1.0e-30);
    QuarticPoles poles = quartic_poles_approximate(
        dot(edge.u0, edge.u0) * scale, 2.0 * dot(edge.u0, edge.u1) * scale,
        (dot(edge.u1, edge.u1) + 2.0 * dot(edge.u0, edge.u2)) * scale, 2.0 * dot(edge.u1, edge.u2) * scale);
    poles = ggx_polish_poles(edge, poles);
    edge.z1 = poles.z1;
    edge.z2 = poles.z2;
    edge.sweep = vec2(ggx_sweep(edge.z1, edge.begin, edge.end), ggx_sweep(edge.z2, edge.begin, edge.end));
    return edge;
}
