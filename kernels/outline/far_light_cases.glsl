// Parity cases of far_light.glsl; tests/parity/case.glsl says how to write one.
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.

// far light, vector of an element
//   a.xyz  direction
//   b.xyz  vector(0.1, 10)
// Error: absolute
// Values: 3
vec4 case_far_element(CaseInput i) {
    real scale = dot(case_xyz(i.b), case_xyz(i.b));
    return case_of_vec3(far_element_vector(case_xyz(i.a), case_xyz(i.b)) * scale);
}

// far light, vector of a ball
//   b.xyz  vector(0.1, 10)
// Error: absolute
// Values: 3
vec4 case_far_ball(CaseInput i) {
    return case_of_vec3(far_ball_vector(case_xyz(i.b)) * dot(case_xyz(i.b), case_xyz(i.b)));
}

// far light, errors of elements
//   a.x    log(1e-4, 1)
//   a.y    log(1, 1e3)
//   a.z    log(1e-6, 1)
//   a.w    log(1e-8, 1)
// Error: relative
// Values: 4
vec4 case_far_errors(CaseInput i) {
    real one = far_error_of_one(i.a.x, i.a.y);
    real four = far_error_of_four(i.a.z, i.a.w, mask_none(), i.a.y);
    real across = far_error_across_horizon(i.a.x, i.a.z, i.a.w, i.a.y);
    return vec4(one, four, far_error_of_four(i.a.z, i.a.w, mask_all(), i.a.y), across);
}

// far light, errors of interpolation
//   a.x    log(0.1, 1)
//   a.y    log(1, 10)
//   a.z    log(1, 10)
//   a.w    range(0.6, 1)
// Error: relative
// Values: 3
vec4 case_far_nodes(CaseInput i) {
    real plain = far_error_of_nodes(4, i.a.x, i.a.y);
    real grazing = far_error_of_grazing_nodes(2, i.a.x, i.a.y, i.a.z, i.a.w);
    return vec4(plain, grazing + 1.0, far_grazing(i.a.w).y + 1.0, 0.0);
}
