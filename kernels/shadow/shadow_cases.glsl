// Parity cases of shadow.glsl; tests/parity/case.glsl says how to write one.
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.

// shadow, the projection of an edge's cut, and the side of a plane
//   a.x  range(-1, 1)
//   a.y  range(-1, 1)
//   a.z  range(-1, -0.2)
//   b.x  range(-1, 1)
//   b.y  range(-1, 1)
//   b.z  range(0.2, 1)
//   c.x  range(-0.1, 0.1)
//   c.z  range(0.5, 2)
// Values: 4
vec4 case_shadow_project(CaseInput i) {
    vec3 cut = shadow_cut(case_xyz(i.a), case_xyz(i.b), i.c.x);
    vec3 h = shadow_project(vec3(0.2, 0.3, i.c.z), vec3(i.c.x, i.b.x, i.c.z), cut);
    return vec4(h.x, h.y, h.z, shadow_facing(vec3(0.0, 0.0, 1.0), i.b.z, case_xyz(i.a)));
}

// shadow, an edge clipped to the box: the sides that clip it, and the part that one side leaves
//   a.x  range(-0.4, 0.4)
//   a.y  range(-0.4, 0.4)
//   b.x  range(1.5, 3)
//   b.y  range(-0.4, 0.4)
//   c.x  range(0.5, 1)
//   c.y  range(0.5, 1)
// Values: 4
vec4 case_shadow_clip(CaseInput i) {
    ShadowSegment s = shadow_clip(vec3(i.a.x, i.a.y, 1.0), vec3(i.b.x, i.b.y, 1.0), vec2(i.c.x, i.c.y));
    ShadowSpan span;
    span.t0 = 0.0;
    span.t1 = 1.0;
    span.sides = vec2(0.0, 0.0);
    span.inside = span.t0 < 1.0;
    span = shadow_clip_side(span, i.c.x - i.a.x, i.c.x - i.b.x, 2.0);
    return vec4(s.sides.x, select(s.inside, s.sides.y, 0.0), span.t0, span.t1);
}
