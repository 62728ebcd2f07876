// Parity cases of ltc.glsl; tests/parity/case.glsl says how to write one.
// Needs: polygon_cases.glsl
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.

// LTC coordinates and factors
//   a.x    range(0, 1)
//   a.y    range(0, 1)
//   a.z    range(0, 1)
//   a.w    range(0, 1)
// Values: 4
vec4 case_ltc_factors(CaseInput i) {
    vec2 place = ltc_coordinates(i.a.x, i.a.y);
    real coat = ltc_clear_coat(ltc_specular_scale(0.04, 1.0, i.a.x, i.a.y), i.a.z, i.a.w, i.a.x);
    real sheen = ltc_sheen(i.a.x, i.a.y, i.a.z, i.a.w);
    return vec4(place.x + place.y, ltc_multiple_scattering(i.a.z, 0.1 + 0.9 * i.a.w), coat, sheen);
}

// LTC lobe of the classic table
//   a.xyz  direction
//   d.x    range(0.2, 1.5)
//   d.y    range(-1, 1)
//   d.z    range(-1, 1)
//   d.w    range(1.2, 3)
vec4 case_ltc_lobe(CaseInput i) {
    return case_of_real(ltc_lobe(ltc_from_classic(i.d), case_xyz(i.a)));
}

// Walk around the parallelogram for a linearly transformed cosine.
LtcWalk case_ltc_walk(CaseInput i, LtcMatrix m) {
    LtcWalk walk = ltc_begin();
    for (int k = 0; k < 4; k++) {
        vec3 a = case_vertex(i, k);
        vec3 b = case_vertex(i, k + 1);
        walk = ltc_add_edge(walk, m, a, b, ltc_direction(m, a), ltc_direction(m, b));
    }
    return walk;
}

// LTC of the classic table, quad across the horizon
//   a.xyz  vector(1, 5)
//   b.xyz  vector(0.1, 2)
//   c.xyz  vector(0.1, 2)
//   d.x    range(0.2, 1.5)
//   d.y    range(-1, 1)
//   d.z    range(-1, 1)
//   d.w    range(1.2, 3)
vec4 case_ltc_classic(CaseInput i) {
    LtcMatrix m = ltc_from_classic(i.d);
    real integral = ltc_integral(case_ltc_walk(i, m), case_walk_reversed(i));
    return case_of_real(ltc_specular_with_fresnel_lobe(0.04, 1.0, 0.9, integral, 0.1, integral) / ltc_energy_above_horizon(m));
}

// LTC of the compact table, quad across the horizon
//   a.xyz  vector(1, 5)
//   b.xyz  vector(0.1, 2)
//   c.xyz  vector(0.1, 2)
//   a.w    range(0.1, 1)
//   b.w    range(0.1, 1)
//   d.x    range(0.5, 1.5)
//   d.y    range(0.5, 1.5)
//   d.z    range(-0.5, 0.5)
//   d.w    range(-0.5, 0.5)
vec4 case_ltc_compact(CaseInput i) {
    vec3 view = vec3(sqrt(1.0 - i.b.w * i.b.w), 0.0, i.b.w);
    LtcMatrix m = ltc_from_compact(i.d, i.a.w, view);
    return case_of_real(ltc_integral(case_ltc_walk(i, m), case_walk_reversed(i)));
}

// LTC, how fast the lobe of the classic table changes
//   a.xyz  direction
//   d.x    range(0.2, 1.5)
//   d.y    range(-1, 1)
//   d.z    range(-1, 1)
//   d.w    range(1.2, 3)
vec4 case_ltc_sharpness(CaseInput i) {
    return case_of_real(ltc_sharpness(ltc_from_classic(i.d), case_xyz(i.a)));
}
