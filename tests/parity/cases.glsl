// Parity cases: every kernel as a function of sixteen reals, so that one harness can run it in every language.
//
// How to add a case: write a function `vec4 case_NAME(CaseInput i)` in the dialect, here, once. Its comment's first
// line is the row's title in docs/accuracy.md; the lines after it say where the inputs come from,
//     //   a.xyz  direction                 members of the input, then a domain (below); members not named are 0
//   then `Error: relative` or `Error: absolute` (the default), and `Values: N`, how many of the four results count.
// Nothing else is to be done: make_cases.py reads this file and writes the C++ table and the shaders' entry points.
// Name the kernel's file in the Needs: line. A test fails while a kernel function is reached by no case.
//
// Domains (made in double with a fixed seed, rounded to float, the same for every target):
//   direction, upper_direction     unit vectors, uniform on the sphere or on its upper half
//   vector(low, high)              a direction times a length whose logarithm is uniform
//   range(low, high)               uniform
//   log(low, high)                 positive, its logarithm uniform
//   signed_log(low, high)          the same with either sign
//   integer(low, high)             whole numbers
// Needs: inverse_trig.glsl, frame.glsl, polygon.glsl, lambert.glsl, phong.glsl, microfacet.glsl, ellipsoid.glsl, plane.glsl
// Topics: case
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.

// What a case is given.
struct CaseInput {
    vec4 a;
    vec4 b;
    vec4 c;
    vec4 d;
};

// The first three numbers of four.
vec3 case_xyz(vec4 v) { return vec3(v.x, v.y, v.z); }

// A result of three numbers.
vec4 case_of_vec3(vec3 v) { return vec4(v.x, v.y, v.z, 0.0); }

// A result of one number.
vec4 case_of_real(real x) { return vec4(x, 0.0, 0.0, 0.0); }

// angle over sine, acute
//   a.x    range(0, 1)
// Error: relative
vec4 case_trig_angle_over_sine_acute(CaseInput i) { return case_of_real(trig_angle_over_sine_acute(i.a.x)); }

// angle over sine
//   a.x    range(-0.999, 1)
// Error: relative
vec4 case_trig_angle_over_sine(CaseInput i) {
    return case_of_real(trig_angle_over_sine(i.a.x, (1.0 - i.a.x) * (1.0 + i.a.x)));
}

// atan2
//   a.x    signed_log(1e-15, 1e15)
//   a.y    signed_log(1e-15, 1e15)
// Error: relative
vec4 case_trig_atan2(CaseInput i) { return case_of_real(trig_atan2(i.a.x, i.a.y)); }

// atan2, unwrapped
//   a.x    signed_log(1e-3, 1e3)
//   a.y    signed_log(1e-3, 1e3)
vec4 case_trig_atan2_unwrapped(CaseInput i) { return case_of_real(trig_atan2_unwrapped(i.a.x, i.a.y)); }

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

// polygon direction
//   a.xyz  vector(1e-12, 1e12)
// Values: 3
vec4 case_polygon_direction(CaseInput i) { return case_of_vec3(polygon_direction(case_xyz(i.a))); }

// polygon edge
//   a.xyz  direction
//   b.xyz  direction
// Values: 3
vec4 case_polygon_edge(CaseInput i) { return case_of_vec3(polygon_edge(case_xyz(i.a), case_xyz(i.b))); }

// Corner of a parallelogram with centre a and half axes b and c.
vec3 case_corner(CaseInput i, real x, real y) {
    return case_xyz(i.a) + case_xyz(i.b) * x + case_xyz(i.c) * y;
}

// Walk around that parallelogram.
PolygonWalk case_walk(CaseInput i) {
    vec3 v0 = polygon_direction(case_corner(i, -1.0, -1.0));
    vec3 v1 = polygon_direction(case_corner(i, 1.0, -1.0));
    vec3 v2 = polygon_direction(case_corner(i, 1.0, 1.0));
    vec3 v3 = polygon_direction(case_corner(i, -1.0, 1.0));
    PolygonWalk walk = polygon_begin();
    walk = polygon_add_edge(walk, v0, v1);
    walk = polygon_add_edge(walk, v1, v2);
    walk = polygon_add_edge(walk, v2, v3);
    walk = polygon_add_edge(walk, v3, v0);
    return walk;
}

// True where the walk around the parallelogram runs the wrong way.
mask case_walk_reversed(CaseInput i) {
    return dot(case_xyz(i.a), cross(case_xyz(i.b), case_xyz(i.c))) < 0.0;
}

// polygon irradiance vector, quad
//   a.xyz  vector(0.1, 10)
//   b.xyz  vector(0.1, 3)
//   c.xyz  vector(0.1, 3)
// Values: 3
vec4 case_polygon_irradiance_vector(CaseInput i) {
    return case_of_vec3(polygon_irradiance_vector(case_walk(i), case_walk_reversed(i)));
}

// polygon irradiance, quad
//   a.xyz  vector(0.1, 10)
//   b.xyz  vector(0.1, 3)
//   c.xyz  vector(0.1, 3)
vec4 case_polygon_irradiance(CaseInput i) {
    return case_of_real(polygon_irradiance(case_walk(i), case_walk_reversed(i)));
}

// polygon solid angle, quad
//   a.xyz  vector(0.1, 10)
//   b.xyz  vector(0.1, 3)
//   c.xyz  vector(0.1, 3)
vec4 case_solid_angle(CaseInput i) {
    vec3 v0 = polygon_direction(case_corner(i, -1.0, -1.0));
    vec3 v1 = polygon_direction(case_corner(i, 1.0, -1.0));
    vec3 v2 = polygon_direction(case_corner(i, 1.0, 1.0));
    vec3 v3 = polygon_direction(case_corner(i, -1.0, 1.0));
    SolidAngleWalk walk = solid_angle_begin(v0);
    walk = solid_angle_add_edge(walk, v1, v2);
    walk = solid_angle_add_edge(walk, v2, v3);
    return case_of_real(solid_angle_finish(walk, case_walk_reversed(i)));
}

// Lambert radiance
//   a.x    range(0, 3.14159)
// Error: relative
vec4 case_lambert_radiance(CaseInput i) { return case_of_real(lambert_radiance(i.a.x)); }

// Lambert lobe
//   a.xyz  direction
// Error: relative
vec4 case_lambert_lobe(CaseInput i) { return case_of_real(lambert_lobe(case_xyz(i.a))); }

// power of a cosine
//   a.x    range(0.9, 1)
//   a.y    log(1, 100)
// Error: relative
vec4 case_phong_power(CaseInput i) { return case_of_real(phong_power(i.a.x, i.a.y)); }

// Phong lobe about the mirrored view
//   a.xyz  upper_direction
//   b.xyz  upper_direction
//   a.w    log(1, 1000)
vec4 case_phong_lobe(CaseInput i) {
    return case_of_real(phong_lobe(case_xyz(i.a), phong_mirror(case_xyz(i.b)), i.a.w));
}

// Blinn-Phong distribution
//   a.xyz  upper_direction
//   a.w    log(1, 1000)
vec4 case_blinn_phong_distribution(CaseInput i) {
    return case_of_real(blinn_phong_distribution(case_xyz(i.a), i.a.w));
}

// half vector
//   a.xyz  upper_direction
//   b.xyz  upper_direction
// Values: 3
vec4 case_microfacet_half_vector(CaseInput i) {
    return case_of_vec3(microfacet_half_vector(case_xyz(i.a), case_xyz(i.b)));
}

// GGX distribution
//   a.xyz  upper_direction
//   b.x    log(0.01, 1)
//   b.y    log(0.01, 1)
// Error: relative
vec4 case_ggx_distribution(CaseInput i) {
    return case_of_real(ggx_distribution(case_xyz(i.a), i.b.x, i.b.y));
}

// GGX shadowing
//   a.xyz  direction
//   b.xyz  direction
//   c.x    log(0.0001, 1)
//   c.y    log(0.0001, 1)
// Error: relative
vec4 case_ggx_shadowing(CaseInput i) {
    return case_of_real(ggx_shadowing(case_xyz(i.a), case_xyz(i.b), i.c.x, i.c.y));
}

// Schlick's Fresnel
//   a.x    range(0, 1)
//   a.y    range(0, 1)
//   a.z    range(0, 1)
vec4 case_fresnel_schlick(CaseInput i) { return case_of_real(fresnel_schlick(i.a.x, i.a.y, i.a.z)); }

// Beckmann distribution
//   a.xyz  upper_direction
//   b.x    log(0.1, 1)
//   b.y    log(0.1, 1)
vec4 case_beckmann_distribution(CaseInput i) {
    return case_of_real(beckmann_distribution(case_xyz(i.a), i.b.x, i.b.y));
}

// GGX lobe
//   a.xyz  direction
//   b.xyz  upper_direction
//   c.x    log(0.01, 1)
//   c.y    log(0.01, 1)
// Error: relative
vec4 case_ggx_lobe(CaseInput i) { return case_of_real(ggx_lobe(case_xyz(i.a), case_xyz(i.b), i.c.x, i.c.y)); }

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

// plane, disk under a range window, between two rays; squared distance and radius in units of the range
//   a.x    range(0, 0.9)
//   a.y    range(-0.9, 0)
//   b.x    range(0.02, 0.9)
//   b.y    range(0.01, 0.95)
vec4 case_plane_disk_window(CaseInput i) {
    real rho2 = i.b.x * i.b.y * i.b.y;
    real tangent = sqrt(rho2) * inversesqrt(i.b.x - rho2);
    return case_of_real(plane_disk_window(i.a.y * tangent, i.a.x * tangent, i.b.x, rho2));
}

// plane, slope of a point in front of a pixel or behind it
//   a.x    signed_log(0.001, 1000)
//   a.y    signed_log(0.001, 1000)
// Error: relative
vec4 case_plane_slope(CaseInput i) { return case_of_real(plane_slope(i.a.x, i.a.y, 1.0e9)); }
