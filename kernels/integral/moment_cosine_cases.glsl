// Parity cases of moment_cosine.glsl; tests/parity/case.glsl says how to write one.
// Needs: horizon_clip_cases.glsl, moment_cases.glsl, polygon_cases.glsl
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.

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
        real front = moment_series_front(edge, series);
        real share = moment_foreshortened_share(edge, pieces.first, pieces.last, r, front, moment_cosine_front(edge, i.a.w, 0));
        sum = sum + select(pieces.exists, share, 0.0);
    }
    return case_of_real(sum);
}

// double-axis moment, its integrands by quadrature, and the power of exponent 0
//   a.x    range(0.3, 1)
//   a.y    range(0.2, 1)
//   a.z    range(0.2, 1)
//   a.w    log(2, 50)
// Values: 3
vec4 case_foreshortened_front(CaseInput i) {
    MomentEdge edge = case_front_edge(i);
    MomentIntegrands front = moment_foreshortened_front(edge, i.a.w, 0);
    return vec4(front.moment, front.power, moment_foreshortened_front(edge, 0.0, 1).power, 0.0);
}
