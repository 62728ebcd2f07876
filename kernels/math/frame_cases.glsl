// Parity cases of frame.glsl; tests/parity/case.glsl says how to write one.
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.

// frame from normal, to the world
//   a.xyz  direction
//   b.xyz  direction
// Values: 3
vec4 case_frame_from_normal(CaseInput i) {
    return case_of_vec3(transform(frame_from_normal(case_xyz(i.a)), case_xyz(i.b)));
}

// frame from normal and view, from the world
//   a.xyz  direction
//   b.xyz  direction
//   c.xyz  direction
// Values: 3
vec4 case_frame_from_normal_and_view(CaseInput i) {
    mat3 frame = frame_from_normal_and_view(case_xyz(i.a), case_xyz(i.b));
    return case_of_vec3(transform_transposed(frame, case_xyz(i.c)));
}
