// Parity cases of ellipsoid.glsl; tests/parity/case.glsl says how to write one.
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.

// Outline of an ellipsoid whose axes a frame turns.
EllipsoidOutline case_outline(CaseInput i) {
    mat3 frame = frame_from_normal(case_xyz(i.b));
    vec3 x = transform(frame, vec3(i.c.x, 0.0, 0.0));
    vec3 y = transform(frame, vec3(0.0, i.c.y, 0.0));
    vec3 z = transform(frame, vec3(0.0, 0.0, i.c.z));
    real rx = 1.0 / i.c.x;
    real ry = 1.0 / i.c.y;
    real rz = 1.0 / i.c.z;
    vec3 u = transform_transposed(frame, vec3(1.0, 0.0, 0.0));
    vec3 v = transform_transposed(frame, vec3(0.0, 1.0, 0.0));
    vec3 w = transform_transposed(frame, vec3(0.0, 0.0, 1.0));
    mat3 inverse = mat3(vec3(u.x * rx, u.y * ry, u.z * rz), vec3(v.x * rx, v.y * ry, v.z * rz),
                        vec3(w.x * rx, w.y * ry, w.z * rz));
    return ellipsoid_outline(case_xyz(i.a), mat3(x, y, z), inverse);
}

// ellipsoid outline, centre and whether outside
//   a.xyz  vector(2, 20)
//   b.xyz  direction
//   c.x    range(0.5, 1.5)
//   c.y    range(0.5, 1.5)
//   c.z    range(0.5, 1.5)
// Values: 4
vec4 case_ellipsoid_outline_center(CaseInput i) {
    EllipsoidOutline outline = case_outline(i);
    return vec4(outline.center.x, outline.center.y, outline.center.z, select(outline.outside, 1.0, 0.0));
}

// ellipsoid outline, normal of its plane
//   a.xyz  vector(2, 20)
//   b.xyz  direction
//   c.x    range(0.5, 1.5)
//   c.y    range(0.5, 1.5)
//   c.z    range(0.5, 1.5)
// Values: 3
vec4 case_ellipsoid_outline_plane(CaseInput i) {
    EllipsoidOutline outline = case_outline(i);
    return case_of_vec3(cross(outline.axis_a, outline.axis_b));
}
