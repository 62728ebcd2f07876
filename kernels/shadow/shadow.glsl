// Shadows: the projection of an occluder's edge to the plane of a light, in whole cells.
//
// Light frame: the origin is the centre of the light's bounding rectangle. x and y run along its sides. z points away from the shading
// point, which is at (eye.x, eye.y, -eye.z) with eye.z > 0. There are 2^22 cells from the middle of the box to a side. From here on whole
// numbers decide everything. See docs/shadows.md.
// Needs: constants.glsl
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.

// Number of cells from the middle of the box to a side: products of two differences are then exact in double and in 64 bits.
real shadow_cells() { return 4194304.0; }

// Side of a triangle's plane on which a point lies: 1 the front, -1 the back and the plane itself.
//
//   normal, offset  of the plane dot(normal, x) = offset; any length
real shadow_facing(vec3 normal, real offset, vec3 p) {
    return select(dot(normal, p) - offset > 0.0, 1.0, -1.0);
}

// Intersection of the plane z = height with the edge from a to b, whose ends lie on different sides of it.
//
// All callers pass the ends in the same order, and so get the same bits.
vec3 shadow_cut(vec3 a, vec3 b, real height) {
    real t = clamp((height - a.z) / (b.z - a.z), 0.0, 1.0);
    return vec3(a.x + t * (b.x - a.x), a.y + t * (b.y - a.y), height);
}

// Homogeneous projection of a vertex from the eye to the light's plane: at (x / z, y / z), in front of the eye where z > 0.
//
// Each coordinate takes two products: exact to a rounding near the light, where most shadows originate.
//
//   eye    (x, y, -z) of the point in the light's frame
//   shift  (0, 0, eye.z); of vertices that are relative to an anchor a, with the point p relative to it:
//          (p.x a.z - a.x p.z, p.y a.z - a.y p.z, -p.z)
vec3 shadow_project(vec3 eye, vec3 shift, vec3 v) {
    return vec3(v.x * eye.z + eye.x * v.z + shift.x, v.y * eye.z + eye.y * v.z + shift.y, v.z + shift.z);
}

// An edge clipped to the box, in cells.
//   start, end  whole numbers; an end that was clipped lies exactly on its side
//   sides       x of the start, y of the end: 0 not clipped, 1 left, 2 right, 3 bottom, 4 top
//   inside      true if a part of it is left
struct ShadowSegment {
    vec2 start;
    vec2 end;
    vec2 sides;
    mask inside;
};

// The state of a clip: parameters of the remaining part, and the sides that determined them.
struct ShadowSpan {
    real t0;
    real t1;
    vec2 sides;
    mask inside;
};

// Clips a span by one side.
//
//   da, db   distances of the edge's ends from the side, positive inside
//   side     its number
ShadowSpan shadow_clip_side(ShadowSpan span, real da, real db, real side) {
    ShadowSpan next = span;
    mask a_out = da <= 0.0;
    mask b_out = db <= 0.0;
    mask crosses = (a_out && !b_out) || (b_out && !a_out);
    real t = da / select(crosses, da - db, 1.0);
    mask later = a_out && !b_out && t >= span.t0;
    mask earlier = b_out && !a_out && t <= span.t1;
    next.t0 = select(later, t, span.t0);
    next.t1 = select(earlier, t, span.t1);
    next.sides = vec2(select(later, side, span.sides.x), select(earlier, side, span.sides.y));
    next.inside = span.inside && !(a_out && b_out);
    return next;
}

// One end of a clipped edge in cells.
//
//   h        homogeneous, inside the box or on its side
//   side     0: round; else the coordinate of that side is exact
vec2 shadow_cell(vec3 h, vec2 box, real side) {
    real cells = shadow_cells();
    real inverse = cells / max(h.z, smallest_divisor());
    real x = clamp(floor(h.x / box.x * inverse + 0.5), -cells, cells);
    real y = clamp(floor(h.y / box.y * inverse + 0.5), -cells, cells);
    x = select(side > 0.5 && side < 1.5, -cells, select(side > 1.5 && side < 2.5, cells, x));
    y = select(side > 2.5 && side < 3.5, -cells, select(side > 3.5, cells, y));
    return vec2(x, y);
}

// The part of an edge that the eye sees in front of the box |x| <= box.x, |y| <= box.y.
//
//   a, b     shadow_project of its ends
//
// An end is inside iff it is strictly inside of all four sides, which implies that it is in front of the eye: no near plane.
// Source: Liang, Barsky, "A new concept and method for line clipping", 1984, in homogeneous coordinates.
ShadowSegment shadow_clip(vec3 a, vec3 b, vec2 box) {
    ShadowSpan span;
    span.t0 = 0.0;
    span.t1 = 1.0;
    span.sides = vec2(0.0, 0.0);
    span.inside = span.t0 < 1.0;
    span = shadow_clip_side(span, box.x * a.z + a.x, box.x * b.z + b.x, 1.0);
    span = shadow_clip_side(span, box.x * a.z - a.x, box.x * b.z - b.x, 2.0);
    span = shadow_clip_side(span, box.y * a.z + a.y, box.y * b.z + b.y, 3.0);
    span = shadow_clip_side(span, box.y * a.z - a.y, box.y * b.z - b.y, 4.0);
    vec3 d = b - a;
    ShadowSegment segment;
    // An end inside is not lost if the other lies a rounding beyond its side; otherwise its chain would break.
    segment.inside = span.inside && (span.t0 < span.t1 || span.sides.x < 0.5 || span.sides.y < 0.5);
    segment.sides = span.sides;
    segment.start = shadow_cell(select(span.sides.x > 0.5, a + d * span.t0, a), box, span.sides.x);
    segment.end = shadow_cell(select(span.sides.y > 0.5, a + d * span.t1, b), box, span.sides.y);
    return segment;
}
