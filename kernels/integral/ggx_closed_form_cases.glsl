// Parity cases of ggx_closed_form.glsl; tests/parity/case.glsl says how to write one.
// Needs: half_vector.glsl
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.

// GGX, the image of an edge: half vectors on it
//   a.xyz  upper_direction
//   b.xyz  upper_direction
//   c.xyz  upper_direction
//   a.w    log(0.01, 1)
//   b.w    log(0.01, 1)
//   c.w    range(0, 1)
// Values: 3
vec4 case_ggx_edge(CaseInput i) {
    GgxView view = ggx_view(case_xyz(i.a), i.a.w, i.b.w);
    ConicArc edge = ggx_edge(view, case_xyz(i.b), case_xyz(i.c));
    return case_of_vec3(half_vector_at(view, edge, edge.begin + i.c.w * (edge.end - edge.begin)));
}

// GGX, the image of an edge without its poles: half vectors on it
//   a.xyz  upper_direction
//   b.xyz  upper_direction
//   c.xyz  upper_direction
//   a.w    log(0.01, 1)
//   b.w    log(0.01, 1)
//   c.w    range(0, 1)
// Values: 3
vec4 case_ggx_edge_scaled(CaseInput i) {
    GgxView view = ggx_view(case_xyz(i.a), i.a.w, i.b.w);
    ConicArc edge = ggx_edge_scaled(view, case_xyz(i.b), case_xyz(i.c));
    return case_of_vec3(half_vector_at(view, edge, edge.begin + i.c.w * (edge.end - edge.begin)));
}

// GGX, the lobe towards the view, and times (1 - v.h)^5
//   a.xyz  direction
//   b.xyz  upper_direction
//   c.x    log(0.1, 1)
//   c.y    log(0.1, 1)
//   c.z    range(0, 1)
// Values: 2
vec4 case_ggx_lobe_and_fresnel(CaseInput i) {
    vec3 v = polygon_direction(case_xyz(i.b) + vec3(0.0, 0.0, 0.2));
    vec2 r = ggx_lobe_and_fresnel(ggx_view(v, i.c.x, i.c.y), case_xyz(i.a), i.c.z);
    return vec4(r.x, r.y, 0.0, 0.0);
}
