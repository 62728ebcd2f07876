// Parity cases of charlie_cubature.glsl; tests/parity/case.glsl says how to write one.
// Needs: polygon.glsl
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.

// Charlie cubature, triangle above the horizon
//   a.x    range(-1, -0.2)
//   a.y    range(0.3, 1)
//   b.x    range(0.2, 1)
//   b.y    range(0.3, 1)
//   c.x    range(-0.9, 0.9)
//   c.y    range(-1.5, -0.1)
//   d.xyz  upper_direction
//   a.w    range(0.04, 1)
vec4 case_charlie_cubature(CaseInput i) {
    vec3 v0 = polygon_direction(vec3(i.a.x, i.a.y, 0.5));
    vec3 v1 = polygon_direction(vec3(i.b.x, i.b.y, 0.5));
    vec3 v2 = polygon_direction(vec3(i.c.x, i.c.y, 0.5));
    vec3 e = polygon_edge(v0, v1) + polygon_edge(v1, v2) + polygon_edge(v2, v0);
    vec3 v = polygon_direction(vec3(i.d.x, i.d.y, i.d.z + 0.1));
    CharlieCubature c = charlie_cubature_begin(charlie_prepare(v, i.a.w), e, select(e.z < 0.0, -1.0, 1.0));
    c = charlie_cubature_edge(c, v0, v1);
    c = charlie_cubature_edge(c, v1, v2);
    c = charlie_cubature_edge(c, v2, v0);
    return case_of_real(charlie_cubature_finish(c));
}
