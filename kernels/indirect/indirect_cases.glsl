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
