// Parity cases of capsule.glsl; tests/parity/case.glsl says how to write one.
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.

// Error analysis cannot tell on which side of a root's 0 it is, where the rim of an end only just meets the horizon.

// capsule, irradiance vector
//   a.xyz  vector(1, 5)
//   b.xyz  vector(1, 5)
//   c.x    log(0.01, 0.5)
// Values: 3
// Bound: statistical
vec4 case_capsule_irradiance(CaseInput i) {
    return case_of_vec3(capsule_irradiance_vector(capsule_in_units(case_xyz(i.a), case_xyz(i.b), i.c.x)));
}

// line, irradiance vector
//   a.xyz  vector(1, 5)
//   b.xyz  vector(1, 5)
// Values: 3
vec4 case_line_irradiance(CaseInput i) {
    return case_of_vec3(line_irradiance_vector(case_xyz(i.a), case_xyz(i.b)));
}

// capsule, corners of a polygon gathered about a lobe
//   a.xyz  vector(1, 5)
//   b.xyz  vector(1, 5)
//   c.x    log(0.1, 0.5)
//   d.xyz  direction
//   a.w    range(0.1, 1)
// Values: 3
vec4 case_capsule_corner(CaseInput i) {
    CapsuleFan fan = capsule_fan(capsule_prepare(case_xyz(i.a), case_xyz(i.b), i.c.x), case_xyz(i.d), i.a.w, 12);
    // Five and seven corners: how many the fan gives each end is rounded to a whole number, and may be either.
    fan.a.step = fan.a.step * (fan.a.corners * 0.2);
    fan.b.step = fan.b.step * (fan.b.corners * 0.142857142857142857);
    fan.a.corners = 5.0;
    fan.b.corners = 7.0;
    return case_of_vec3(capsule_fan_corner(fan, 1) + capsule_fan_corner(fan, 7));
}

// capsule, its elements
//   a.xyz  vector(1, 5)
//   b.xyz  vector(0.01, 1)
//   c.x    log(0.01, 0.5)
// Values: 3
vec4 case_capsule_elements(CaseInput i) {
    LightElements e = capsule_elements(case_xyz(i.a), case_xyz(i.b), i.c.x);
    return case_of_vec3(e.area + e.reach_a + e.reach_b);
}
