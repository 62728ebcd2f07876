// Parity cases of horizon_clip.glsl; tests/parity/case.glsl says how to write one.
// Needs: polygon_cases.glsl complex.glsl
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.

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

// horizon clip, the middle of an arc, and whether it is wide
//   a.x    range(-3, 3)
//   a.y    range(0.5, 3)
// Values: 3
vec4 case_horizon_arc_middle(CaseInput i) {
    vec2 a = complex_unit(i.a.x);
    vec2 b = complex_product(a, complex_unit(i.a.y));
    vec3 start = vec3(a.x, a.y, 0.0);
    vec3 end = vec3(b.x, b.y, 0.0);
    vec3 middle = horizon_arc_middle(start, end, 1.0);
    return vec4(middle.x, middle.y, select(horizon_arc_wide(start, end), 1.0, 0.0), 0.0);
}
