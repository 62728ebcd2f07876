// Parity cases of ellipse.glsl; tests/parity/case.glsl says how to write one.
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
//   a.xyz  vector(1, 5)
//   b.xyz  vector(0.1, 2)
//   c.xyz  vector(0.1, 2)
//   d.xyz  direction
//   a.w    range(0.1, 1)
// Values: 3
vec4 case_ellipse_corner_concentrated(CaseInput i) {
    Ellipse e = ellipse_prepare(case_xyz(i.a), case_xyz(i.b), case_xyz(i.c));
    return case_of_vec3(ellipse_fan_corner(ellipse_fan_concentrated(e, case_xyz(i.d), i.a.w), 3, 8));
}
