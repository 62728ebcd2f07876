// Parity cases: every kernel as a function of sixteen reals, so that one harness can run it in every language.
//
// How to add a case: write a function `vec4 case_NAME(CaseInput i)` in the dialect, here, once. Its comment's first
// line is the row's title in docs/accuracy.md; the lines after it say where the inputs come from,
//     //   a.xyz  direction                 members of the input, then a domain (below); members not named are 0
//   then `Error: relative` or `Error: absolute` (the default), `Values: N`, how many of the four results count, and
//   `Bound: statistical` with its reason above the case, where running error analysis finds no bound (shaken.h).
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
// Needs: inverse_trig.glsl, frame.glsl, polygon.glsl, lambert.glsl, phong.glsl, microfacet.glsl, ellipsoid.glsl, plane.glsl, horizon_clip.glsl, moment.glsl, moment_series.glsl, moment_cosine.glsl, moment_arvo.glsl, moment_quadrature.glsl, moment_peak_fits.glsl, lobe_product.glsl, ltc.glsl, ltc_clipless.glsl, representative_point.glsl, complex.glsl, quartic.glsl, gauss_legendre.glsl, conic.glsl, ellipse.glsl, capsule.glsl, ggx_closed_form.glsl, ggx_cubature.glsl, half_vector.glsl, ltc_texture.glsl, indirect.glsl
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

// A walk around the parallelogram, clipped to the horizon, piece by piece.
//   first, last  ends of the piece
//   exists       false where there is no piece; the ends are then those of any edge
struct CasePieces {
    HorizonClip clip;
    vec3 first;
    vec3 last;
    mask exists;
};

// The walk before its first piece.
CasePieces case_pieces_begin() {
    CasePieces pieces;
    pieces.clip = horizon_clip_begin();
    pieces.first = vec3(1.0, 0.0, 0.0);
    pieces.last = vec3(0.0, 1.0, 0.0);
    pieces.exists = pieces.first.x < 0.0;
    return pieces;
}

// Direction of corner k of the parallelogram, k from 0 to 4.
vec3 case_vertex(CaseInput i, int k) {
    real x = -1.0;
    real y = -1.0;
    if (k == 1 || k == 2) {
        x = 1.0;
    }
    if (k == 2 || k == 3) {
        y = 1.0;
    }
    return polygon_direction(case_corner(i, x, y));
}

// Piece j of 9: even ones are edges, odd ones and the last the arcs of the horizon that are due.
//
// An edge wholly below and an arc that is not due have two equal ends. The error analysis does not know that they are
// the same number, so that the normal of their plane could be anything to it: they are marked instead.
CasePieces case_piece(CasePieces pieces, CaseInput i, int j) {
    int k = j / 2;
    CasePieces next = pieces;
    if (j == 2 * k && j < 8) {
        vec3 a = case_vertex(i, k);
        vec3 b = case_vertex(i, k + 1);
        next.clip = horizon_clip_edge(pieces.clip, a, b);
        next.exists = a.z >= 0.0 || b.z >= 0.0;
        next.first = next.clip.start;
        next.last = next.clip.end;
    } else {
        if (j == 8) {
            next.clip = horizon_clip_finish(pieces.clip);
        }
        next.exists = next.clip.closes;
        next.first = next.clip.arc_start;
        next.last = next.clip.arc_end;
    }
    next.first = select(next.exists, next.first, vec3(1.0, 0.0, 0.0));
    next.last = select(next.exists, next.last, vec3(0.0, 1.0, 0.0));
    return next;
}

// horizon clip, irradiance vector of the clipped quad
//   a.xyz  vector(1, 5)
//   b.xyz  vector(0.1, 2)
//   c.xyz  vector(0.1, 2)
// Values: 3
vec4 case_horizon_clip(CaseInput i) {
    CasePieces pieces = case_pieces_begin();
    vec3 sum = vec3(0.0, 0.0, 0.0);
    for (int j = 0; j < 9; j++) {
        pieces = case_piece(pieces, i, j);
        sum = sum + select(pieces.exists, polygon_edge(pieces.first, pieces.last), vec3(0.0, 0.0, 0.0));
    }
    return case_of_vec3(sum);
}

// Phong series, clipped quad
//   a.xyz  vector(1, 5)
//   b.xyz  vector(0.1, 2)
//   c.xyz  vector(0.1, 2)
//   d.xyz  upper_direction
//   a.w    log(1, 500)
vec4 case_phong_series(CaseInput i) {
    vec3 r = polygon_direction(case_xyz(i.d));
    MomentSeries series = moment_series_prepare(i.a.w);
    CasePieces pieces = case_pieces_begin();
    real sum = 0.0;
    for (int j = 0; j < 9; j++) {
        pieces = case_piece(pieces, i, j);
        MomentEdge edge = moment_edge(pieces.first, pieces.last, r);
        sum = sum + select(pieces.exists, moment_edge_share(edge, moment_series_front(edge, series)), 0.0);
    }
    return case_of_real(moment_phong_radiance(sum, case_walk_reversed(i)));
}

// Phong series of high quality, clipped quad
//   a.xyz  vector(1, 5)
//   b.xyz  vector(0.1, 2)
//   c.xyz  vector(0.1, 2)
//   d.xyz  upper_direction
//   a.w    log(1, 500)
vec4 case_phong_series_high(CaseInput i) {
    vec3 r = polygon_direction(case_xyz(i.d));
    MomentSeriesHigh series = moment_series_high_prepare(i.a.w);
    CasePieces pieces = case_pieces_begin();
    real sum = 0.0;
    for (int j = 0; j < 9; j++) {
        pieces = case_piece(pieces, i, j);
        MomentEdge edge = moment_edge(pieces.first, pieces.last, r);
        sum = sum + select(pieces.exists, moment_edge_share(edge, moment_series_high_front(edge, series)), 0.0);
    }
    return case_of_real(moment_phong_radiance(sum, case_walk_reversed(i)));
}

// Phong series below exponent 1, clipped quad
//   a.xyz  vector(1, 5)
//   b.xyz  vector(0.1, 2)
//   c.xyz  vector(0.1, 2)
//   d.xyz  upper_direction
//   a.w    range(0, 1)
vec4 case_phong_series_low(CaseInput i) {
    vec3 r = polygon_direction(case_xyz(i.d));
    MomentSeries series = moment_series_prepare(i.a.w + 2.0);
    CasePieces pieces = case_pieces_begin();
    real sum = 0.0;
    for (int j = 0; j < 9; j++) {
        pieces = case_piece(pieces, i, j);
        MomentEdge edge = moment_edge(pieces.first, pieces.last, r);
        sum = sum + select(pieces.exists, moment_edge_share(edge, moment_series_low_front(edge, series, i.a.w)), 0.0);
    }
    return case_of_real(moment_phong_radiance(sum, case_walk_reversed(i)));
}

// Phong series of high quality below exponent 1, clipped quad
//   a.xyz  vector(1, 5)
//   b.xyz  vector(0.1, 2)
//   c.xyz  vector(0.1, 2)
//   d.xyz  upper_direction
//   a.w    range(0, 1)
vec4 case_phong_series_high_low(CaseInput i) {
    vec3 r = polygon_direction(case_xyz(i.d));
    MomentSeriesHigh series = moment_series_high_prepare(i.a.w + 2.0);
    CasePieces pieces = case_pieces_begin();
    real sum = 0.0;
    for (int j = 0; j < 9; j++) {
        pieces = case_piece(pieces, i, j);
        MomentEdge edge = moment_edge(pieces.first, pieces.last, r);
        sum = sum + select(pieces.exists, moment_edge_share(edge, moment_series_high_low_front(edge, series, i.a.w)), 0.0);
    }
    return case_of_real(moment_phong_radiance(sum, case_walk_reversed(i)));
}

// Phong recurrence, exponent 8, clipped quad
//   a.xyz  vector(1, 5)
//   b.xyz  vector(0.1, 2)
//   c.xyz  vector(0.1, 2)
//   d.xyz  upper_direction
vec4 case_phong_arvo_even(CaseInput i) {
    vec3 r = polygon_direction(case_xyz(i.d));
    CasePieces pieces = case_pieces_begin();
    real sum = 0.0;
    for (int j = 0; j < 9; j++) {
        pieces = case_piece(pieces, i, j);
        MomentEdge edge = moment_edge(pieces.first, pieces.last, r);
        sum = sum + select(pieces.exists, moment_edge_share(edge, moment_arvo_front(edge, 8, 0, 0.0)), 0.0);
    }
    return case_of_real(moment_phong_radiance(sum, case_walk_reversed(i)));
}

// Phong recurrence, exponent 15, clipped quad
//   a.xyz  vector(1, 5)
//   b.xyz  vector(0.1, 2)
//   c.xyz  vector(0.1, 2)
//   d.xyz  upper_direction
vec4 case_phong_arvo_odd(CaseInput i) {
    vec3 r = polygon_direction(case_xyz(i.d));
    CasePieces pieces = case_pieces_begin();
    real sum = 0.0;
    for (int j = 0; j < 9; j++) {
        pieces = case_piece(pieces, i, j);
        MomentEdge edge = moment_edge(pieces.first, pieces.last, r);
        sum = sum + select(pieces.exists, moment_edge_share(edge, moment_arvo_front(edge, 15, 0, 0.0)), 0.0);
    }
    return case_of_real(moment_phong_radiance(sum, case_walk_reversed(i)));
}

// Phong lorentzian fit, even exponent's form, clipped quad
//   a.xyz  vector(1, 5)
//   b.xyz  vector(0.1, 2)
//   c.xyz  vector(0.1, 2)
//   d.xyz  upper_direction
//   a.w    range(2, 100)
vec4 case_phong_lorentzian_even(CaseInput i) {
    vec3 r = polygon_direction(case_xyz(i.d));
    CasePieces pieces = case_pieces_begin();
    real sum = 0.0;
    for (int j = 0; j < 9; j++) {
        pieces = case_piece(pieces, i, j);
        MomentEdge edge = moment_edge(pieces.first, pieces.last, r);
        sum = sum + select(pieces.exists, moment_edge_share(edge, moment_lorentzian_front(edge, i.a.w, 1)), 0.0);
    }
    return case_of_real(moment_phong_radiance(sum, case_walk_reversed(i)));
}

// Phong lorentzian fit, odd exponent's form, clipped quad
//   a.xyz  vector(1, 5)
//   b.xyz  vector(0.1, 2)
//   c.xyz  vector(0.1, 2)
//   d.xyz  upper_direction
//   a.w    range(2, 100)
vec4 case_phong_lorentzian_odd(CaseInput i) {
    vec3 r = polygon_direction(case_xyz(i.d));
    CasePieces pieces = case_pieces_begin();
    real sum = 0.0;
    for (int j = 0; j < 9; j++) {
        pieces = case_piece(pieces, i, j);
        MomentEdge edge = moment_edge(pieces.first, pieces.last, r);
        sum = sum + select(pieces.exists, moment_edge_share(edge, moment_lorentzian_front(edge, i.a.w, 0)), 0.0);
    }
    return case_of_real(moment_phong_radiance(sum, case_walk_reversed(i)));
}

// Edge in front of the axis z, whose foot is between its ends and some way from the axis.
MomentEdge case_front_edge(CaseInput i) {
    vec3 a = polygon_direction(vec3(i.a.x, -i.a.y, 1.0));
    vec3 b = polygon_direction(vec3(i.a.x, i.a.z, 1.0));
    return moment_edge(a, b, vec3(0.0, 0.0, 1.0));
}

// Phong quadrature, one edge: moment and power
//   a.x    range(0.3, 1)
//   a.y    range(0.2, 1)
//   a.z    range(0.2, 1)
//   a.w    log(1, 50)
// Values: 2
vec4 case_phong_quadrature(CaseInput i) {
    MomentIntegrands front = moment_quadrature_front(case_front_edge(i), i.a.w);
    return vec4(front.moment, front.power, 0.0, 0.0);
}

// The blends of two peaks are ill-conditioned where their tails nearly meet, and the ellipsoid where it is nearly flat:
// the two below keep to edges some way from the axis, the ellipsoid to sharp lobes, and its bound is the spread all the same.

// Phong pearson fit, one edge: the form of even exponents and that of the others
//   a.x    range(0.4, 0.8)
//   a.y    range(0.2, 1)
//   a.z    range(0.2, 1)
//   a.w    range(5, 20)
// Values: 2
vec4 case_phong_pearson(CaseInput i) {
    MomentEdge edge = case_front_edge(i);
    return vec4(moment_pearson_front(edge, i.a.w, 1), moment_pearson_front(edge, i.a.w, 0), 0.0, 0.0);
}

// Phong ellipsoid fit, one edge: the form of even exponents and that of the others
//   a.x    range(0.2, 0.5)
//   a.y    range(0.2, 1)
//   a.z    range(0.2, 1)
//   a.w    range(100, 300)
// Values: 2
// Bound: statistical
vec4 case_phong_ellipsoid(CaseInput i) {
    MomentEdge edge = case_front_edge(i);
    return vec4(moment_ellipsoid_front(edge, i.a.w, 1), moment_ellipsoid_front(edge, i.a.w, 0), 0.0, 0.0);
}

// double-axis moment by the cosine series, clipped quad
//   a.xyz  vector(1, 5)
//   b.xyz  vector(0.1, 2)
//   c.xyz  vector(0.1, 2)
//   d.xyz  upper_direction
//   a.w    log(10, 200)
vec4 case_double_axis(CaseInput i) {
    vec3 r = polygon_direction(case_xyz(i.d));
    MomentSeries series = moment_series_prepare(i.a.w - 1.0);
    CasePieces pieces = case_pieces_begin();
    real sum = 0.0;
    for (int j = 0; j < 9; j++) {
        pieces = case_piece(pieces, i, j);
        MomentEdge edge = moment_edge(pieces.first, pieces.last, r);
        real share = moment_edge_share(edge, moment_series_front(edge, series));
        share = moment_double_axis_share(pieces.first, pieces.last, r, vec3(0.0, 0.0, 1.0), share,
            moment_cosine_front(edge, i.a.w, 0));
        sum = sum + select(pieces.exists, share, 0.0);
    }
    return case_of_real(sum);
}

// LTC coordinates and factors
//   a.x    range(0, 1)
//   a.y    range(0, 1)
//   a.z    range(0, 1)
//   a.w    range(0, 1)
// Values: 4
vec4 case_ltc_factors(CaseInput i) {
    vec2 place = ltc_coordinates(i.a.x, i.a.y);
    real coat = ltc_clear_coat(ltc_specular_scale(0.04, 1.0, i.a.x, i.a.y), i.a.z, i.a.w, i.a.x);
    real sheen = ltc_sheen(i.a.x, i.a.y, i.a.z, i.a.w);
    return vec4(place.x + place.y, ltc_multiple_scattering(i.a.z, 0.1 + 0.9 * i.a.w), coat, sheen);
}

// LTC lobe of the classic table
//   a.xyz  direction
//   d.x    range(0.2, 1.5)
//   d.y    range(-1, 1)
//   d.z    range(-1, 1)
//   d.w    range(1.2, 3)
vec4 case_ltc_lobe(CaseInput i) {
    return case_of_real(ltc_lobe(ltc_from_classic(i.d), case_xyz(i.a)));
}

// Walk around the parallelogram for a linearly transformed cosine.
LtcWalk case_ltc_walk(CaseInput i, LtcMatrix m) {
    LtcWalk walk = ltc_begin();
    for (int k = 0; k < 4; k++) {
        vec3 a = case_vertex(i, k);
        vec3 b = case_vertex(i, k + 1);
        walk = ltc_add_edge(walk, m, a, b, ltc_direction(m, a), ltc_direction(m, b));
    }
    return walk;
}

// LTC of the classic table, quad across the horizon
//   a.xyz  vector(1, 5)
//   b.xyz  vector(0.1, 2)
//   c.xyz  vector(0.1, 2)
//   d.x    range(0.2, 1.5)
//   d.y    range(-1, 1)
//   d.z    range(-1, 1)
//   d.w    range(1.2, 3)
vec4 case_ltc_classic(CaseInput i) {
    LtcMatrix m = ltc_from_classic(i.d);
    real integral = ltc_integral(case_ltc_walk(i, m), case_walk_reversed(i));
    return case_of_real(ltc_specular_with_fresnel_lobe(0.04, 1.0, 0.9, integral, 0.1, integral) / ltc_energy_above_horizon(m));
}

// LTC of the compact table, quad across the horizon
//   a.xyz  vector(1, 5)
//   b.xyz  vector(0.1, 2)
//   c.xyz  vector(0.1, 2)
//   a.w    range(0.1, 1)
//   b.w    range(0.1, 1)
//   d.x    range(0.5, 1.5)
//   d.y    range(0.5, 1.5)
//   d.z    range(-0.5, 0.5)
//   d.w    range(-0.5, 0.5)
vec4 case_ltc_compact(CaseInput i) {
    vec3 view = vec3(sqrt(1.0 - i.b.w * i.b.w), 0.0, i.b.w);
    LtcMatrix m = ltc_from_compact(i.d, i.a.w, view);
    return case_of_real(ltc_integral(case_ltc_walk(i, m), case_walk_reversed(i)));
}

// LTC without clipping, quad
//   a.xyz  vector(1, 5)
//   b.xyz  vector(0.1, 2)
//   c.xyz  vector(0.1, 2)
//   d.x    range(0.2, 1.5)
//   d.y    range(-1, 1)
//   d.z    range(-1, 1)
//   d.w    range(1.2, 3)
vec4 case_ltc_clipless(CaseInput i) {
    LtcMatrix m = ltc_from_classic(i.d);
    vec3 sum = vec3(0.0, 0.0, 0.0);
    for (int k = 0; k < 4; k++) {
        sum = ltc_clipless_add_edge(sum, ltc_direction(m, case_vertex(i, k)), ltc_direction(m, case_vertex(i, k + 1)));
    }
    return case_of_real(ltc_clipless_integral(sum, case_walk_reversed(i)));
}

// complex product and quotient
//   a.x    range(-2, 2)
//   a.y    range(-2, 2)
//   b.x    signed_log(0.1, 2)
//   b.y    range(-2, 2)
// Values: 4
vec4 case_complex(CaseInput i) {
    vec2 a = vec2(i.a.x, i.a.y);
    vec2 b = vec2(i.b.x, i.b.y);
    vec2 p = complex_product(a, b);
    vec2 q = complex_quotient(a, b);
    return vec4(p.x, p.y, q.x, q.y);
}

// complex unit and sign
//   a.x    range(-3.14159, 3.14159)
//   b.x    signed_log(0.01, 2)
//   b.y    range(-2, 2)
// Values: 4
vec4 case_complex_unit(CaseInput i) {
    vec2 u = complex_unit(i.a.x);
    vec2 s = complex_sign(vec2(i.b.x, i.b.y));
    return vec4(u.x, u.y, s.x, s.y);
}

// cosine of a third of an angle
//   a.x    range(-0.99, 1)
vec4 case_quartic_third_cosine(CaseInput i) { return case_of_real(quartic_third_cosine(i.a.x)); }

// quartic poles' start, pairs apart
//   a.x    range(-1, -0.3)
//   a.y    range(0.3, 1)
//   b.x    range(0.3, 1)
//   b.y    range(0.3, 1)
// Values: 4
vec4 case_quartic_poles(CaseInput i) {
    real s1 = i.a.x * i.a.x + i.a.y * i.a.y;
    real s2 = i.b.x * i.b.x + i.b.y * i.b.y;
    QuarticPoles poles = quartic_poles_approximate(s1 * s2, -2.0 * (i.a.x * s2 + i.b.x * s1),
        s1 + s2 + 4.0 * i.a.x * i.b.x, -2.0 * (i.a.x + i.b.x));
    return vec4(poles.z1.x, poles.z1.y, poles.z2.x, poles.z2.y);
}

// A conic arc from its poles a.xy and b.xy, its bend c.x in (-1, 1), its frame d.xyz and its ends c.y, c.z: the curve
// is found from the poles, so that no iteration is in it. With poles p + i b and q + i c: u2 = 1, u1.u2 = -(p + q),
// u0.u2 = p q + t b c; the rest follows from the product of the factors of |u|^2.
ConicArc case_arc(CaseInput i) {
    real p = i.a.x;
    real b = i.a.y;
    real q = i.b.x;
    real c = i.b.y;
    real t = i.c.x;
    real s = sqrt((b - c) * (b - c) + 2.0 * (1.0 - t) * b * c);
    real g = (t * b * c * (p + q) - p * c * c - q * b * b) / s;
    real k = b * c * sqrt((1.0 - t * t) * (1.0 + (p - q) * (p - q) / (s * s)));
    mat3 frame = frame_from_normal(case_xyz(i.d));
    ConicArc arc;
    arc.u0 = transform(frame, vec3(p * q + t * b * c, g, k));
    arc.u1 = transform(frame, vec3(-p - q, s, 0.0));
    arc.u2 = transform(frame, vec3(1.0, 0.0, 0.0));
    arc.begin = i.c.y;
    arc.end = i.c.z;
    arc.scale = 1.0;
    arc.z1 = vec2(p, b);
    arc.z2 = vec2(q, c);
    arc.sweep = vec2(conic_sweep(arc.z1, arc.begin, arc.end), conic_sweep(arc.z2, arc.begin, arc.end));
    return arc;
}

// conic vector from known poles
//   a.x    range(-1, -0.2)
//   a.y    range(0.3, 1)
//   b.x    range(0.2, 1)
//   b.y    range(0.3, 1)
//   c.x    range(-0.9, 0.9)
//   c.y    range(-1.5, -0.1)
//   c.z    range(0.1, 1.5)
//   d.xyz  direction
// Values: 3
vec4 case_conic_vector(CaseInput i) { return case_of_vec3(conic_vector(case_arc(i))); }

// conic vector by quadrature
//   a.x    range(-1, -0.2)
//   a.y    range(0.3, 1)
//   b.x    range(0.2, 1)
//   b.y    range(0.3, 1)
//   c.x    range(-0.9, 0.9)
//   c.y    range(-1.5, -0.1)
//   c.z    range(0.1, 1.5)
//   d.xyz  direction
// Values: 3
vec4 case_conic_vector_approximate(CaseInput i) { return case_of_vec3(conic_vector_approximate(case_arc(i))); }

// Running error analysis loses conic_polish_poles: the step goes to nothing, and with it all digits of the step's limit; nor can
// it see that a step forgets the error of the one before. The first case below stays at the start, with an arc without
// length; the others are bounded by the spread of evaluations with other roundings.

// conic, start of the poles and unit
//   a.x    range(-1, -0.2)
//   a.y    range(0.3, 1)
//   b.x    range(0.2, 1)
//   b.y    range(0.3, 1)
//   c.x    range(-0.9, 0.9)
//   c.y    range(-1.5, -0.1)
//   c.z    range(0.1, 1.5)
//   d.xyz  direction
// Values: 4
vec4 case_conic_prepare(CaseInput i) {
    ConicArc given = case_arc(i);
    ConicArc arc = conic_prepare(given.u0, given.u1, given.u2, 0.0, 0.0);
    return vec4(arc.z1.x + arc.z2.x, arc.z1.y + arc.scale, arc.z2.y, arc.sweep.x + arc.sweep.y);
}

// conic, poles polished
//   a.x    range(-1, -0.2)
//   a.y    range(0.3, 1)
//   b.x    range(0.2, 1)
//   b.y    range(0.3, 1)
//   c.x    range(-0.9, 0.9)
//   c.y    range(-1.5, -0.1)
//   c.z    range(0.1, 1.5)
//   d.xyz  direction
//   c.w    range(-0.0001, 0.0001)
//   d.w    range(-0.0001, 0.0001)
// Values: 4
// Bound: statistical
vec4 case_conic_polish_poles(CaseInput i) {
    ConicArc arc = case_arc(i);
    QuarticPoles start;
    start.z1 = vec2(i.a.x + i.c.w, i.a.y + i.d.w);
    start.z2 = vec2(i.b.x - i.d.w, i.b.y + i.c.w);
    QuarticPoles poles = conic_polish_poles(arc, start);
    return vec4(poles.z1.x, poles.z1.y, poles.z2.x, poles.z2.y);
}

// Gauss and Legendre on 1 / (1 + x)
//   a.x    range(0, 1)
vec4 case_gauss_legendre(CaseInput i) {
    real sum = 0.0;
    for (int n = 1; n <= 8; n++) {
        for (int j = 0; j < n; j++) {
            vec2 rule = gauss_legendre_node(n, j);
            sum = sum + rule.y / (1.0 + i.a.x * rule.x);
        }
    }
    return case_of_real(sum);
}

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

// Where the rim of an end only just meets the horizon, error analysis cannot tell on which side of a root's 0 it is.

// capsule, irradiance vector
//   a.xyz  vector(1, 5)
//   b.xyz  vector(1, 5)
//   c.x    log(0.01, 0.5)
// Values: 3
// Bound: statistical
vec4 case_capsule_irradiance(CaseInput i) {
    return case_of_vec3(capsule_irradiance_vector(capsule_prepare(case_xyz(i.a), case_xyz(i.b), i.c.x)));
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

// The view of an arc's cubature: the arc's frame does not matter to it.
GgxView case_arc_view(CaseInput i) {
    return ggx_view(polygon_direction(vec3(0.3, 0.2, i.a.w)), i.b.w, i.c.w);
}

// GGX cubature over the fan of one arc, normal quality
//   a.x    range(-1, -0.2)
//   a.y    range(0.3, 1)
//   b.x    range(0.2, 1)
//   b.y    range(0.3, 1)
//   c.x    range(-0.9, 0.9)
//   c.y    range(-1.5, -0.1)
//   c.z    range(0.1, 1.5)
//   d.xyz  upper_direction
//   a.w    range(0.3, 2)
//   b.w    range(0.2, 1)
//   c.w    range(0.2, 1)
// Values: 2
vec4 case_ggx_cubature_normal(CaseInput i) {
    GgxView view = case_arc_view(i);
    ConicArc arc = case_arc(i);
    vec3 e = conic_vector(arc);
    GgxCubature c = ggx_cubature_begin(view, e, 1.0, select(dot(view.w, e) < 0.0, -1.0, 1.0));
    vec2 r = ggx_cubature_finish(ggx_cubature_edge(c, arc, 0));
    return vec4(r.x, ggx_radiance(r, 0.04, 1.0), 0.0, 0.0);
}

// GGX cubature over the fan of one arc, high quality
//   a.x    range(-1, -0.2)
//   a.y    range(0.3, 1)
//   b.x    range(0.2, 1)
//   b.y    range(0.3, 1)
//   c.x    range(-0.9, 0.9)
//   c.y    range(-1.5, -0.1)
//   c.z    range(0.1, 1.5)
//   d.xyz  upper_direction
//   a.w    range(0.3, 2)
//   b.w    range(0.2, 1)
//   c.w    range(0.2, 1)
// Values: 2
vec4 case_ggx_cubature_high(CaseInput i) {
    GgxView view = case_arc_view(i);
    ConicArc arc = case_arc(i);
    vec3 e = conic_vector(arc);
    GgxCubature c = ggx_cubature_begin(view, e, 1.0, select(dot(view.w, e) < 0.0, -1.0, 1.0));
    vec2 r = ggx_cubature_finish(ggx_cubature_edge(c, arc, 2));
    return vec4(r.x, ggx_radiance(r, 0.04, 1.0), 0.0, 0.0);
}

// GGX draft over the fan of one arc
//   a.x    range(-1, -0.2)
//   a.y    range(0.3, 1)
//   b.x    range(0.2, 1)
//   b.y    range(0.3, 1)
//   c.x    range(-0.9, 0.9)
//   c.y    range(-1.5, -0.1)
//   c.z    range(0.1, 1.5)
//   d.xyz  upper_direction
//   a.w    range(0.3, 2)
//   b.w    range(0.2, 1)
//   c.w    range(0.2, 1)
// Values: 2
vec4 case_ggx_draft(CaseInput i) {
    GgxView view = case_arc_view(i);
    vec3 e = conic_vector(case_arc(i));
    vec2 r = ggx_draft(view, e, 1.0, select(dot(view.w, e) < 0.0, -1.0, 1.0));
    return vec4(r.x, ggx_radiance(r, 0.04, 1.0), 0.0, 0.0);
}

// half vector, splits of an arc
//   a.x    range(-0.5, -0.1)
//   a.y    range(0.6, 1)
//   b.x    range(0.1, 0.5)
//   b.y    range(0.6, 1)
//   c.x    range(-0.9, 0.9)
//   c.y    range(-1.5, -0.1)
//   c.z    range(0.1, 1.5)
//   d.xyz  direction
//   d.w    range(0.05, 0.95)
// Values: 2
vec4 case_half_vector_splits(CaseInput i) {
    ConicArc arc = case_arc(i);
    return vec4(half_vector_split_uniform(arc, i.d.w), half_vector_split_pole_mapped(arc, i.d.w), 0.0, 0.0);
}

// half vector, Blinn-Phong arc by quadrature
//   a.xyz  upper_direction
//   b.xyz  upper_direction
//   c.xyz  upper_direction
//   a.w    log(2, 200)
vec4 case_blinn_phong_arc(CaseInput i) {
    return case_of_real(blinn_phong_arc(case_xyz(i.a), case_xyz(i.b), case_xyz(i.c), i.a.w));
}

// half vector, Blinn-Phong arc by series, exponents from 8, from 2, below
//   a.xyz  upper_direction
//   b.xyz  upper_direction
//   c.xyz  upper_direction
//   a.w    range(8, 200)
//   b.w    range(2, 8)
//   c.w    range(0.1, 2)
// Values: 3
vec4 case_blinn_phong_arc_approximate(CaseInput i) {
    vec3 a = case_xyz(i.a);
    vec3 b = case_xyz(i.b);
    vec3 v = case_xyz(i.c);
    return vec4(blinn_phong_arc_approximate(a, b, v, moment_series_prepare(i.a.w - 1.0), i.a.w, 0),
                blinn_phong_arc_approximate(a, b, v, moment_series_prepare(i.b.w - 1.0), i.b.w, 1),
                blinn_phong_arc_approximate(a, b, v, moment_series_prepare(i.c.w + 1.0), i.c.w, 2),
                blinn_phong_alpha(i.a.w));
}

// half vector, Beckmann arc
//   a.xyz  upper_direction
//   b.xyz  upper_direction
//   c.xyz  upper_direction
//   a.w    range(0.3, 1)
//   b.w    range(0.3, 1)
vec4 case_beckmann_arc(CaseInput i) {
    GgxView view = ggx_view(case_xyz(i.c), i.a.w, i.b.w);
    real sum = beckmann_arc(view, case_xyz(i.a), case_xyz(i.b), beckmann_series());
    return case_of_real(sum);
}

// half vector, GGX arc and radiance from a sum
//   a.xyz  upper_direction
//   b.xyz  upper_direction
//   c.xyz  upper_direction
//   a.w    log(0.01, 1)
//   b.w    log(0.01, 1)
//   c.w    range(0, 1)
// Values: 4
vec4 case_ggx_arc(CaseInput i) {
    GgxView view = ggx_view(case_xyz(i.c), i.a.w, i.b.w);
    vec3 e = ggx_arc(view, case_xyz(i.a), case_xyz(i.b));
    return vec4(e.x, e.y, e.z, half_vector_radiance(view, i.c.w * view.v.z, 1.0));
}

// Product of two lobes that reach each other: one step from the middle.
LobeProduct case_lobe_product(CaseInput i) {
    vec3 r = case_xyz(i.a);
    vec3 other = polygon_direction(r + case_xyz(i.b) * 0.5);
    LobeProduct p = lobe_product_begin(polygon_direction(r + other));
    p = lobe_product_add(lobe_product_add(p, r, i.a.w), other, i.b.w);
    vec3 better = lobe_product_newton(p);
    p = lobe_product_begin(better);
    return lobe_product_add(lobe_product_add(p, r, i.a.w), other, i.b.w);
}

// lobe product, isotropic: axis and scale
//   a.xyz  direction
//   b.xyz  direction
//   a.w    range(1, 20)
//   b.w    range(1, 20)
// Values: 4
vec4 case_lobe_product_isotropic(CaseInput i) {
    CosineLobe lobe = lobe_product_isotropic(case_lobe_product(i));
    return vec4(lobe.axis.x, lobe.axis.y, lobe.axis.z, lobe.scale);
}

// lobe product, exponents over the sum of the lobes'
//   a.xyz  direction
//   b.xyz  direction
//   a.w    range(1, 20)
//   b.w    range(1, 20)
// Values: 2
vec4 case_lobe_product_exponents(CaseInput i) {
    LobeProduct p = case_lobe_product(i);
    real whole = 1.0 / (i.a.w + i.b.w);
    CosineLobe lobe = lobe_product_isotropic(p);
    StretchedLobe stretched = lobe_product_anisotropic(p);
    return vec4(lobe.exponent * whole, stretched.exponent * whole, 0.0, 0.0);
}

// lobe product, a direction in the stretched frame
//   a.xyz  direction
//   b.xyz  direction
//   a.w    range(1, 20)
//   b.w    range(1, 20)
//   c.xyz  direction
// Values: 3
vec4 case_lobe_product_stretch(CaseInput i) {
    return case_of_vec3(lobe_product_stretch(lobe_product_anisotropic(case_lobe_product(i)), case_xyz(i.c)));
}

// lobe product, peak of two
//   a.xyz  direction
//   b.xyz  direction
//   a.w    range(1, 20)
//   b.w    range(1, 20)
// Values: 3
vec4 case_lobe_product_peak(CaseInput i) {
    vec3 r = case_xyz(i.a);
    return case_of_vec3(lobe_product_peak_of_two(r, i.a.w, polygon_direction(r + case_xyz(i.b) * 0.5), i.b.w));
}

// Walk around the parallelogram for its representative point.
RepresentativeWalk case_representative_walk(CaseInput i, vec3 mirror) {
    RepresentativeWalk walk = representative_begin();
    for (int k = 0; k < 4; k++) {
        walk = representative_add_edge(walk, mirror, case_vertex(i, k), case_vertex(i, k + 1));
    }
    return walk;
}

// representative point, radiance and v.h, quad
//   a.xyz  vector(1, 5)
//   b.xyz  vector(0.1, 2)
//   c.xyz  vector(0.1, 2)
//   d.xyz  upper_direction
//   a.w    range(0.2, 1)
//   b.w    range(0, 3)
// Values: 2
vec4 case_representative_point(CaseInput i) {
    vec3 view = case_xyz(i.d);
    vec3 mirror = vec3(-view.x, -view.y, view.z);
    RepresentativeWalk walk = case_representative_walk(i, mirror);
    mask reversed = case_walk_reversed(i);
    return vec4(representative_radiance(walk, view, mirror, i.b.w, i.a.w, reversed),
                representative_v_dot_h(walk, view, mirror, reversed), 0.0, 0.0);
}

// textured light, irradiance vector under the LTC, quad across the horizon
//   a.xyz  vector(1, 5)
//   b.xyz  vector(0.1, 2)
//   c.xyz  vector(0.1, 2)
//   d.x    range(0.2, 1.5)
//   d.y    range(-1, 1)
//   d.z    range(-1, 1)
//   d.w    range(1.2, 3)
// Values: 3
vec4 case_ltc_texture_irradiance_vector(CaseInput i) {
    return case_of_vec3(ltc_texture_irradiance_vector(case_ltc_walk(i, ltc_from_classic(i.d)), case_walk_reversed(i)));
}

// The footprint about a direction on a plane that the lobe meets well.
LtcTextureFootprint case_footprint(CaseInput i, LtcMatrix m) {
    vec3 meets = polygon_direction(ltc_texture_transform_back(m, case_xyz(i.a)));
    vec3 normal = polygon_direction(meets + case_xyz(i.b) * 0.5);
    return ltc_texture_footprint(m, case_xyz(i.a) * i.a.w, normal, i.b.w);
}

// textured light, centre of the footprint
//   a.xyz  upper_direction
//   a.w    log(0.001, 1)
//   b.xyz  direction
//   b.w    range(0.5, 5)
//   d.x    range(0.5, 1.5)
//   d.y    range(-0.4, 0.4)
//   d.z    range(-0.4, 0.4)
//   d.w    range(1, 2)
// Values: 3
vec4 case_ltc_texture_center(CaseInput i) { return case_of_vec3(case_footprint(i, ltc_from_classic(i.d)).center); }

// textured light, plane of the footprint of a lobe and area of that of a diffuse surface
//   a.xyz  upper_direction
//   a.w    log(0.001, 1)
//   b.xyz  direction
//   b.w    range(0.5, 5)
//   d.x    range(0.5, 1.5)
//   d.y    range(-0.4, 0.4)
//   d.z    range(-0.4, 0.4)
//   d.w    range(1, 2)
// Values: 4
vec4 case_ltc_texture_footprint(CaseInput i) {
    LtcTextureFootprint lobe = case_footprint(i, ltc_from_classic(i.d));
    LtcTextureFootprint diffuse = case_footprint(i, ltc_texture_diffuse());
    vec3 plane = cross(lobe.axis_a, lobe.axis_b);
    vec3 area = cross(diffuse.axis_a, diffuse.axis_b);
    return vec4(plane.x, plane.y, plane.z, select(lobe.valid, sqrt(dot(area, area)), 0.0));
}

// textured light, a Gaussian from conjugate radii: long deviation and short one
//   a.x    range(1, 2)
//   a.y    range(-0.5, 0.5)
//   b.x    range(-0.5, 0.5)
//   b.y    range(0.2, 0.6)
//   c.x    range(0.2, 1)
//   c.y    range(0.2, 1)
// Values: 3
vec4 case_ltc_texture_gaussian(CaseInput i) {
    LtcTextureEllipse g = ltc_texture_gaussian(ltc_texture_axes(xy(case_xyz(i.a)), xy(case_xyz(i.b))), i.c.x, i.c.y);
    return vec4(g.major.x, g.major.y, g.minor, 0.0);
}

// textured light, where a Gaussian stands
//   a.x    range(0.1, 1)
//   a.y    range(0.1, 1)
//   a.z    range(0.05, 0.1)
//   b.x    range(-1, 1)
//   b.y    range(-1, 1)
//   c.x    range(-1, 1)
//   c.y    range(-1, 1)
//   d.x    range(0.2, 1)
//   d.y    range(-0.1, 0.1)
//   d.z    range(0.2, 1)
// Values: 2
vec4 case_ltc_texture_place(CaseInput i) {
    LtcTextureEllipse g;
    g.major = vec2(i.a.x, i.a.y);
    g.minor = i.a.z;
    vec2 r = ltc_texture_place(g, vec2(i.b.x, i.b.y), vec2(i.c.x, i.c.y), case_xyz(i.d));
    return vec4(r.x, r.y, 0.0, 0.0);
}

// A lobe about the normal n, from the classic table.
IndirectLobe case_indirect_lobe(vec3 n, vec4 table) { return indirect_lobe(ltc_from_classic(table), frame_from_normal(n)); }

// virtual light and receiver, both ends
//   a.xyz  vector(0.3, 2)
//   b.xyz  direction
//   c.xyz  direction
//   d.x    range(0.5, 1.5)
//   d.y    range(-0.3, 0.3)
//   d.z    range(-0.3, 0.3)
//   d.w    range(0.6, 1.5)
// Values: 4
vec4 case_indirect_pair(CaseInput i) {
    vec3 n = case_xyz(i.b);
    vec3 light_n = case_xyz(i.c);
    IndirectLobe light = indirect_turned(case_indirect_lobe(light_n, i.d));
    IndirectPair pair = indirect_pair(case_xyz(i.a), n, case_indirect_lobe(n, i.d), -light_n, light);
    return vec4(pair.to_diffuse, pair.to_glossy, pair.from_diffuse, pair.from_glossy);
}

// virtual light: one end, what culling keeps
//   a.xyz  vector(0.3, 2)
//   b.xyz  direction
//   c.x    range(0.5, 2)
//   c.y    range(0.1, 0.9)
//   c.z    range(0.01, 0.1)
//   d.x    range(0.5, 1.5)
//   d.y    range(-0.3, 0.3)
//   d.z    range(-0.3, 0.3)
//   d.w    range(0.6, 1.5)
// Values: 3
vec4 case_indirect_point_light(CaseInput i) {
    vec3 v = case_xyz(i.a);
    vec3 n = case_xyz(i.b);
    IndirectLobe lobe = case_indirect_lobe(n, i.d);
    real diffuse = indirect_diffuse_half(n, v, dot(v, v), i.c.z);
    return vec4(indirect_point_light(lobe, v), diffuse, indirect_kept(diffuse, i.c.x, i.c.y), 0.0);
}

// virtual light: its spheroid
//   a.xyz  vector(0.3, 2)
//   b.xyz  direction
//   c.x    range(0.5, 2)
//   d.x    range(0.5, 1.5)
//   d.y    range(-0.3, 0.3)
//   d.z    range(-0.3, 0.3)
//   d.w    range(0.6, 1.5)
// Values: 4
vec4 case_indirect_spheroid(CaseInput i) {
    vec3 q = indirect_spheroid(case_indirect_lobe(case_xyz(i.b), i.d), case_xyz(i.a), i.c.x);
    return vec4(q.x, q.y, q.z, indirect_largest_stretch(ltc_from_classic(i.d)));
}

// one end of a pair on GGX microsurfaces
//   a.xyz  upper_direction
//   b.xyz  upper_direction
//   c.xyz  vector(0.5, 2)
//   c.w    range(0.2, 1)
// Values: 3
vec4 case_indirect_ggx(CaseInput i) {
    vec3 l = case_xyz(i.a);
    vec3 v = case_xyz(i.c);
    IndirectGgx end = indirect_ggx(frame_from_normal(vec3(0.0, 0.0, 1.0)), case_xyz(i.b), i.c.w, l);
    return vec4(end.lobe, end.grazing, indirect_grazing(l, v, dot(v, v)), 0.0);
}
