// Parity cases of moment_peak_fits.glsl; tests/parity/case.glsl says how to write one.
// Needs: horizon_clip_cases.glsl, moment_cases.glsl, polygon_cases.glsl
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.

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

// The blends of two peaks are ill-conditioned where their tails nearly meet, and the ellipsoid where it is nearly flat:
// the two below keep to edges some way from the axis, the ellipsoid to sharp lobes, and its bound is the spread all the same.

// Phong pearson fit, one edge: the form of even exponents and that of the others
//   a.x    range(0.4, 0.8)
//   a.y    range(0.2, 1)
//   a.z    range(0.2, 1)
//   a.w    range(5, 20)
// Values: 2
// Bound: statistical
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
