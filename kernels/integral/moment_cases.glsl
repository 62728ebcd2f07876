// Parity cases of moment.glsl; tests/parity/case.glsl says how to write one.
// Needs: polygon.glsl
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.

// Edge in front of the axis z, whose foot is between its ends and some way from the axis.
MomentEdge case_front_edge(CaseInput i) {
    vec3 a = polygon_direction(vec3(i.a.x, -i.a.y, 1.0));
    vec3 b = polygon_direction(vec3(i.a.x, i.a.z, 1.0));
    return moment_edge(a, b, vec3(0.0, 0.0, 1.0));
}
