// Parity cases of ellipse.glsl; tests/parity/case.glsl says how to write one.
// Needs: frame.glsl
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.

// The poles of these arcs are polished, see conic_polish_poles above.

// ellipse, irradiance vector
//   a.xyz  vector(1, 5)
//   b.xyz  vector(0.1, 2)
//   c.xyz  vector(0.1, 2)
// Values: 3
// Bound: statistical
vec4 case_ellipse_irradiance(CaseInput i) {
    return case_of_vec3(ellipse_irradiance_vector(ellipse_prepare(case_xyz(i.a), case_xyz(i.b), case_xyz(i.c))));
}

// ellipse, irradiance vector of one above the horizon
//   a.xyz  vector(1, 5)
//   b.xyz  vector(0.1, 2)
//   c.xyz  vector(0.1, 2)
// Values: 3
// Bound: statistical
vec4 case_ellipse_whole_irradiance(CaseInput i) {
    mat3 frame = mat3(vec3(1.0, 0.0, 0.0), vec3(0.0, 1.0, 0.0), vec3(0.0, 0.0, 1.0));
    return case_of_vec3(ellipse_whole_irradiance_vector(ellipse_in_units(frame, case_xyz(i.a), case_xyz(i.b), case_xyz(i.c))));
}

// ellipse, corners of a polygon about it
//   a.xyz  vector(1, 5)
//   b.xyz  vector(0.1, 2)
//   c.xyz  vector(0.1, 2)
// Values: 3
vec4 case_ellipse_corner(CaseInput i) {
    EllipseFan fan = ellipse_fan(ellipse_prepare(case_xyz(i.a), case_xyz(i.b), case_xyz(i.c)));
    return case_of_vec3(ellipse_fan_corner(fan, 3, 8));
}

// ellipse, corners gathered about a lobe
//   a.xyz  vector(4.5, 9)
//   b.xyz  vector(0.1, 2)
//   c.xyz  vector(0.1, 2)
//   d.xyz  direction
//   a.w    range(0.1, 1)
// Values: 3
vec4 case_ellipse_corner_concentrated(CaseInput i) {
    Ellipse e = ellipse_prepare(case_xyz(i.a), case_xyz(i.b), case_xyz(i.c));
    return case_of_vec3(ellipse_fan_corner(ellipse_fan_concentrated(e, case_xyz(i.d), i.a.w), 3, 8));
}

// ellipse, corners gathered about the rim's place next to the point
//   a.x    log(0.01, 0.3)
//   a.y    log(0.01, 0.3)
//   b.xyz  direction
//   c.x    range(0.7, 1)
//   c.y    range(-0.5, 0.5)
// Values: 3
// Bound: statistical
vec4 case_ellipse_corner_near(CaseInput i) {
    mat3 frame = frame_from_normal(case_xyz(i.b));
    vec3 long_axis = transform(frame, vec3(1.0, 0.0, 0.0));
    vec3 aside = transform(frame, vec3(0.0, 1.0, 0.0));
    vec3 center = long_axis * (-1.0 - i.a.x) + case_xyz(i.b) * i.a.y + aside * i.c.y;
    Ellipse e = ellipse_prepare(center, long_axis, aside * i.c.x);
    return case_of_vec3(ellipse_fan_corner(ellipse_fan_concentrated(e, case_xyz(i.b), 0.5), 9, 32));
}

// ellipse, its elements
//   a.xyz  vector(4.5, 9)
//   b.xyz  vector(0.1, 2)
//   c.xyz  vector(0.1, 2)
// Values: 4
vec4 case_ellipse_elements(CaseInput i) {
    LightElements e = ellipse_elements(ellipse_prepare(case_xyz(i.a), case_xyz(i.b), case_xyz(i.c)));
    return vec4(e.area.x, e.area.y, e.area.z, dot(e.center + e.reach_a, e.reach_b));
}
