// Parity cases of moment_arvo.glsl; tests/parity/case.glsl says how to write one.
// Needs: horizon_clip_cases.glsl, polygon_cases.glsl
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.

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
