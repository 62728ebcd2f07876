// Parity cases of indirect.glsl; tests/parity/case.glsl says how to write one.
// Needs: frame.glsl
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.

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

// Error analysis cannot tell on which side of the lobe's horizon a corner lies.

// virtual light as a quad
//   a.xyz  vector(0.5, 2)
//   b.xyz  direction
//   c.xyz  vector(0.05, 0.2)
//   d.x    range(0.5, 1.5)
//   d.y    range(-0.3, 0.3)
//   d.z    range(-0.3, 0.3)
//   d.w    range(0.6, 1.5)
// Values: 2
// Bound: statistical
vec4 case_indirect_quad(CaseInput i) {
    IndirectWay way = indirect_way(case_xyz(i.a), vec3(0.0, 0.0, 0.0));
    IndirectQuad quad;
    quad.normal = way.v * way.inverse;
    quad.edge_x = case_xyz(i.c);
    quad.edge_y = cross(quad.normal, quad.edge_x);
    quad.inverse_area = 1.0;
    quad.size2 = dot(quad.edge_x, quad.edge_x);
    IndirectLobe lobe = case_indirect_lobe(case_xyz(i.b), i.d);
    real matters = select(indirect_quad_matters(lobe, quad, way, 1.0, 1.0), 1.0, 0.0);
    return vec4(indirect_quad_half(lobe, quad, way, 0.01, 1.0), matters * indirect_sharp(), 0.0, 0.0);
}

// Error analysis cannot tell on which side of a condition two surfaces lie.

// filter of the bounce: surfaces that are alike, and means
//   a.xyz  direction
//   b.xyz  direction
//   c.xyz  vector(0.1, 1)
//   a.w    range(0.1, 1)
//   b.w    range(0.1, 1)
// Values: 4
// Bound: statistical
vec4 case_indirect_filter(CaseInput i) {
    mask same = indirect_same_surface(indirect_alike(), case_xyz(i.a), case_xyz(i.b), case_xyz(i.c));
    mask loosely = indirect_same_surface(indirect_alike_loosely(), case_xyz(i.a), case_xyz(i.b), case_xyz(i.c));
    vec3 mean = indirect_filtered(case_xyz(i.c), i.a.w, case_xyz(i.b), i.b.w);
    return vec4(mean.x, mean.y, mean.z, select(same, 2.0, select(loosely, 1.0, 0.0)));
}

// Error analysis cannot tell whether a region that just touches a box reaches it.

// virtual light: whether its regions reach a box
//   a.xyz  vector(0.5, 5)
//   b.xyz  direction
//   c.x    range(0.1, 1)
//   c.y    range(0.1, 1)
//   c.z    range(0.1, 1)
// Values: 2
// Bound: statistical
vec4 case_indirect_reaches(CaseInput i) {
    IndirectBox box;
    box.center = vec3(0.0, 0.0, 0.0);
    box.extent = case_xyz(i.c);
    box.normal = vec3(0.0, 0.0, 1.0);
    box.turn = vec3(0.5, 0.5, 0.5);
    vec3 at = case_xyz(i.a);
    vec3 n = case_xyz(i.b);
    mask egg = indirect_egg_reaches(box, at, n, 3.0, dot(n, at));
    mat3 frame = frame_from_normal(n);
    vec3 x = transform(frame, vec3(0.5, 0.0, 0.0));
    vec3 y = transform(frame, vec3(0.0, 0.5, 0.0));
    vec3 z = transform(frame, vec3(0.0, 0.0, 0.7));
    mask spheroid = indirect_spheroid_reaches(box, x, y, z, vec3(dot(x, at), dot(y, at), dot(z, at) - 0.85), n, dot(n, at));
    return vec4(select(egg, 1.0, 0.0), select(spheroid, 1.0, 0.0), 0.0, 0.0);
}
