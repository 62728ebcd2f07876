// Parity cases of plane.glsl; tests/parity/case.glsl says how to write one.
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.

// plane, edge of constant radiance under a range window: uniform, Lambert, and their first moments
//   a.x    range(-3, 3)
//   a.y    range(0, 0.09)
// Values: 4
vec4 case_plane_edge_constant(CaseInput i) {
    real f = trig_atan2(i.a.x, 1.0);
    return vec4(plane_edge_integral(0, 0, i.a.x, f, i.a.y), plane_edge_integral(0, 1, i.a.x, f, i.a.y),
                plane_edge_integral(1, 1, i.a.x, f, i.a.y), plane_edge_integral(1, 2, i.a.x, f, i.a.y));
}

// plane, edge of linear radiance under a range window, and its first moments
//   a.x    range(-3, 3)
//   a.y    range(0, 0.09)
// Values: 4
vec4 case_plane_edge_linear(CaseInput i) {
    real f = trig_atan2(i.a.x, 1.0);
    return vec4(plane_edge_integral(1, 0, i.a.x, f, i.a.y), plane_edge_integral(0, 2, i.a.x, f, i.a.y),
                plane_edge_integral(2, 1, i.a.x, f, i.a.y), plane_edge_integral(2, 2, i.a.x, f, i.a.y));
}

// plane, disk under a range window, from its centre's direction to a ray; squared distance and radius in units of the range
//   a.x    range(-0.9, 0.9)
//   b.x    range(0.02, 0.9)
//   b.y    range(0.01, 0.95)
vec4 case_plane_disk_window(CaseInput i) {
    real rho2 = i.b.x * i.b.y * i.b.y;
    real tangent = sqrt(rho2) * inversesqrt(i.b.x - rho2);
    return case_of_real(plane_disk_window(i.a.x * tangent, i.b.x, rho2));
}

// plane, antiderivative of the window over the same disk
//   a.x    range(-0.9, 0.9)
//   b.x    range(0.02, 0.9)
//   b.y    range(0.01, 0.95)
vec4 case_plane_disk_window_integral(CaseInput i) {
    real rho2 = i.b.x * i.b.y * i.b.y;
    real m = i.a.x * sqrt(rho2) * inversesqrt(i.b.x - rho2);
    real c = inversesqrt(1.0 + m * m);
    real d = sqrt(i.b.x);
    real x = d * m * c;
    real chord = sqrt(max(rho2 - x * x, 0.0));
    return case_of_real(plane_disk_window_integral(i.b.x, rho2, d, c, m * c, trig_atan2(m, 1.0), chord, trig_atan2(x, chord)));
}

// plane, the same disk from tangent to tangent
//   b.x    range(0.02, 0.9)
//   b.y    range(0.01, 0.95)
vec4 case_plane_disk_window_whole(CaseInput i) {
    real rho2 = i.b.x * i.b.y * i.b.y;
    return case_of_real(plane_disk_window_whole(sqrt(rho2) * inversesqrt(i.b.x - rho2), i.b.x, rho2));
}

// plane, slope of a point in front of a pixel or behind it
//   a.x    signed_log(0.001, 1000)
//   a.y    signed_log(0.001, 1000)
// Error: relative
vec4 case_plane_slope(CaseInput i) { return case_of_real(plane_slope(i.a.x, i.a.y, 1.0e9)); }

// plane, rays to a disk: slope, reach within the range
//   a.x    range(-0.9, 0.9)
//   b.x    range(0.9, 1.2)
//   b.y    range(0.01, 0.9)
// Values: 2
vec4 case_plane_disk_rays(CaseInput i) {
    return vec4(plane_disk_slope(i.a.x * i.b.y, i.b.x), plane_disk_reach(i.b.x, i.b.y), 0.0, 0.0);
}

// plane, place on a disk of a vertex in front of the eye
//   a.x    range(0.3, 3)
//   a.y    range(-1, 1)
vec4 case_plane_place_on_light(CaseInput i) {
    vec2 to_light = vec2(4.0, 0.0);
    vec2 from_eye = vec2(i.a.x, i.a.y);
    return case_of_real(plane_place_on_light(from_eye - to_light, from_eye));
}

// plane, ends of a round blocker on a disk
//   a.x    range(1, 3)
//   a.y    range(-1, 1)
//   b.x    range(0.01, 0.5)
// Values: 2
vec4 case_plane_round_ends(CaseInput i) {
    vec2 to_light = vec2(4.0, 0.0);
    vec2 to_blocker = vec2(i.a.x, i.a.y);
    PlaneRoundEnds ends = plane_round_ends(to_light, to_blocker, to_blocker - to_light, i.b.x);
    return vec4(ends.begin, ends.end, 0.0, 0.0);
}
