// Parity cases of slopes.glsl; tests/parity/case.glsl says how to write one.
// Error analysis finds no bound for the poles of GGX, whose iteration ends at different steps.
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.

// Derivatives by both ends as one vector.
vec3 case_slopes_sum(EdgeSlopes s) { return s.normal * (s.by_start + 2.0 * s.by_end); }

// polygon, edge slopes
//   a.xyz  direction
//   b.xyz  upper_direction
// Values: 3
vec4 case_polygon_edge_slopes(CaseInput i) {
    vec3 b = polygon_direction(case_xyz(i.b) + vec3(0.0, 0.0, 0.1));
    vec3 a = polygon_direction(case_xyz(i.a) + b * 1.1);
    return case_of_vec3(case_slopes_sum(polygon_edge_slopes(a, b)));
}

// LTC, edge slopes
//   a.xyz  upper_direction
//   b.xyz  upper_direction
//   c.x    log(0.1, 1)
//   c.y    range(-0.3, 0.3)
//   c.z    range(0.2, 1)
// Values: 3
vec4 case_ltc_edge_slopes(CaseInput i) {
    LtcMatrix m = ltc_from_compact(vec4(1.0, 0.9, i.c.y, 0.1), i.c.x, vec3(sqrt(1.0 - i.c.z * i.c.z), 0.0, i.c.z));
    vec3 b = polygon_direction(case_xyz(i.b) + vec3(0.0, 0.0, 0.1));
    vec3 a = polygon_direction(case_xyz(i.a) + b * 0.5);
    return case_of_vec3(ltc_edge_transform_back(m, a, case_slopes_sum(ltc_edge_slopes(m, a, b))));
}

// Phong, edge slopes
//   a.xyz  upper_direction
//   b.xyz  upper_direction
//   c.xyz  upper_direction
//   a.w    log(7, 1000)
// Values: 3
vec4 case_phong_edge_slopes(CaseInput i) {
    vec3 b = polygon_direction(case_xyz(i.b) + vec3(0.0, 0.0, 0.1));
    vec3 a = polygon_direction(case_xyz(i.c) + b * 0.5);
    EdgeSlopes s = phong_edge_slopes(a, b, case_xyz(i.a), i.a.w, 0);
    return case_of_vec3(case_slopes_sum(s) * (1.0 / (1.0 + i.a.w)));
}

// GGX, edge slopes
//   a.xyz  upper_direction
//   b.xyz  upper_direction
//   c.xyz  upper_direction
//   a.w    log(0.1, 1)
//   b.w    log(0.1, 1)
//   c.w    range(0, 1)
// Values: 3
// Bound: statistical
vec4 case_ggx_edge_slopes(CaseInput i) {
    GgxView view = ggx_view(polygon_direction(case_xyz(i.a) + vec3(0.0, 0.0, 0.2)), i.a.w, i.b.w);
    vec3 b = polygon_direction(case_xyz(i.b) + vec3(0.0, 0.0, 0.1));
    vec3 a = polygon_direction(case_xyz(i.c) + b * 0.5);
    EdgeSlopesOfBoth s = ggx_edge_slopes(view, a, b, i.c.w, 4, 1);
    return case_of_vec3(s.normal * (s.by_start.x + s.by_end.x + 2.0 * (s.by_start.y + s.by_end.y)));
}

// GGX, edge slopes by the view
//   a.xyz  upper_direction
//   b.xyz  upper_direction
//   c.xyz  upper_direction
//   a.w    log(0.1, 1)
//   b.w    log(0.1, 1)
//   c.w    range(0, 1)
// Values: 3
// Bound: statistical
vec4 case_ggx_edge_slopes_turn(CaseInput i) {
    GgxView view = ggx_view(polygon_direction(case_xyz(i.a) + vec3(0.0, 0.0, 0.2)), i.a.w, i.b.w);
    vec3 b = polygon_direction(case_xyz(i.b) + vec3(0.0, 0.0, 0.1));
    vec3 a = polygon_direction(case_xyz(i.c) + b * 0.5);
    EdgeSlopesOfBoth s = ggx_edge_slopes(view, a, b, i.c.w, 4, 1);
    return case_of_vec3(s.turn + s.turn_of_fresnel * 2.0);
}
