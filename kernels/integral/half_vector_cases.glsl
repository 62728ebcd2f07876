// Parity cases of half_vector.glsl; tests/parity/case.glsl says how to write one.
// Needs: conic_cases.glsl
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.

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
// Bound: statistical
vec4 case_half_vector_splits(CaseInput i) {
    ConicArc arc = case_arc(i);
    return vec4(half_vector_split_uniform(arc, i.d.w), half_vector_split_pole_mapped(arc, i.d.w), 0.0, 0.0);
}

// half vector, nodes of the sliver between an arc and its image, and their places
//   a.x    range(-0.5, -0.1)
//   a.y    range(0.6, 1)
//   b.x    range(0.1, 0.5)
//   b.y    range(0.6, 1)
//   c.x    range(-0.9, 0.9)
//   c.y    range(-1.5, -0.1)
//   c.z    range(0.1, 1.5)
//   d.xyz  direction
//   d.w    range(0.05, 0.95)
// Values: 4
vec4 case_half_vector_between(CaseInput i) {
    ConicArc arc = case_arc(i);
    GgxView view = ggx_view(vec3(0.48, 0.36, 0.8), 0.5, 0.7);
    HalfVectorWalk walk = half_vector_next(half_vector_begin(view, arc), view, arc, arc.end);
    HalfVectorNode node = half_vector_between(view, arc, walk.first, walk.last, walk.a, walk.b, vec2(i.d.w, 1.0));
    HalfVectorNode second = half_vector_node(walk, view, arc, 1);
    node.h = node.h + second.h;
    node.solid_angle = node.solid_angle + second.solid_angle;
    return vec4(node.h.x, node.h.y, node.h.z, node.solid_angle);
}

// half vector, lobes at one: Blinn-Phong, Beckmann, and the length of GGX's vector
//   a.xyz  upper_direction
//   b.xyz  upper_direction
//   a.w    log(2, 200)
//   b.w    range(0.3, 1)
//   c.w    range(0.3, 1)
// Values: 3
vec4 case_lobes_at_half_vector(CaseInput i) {
    GgxView view = ggx_view(case_xyz(i.b), i.b.w, i.c.w);
    vec3 h = case_xyz(i.a);
    vec3 e = ggx_at_half_vector(view, h);
    return vec4(blinn_phong_at_half_vector(h, view.v, i.a.w), beckmann_at_half_vector(view, h), sqrt(dot(e, e)), 0.0);
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
