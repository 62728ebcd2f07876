// Parity cases of moment_series.glsl; tests/parity/case.glsl says how to write one.
// Needs: horizon_clip_cases.glsl, polygon_cases.glsl
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.

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
