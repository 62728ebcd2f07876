// Parity cases of conic.glsl; tests/parity/case.glsl says how to write one.
// Needs: frame.glsl
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.

// A conic arc from its poles a.xy and b.xy, its bend c.x in (-1, 1), its frame d.xyz and its ends c.y, c.z: the curve
// is found from the poles, so that no iteration is in it. With poles p + i b and q + i c: u2 = 1, u1.u2 = -(p + q),
// u0.u2 = p q + t b c; the rest follows from the product of the factors of |u|^2.
ConicArc case_arc(CaseInput i) {
    real p = i.a.x;
    real b = i.a.y;
    real q = i.b.x;
    real c = i.b.y;
    real t = i.c.x;
    real s = sqrt((b - c) * (b - c) + 2.0 * (1.0 - t) * b * c);
    real g = (t * b * c * (p + q) - p * c * c - q * b * b) / s;
    real k = b * c * sqrt((1.0 - t * t) * (1.0 + (p - q) * (p - q) / (s * s)));
    mat3 frame = frame_from_normal(case_xyz(i.d));
    ConicArc arc;
    arc.u0 = transform(frame, vec3(p * q + t * b * c, g, k));
    arc.u1 = transform(frame, vec3(-p - q, s, 0.0));
    arc.u2 = transform(frame, vec3(1.0, 0.0, 0.0));
    arc.begin = i.c.y;
    arc.end = i.c.z;
    arc.scale = 1.0;
    arc.z1 = vec2(p, b);
    arc.z2 = vec2(q, c);
    arc.sweep = vec2(conic_sweep(arc.z1, arc.begin, arc.end), conic_sweep(arc.z2, arc.begin, arc.end));
    return arc;
}

// conic vector from known poles
//   a.x    range(-1, -0.2)
//   a.y    range(0.3, 1)
//   b.x    range(0.2, 1)
//   b.y    range(0.3, 1)
//   c.x    range(-0.9, 0.9)
//   c.y    range(-1.5, -0.1)
//   c.z    range(0.1, 1.5)
//   d.xyz  direction
// Values: 3
vec4 case_conic_vector(CaseInput i) { return case_of_vec3(conic_vector(case_arc(i))); }

// conic vector by quadrature
//   a.x    range(-1, -0.2)
//   a.y    range(0.3, 1)
//   b.x    range(0.2, 1)
//   b.y    range(0.3, 1)
//   c.x    range(-0.9, 0.9)
//   c.y    range(-1.5, -0.1)
//   c.z    range(0.1, 1.5)
//   d.xyz  direction
// Values: 3
vec4 case_conic_vector_approximate(CaseInput i) { return case_of_vec3(conic_vector_approximate(case_arc(i), mask_all())); }

// Running error analysis loses conic_polish_poles: the step goes to nothing, and with it all digits of the step's limit; nor can
// it see that a step forgets the error of the one before. The first case below stays at the start, with an arc without
// length; the others are bounded by the spread of evaluations with other roundings.

// conic, start of the poles and unit
//   a.x    range(-1, -0.2)
//   a.y    range(0.3, 1)
//   b.x    range(0.2, 1)
//   b.y    range(0.3, 1)
//   c.x    range(-0.9, 0.9)
//   c.y    range(-1.5, -0.1)
//   c.z    range(0.1, 1.5)
//   d.xyz  direction
// Values: 4
vec4 case_conic_prepare(CaseInput i) {
    ConicArc given = case_arc(i);
    ConicArc arc = conic_prepare(given.u0, given.u1, given.u2, 0.0, 0.0);
    return vec4(arc.z1.x + arc.z2.x, arc.z1.y + arc.scale, arc.z2.y, arc.sweep.x + arc.sweep.y);
}

// conic, an arc in its unit
//   a.x    range(-1, -0.2)
//   a.y    range(0.3, 1)
//   b.x    range(0.2, 1)
//   b.y    range(0.3, 1)
//   c.x    range(-0.9, 0.9)
//   c.y    range(-1.5, -0.1)
//   c.z    range(0.1, 1.5)
//   d.xyz  direction
// Values: 4
vec4 case_conic_scaled(CaseInput i) {
    ConicArc given = case_arc(i);
    ConicArc arc = conic_scaled(given.u0, given.u1, given.u2, given.begin, given.end);
    return vec4(arc.u1.x, arc.u2.y, arc.begin, arc.end);
}

// conic, start of the poles of a scaled arc
//   a.x    range(-1, -0.2)
//   a.y    range(0.3, 1)
//   b.x    range(0.2, 1)
//   b.y    range(0.3, 1)
//   c.x    range(-0.9, 0.9)
//   c.y    range(-1.5, -0.1)
//   c.z    range(0.1, 1.5)
//   d.xyz  direction
// Values: 4
vec4 case_conic_poles(CaseInput i) {
    ConicArc given = case_arc(i);
    QuarticPoles poles = conic_poles(conic_scaled(given.u0, given.u1, given.u2, 0.0, 0.0));
    return vec4(poles.z1.x + poles.z2.x, poles.z1.y, poles.z2.y, 0.0);
}

// conic, angles under which known poles see an arc
//   a.x    range(-1, -0.2)
//   a.y    range(0.3, 1)
//   b.x    range(0.2, 1)
//   b.y    range(0.3, 1)
//   c.x    range(-0.9, 0.9)
//   c.y    range(-1.5, -0.1)
//   c.z    range(0.1, 1.5)
//   d.xyz  direction
// Values: 2
vec4 case_conic_with_poles(CaseInput i) {
    QuarticPoles poles;
    poles.z1 = vec2(i.a.x, i.a.y);
    poles.z2 = vec2(i.b.x, i.b.y);
    ConicArc arc = conic_with_poles(case_arc(i), poles);
    return vec4(arc.sweep.x, arc.sweep.y, 0.0, 0.0);
}

// conic, poles polished
//   a.x    range(-1, -0.2)
//   a.y    range(0.3, 1)
//   b.x    range(0.2, 1)
//   b.y    range(0.3, 1)
//   c.x    range(-0.9, 0.9)
//   c.y    range(-1.5, -0.1)
//   c.z    range(0.1, 1.5)
//   d.xyz  direction
//   c.w    range(-0.0001, 0.0001)
//   d.w    range(-0.0001, 0.0001)
// Values: 4
// Bound: statistical
vec4 case_conic_polish_poles(CaseInput i) {
    ConicArc arc = case_arc(i);
    QuarticPoles start;
    start.z1 = vec2(i.a.x + i.c.w, i.a.y + i.d.w);
    start.z2 = vec2(i.b.x - i.d.w, i.b.y + i.c.w);
    QuarticPoles poles = conic_polish_poles(arc, start);
    return vec4(poles.z1.x, poles.z1.y, poles.z2.x, poles.z2.y);
}
