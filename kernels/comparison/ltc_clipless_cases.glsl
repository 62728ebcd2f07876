// Parity cases of ltc_clipless.glsl; tests/parity/case.glsl says how to write one.
// Needs: polygon_cases.glsl
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.

// LTC without clipping, quad
//   a.xyz  vector(1, 5)
//   b.xyz  vector(0.1, 2)
//   c.xyz  vector(0.1, 2)
//   d.x    range(0.2, 1.5)
//   d.y    range(-1, 1)
//   d.z    range(-1, 1)
//   d.w    range(1.2, 3)
vec4 case_ltc_clipless(CaseInput i) {
    LtcMatrix m = ltc_from_classic(i.d);
    vec3 sum = vec3(0.0, 0.0, 0.0);
    for (int k = 0; k < 4; k++) {
        sum = ltc_clipless_add_edge(sum, ltc_direction(m, case_vertex(i, k)), ltc_direction(m, case_vertex(i, k + 1)));
    }
    return case_of_real(ltc_clipless_integral(sum, case_walk_reversed(i)));
}
