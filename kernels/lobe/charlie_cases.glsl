// Parity cases of charlie.glsl; tests/parity/case.glsl says how to write one.
// Needs: polygon.glsl
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.

// Charlie lobe
//   a.xyz  upper_direction
//   b.xyz  upper_direction
//   a.w    range(0.04, 1)
vec4 case_charlie_lobe(CaseInput i) {
    vec3 v = polygon_direction(vec3(i.b.x, i.b.y, i.b.z + 0.1));
    return case_of_real(charlie_lobe(charlie_prepare(v, i.a.w), case_xyz(i.a)));
}
