// Parity cases of ggx_cubature.glsl; tests/parity/case.glsl says how to write one.
// Needs: conic_cases.glsl, polygon.glsl
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.

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
