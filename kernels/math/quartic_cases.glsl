// Parity cases of quartic.glsl; tests/parity/case.glsl says how to write one.
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.

// cosine of a third of an angle
//   a.x    range(-0.99, 1)
vec4 case_quartic_third_cosine(CaseInput i) { return case_of_real(quartic_third_cosine(i.a.x)); }

// quartic poles' start, pairs apart
//   a.x    range(-1, -0.3)
//   a.y    range(0.3, 1)
//   b.x    range(0.3, 1)
//   b.y    range(0.3, 1)
// Values: 4
vec4 case_quartic_poles(CaseInput i) {
    real s1 = i.a.x * i.a.x + i.a.y * i.a.y;
    real s2 = i.b.x * i.b.x + i.b.y * i.b.y;
    QuarticPoles poles = quartic_poles_approximate(s1 * s2, -2.0 * (i.a.x * s2 + i.b.x * s1),
        s1 + s2 + 4.0 * i.a.x * i.b.x, -2.0 * (i.a.x + i.b.x));
    return vec4(poles.z1.x, poles.z1.y, poles.z2.x, poles.z2.y);
}
