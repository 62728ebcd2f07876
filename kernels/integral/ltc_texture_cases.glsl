// Parity cases of ltc_texture.glsl; tests/parity/case.glsl says how to write one.
// Needs: ltc_cases.glsl, polygon_cases.glsl
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.

// textured light, irradiance vector under the LTC, quad across the horizon
//   a.xyz  vector(1, 5)
//   b.xyz  vector(0.1, 2)
//   c.xyz  vector(0.1, 2)
//   d.x    range(0.2, 1.5)
//   d.y    range(-1, 1)
//   d.z    range(-1, 1)
//   d.w    range(1.2, 3)
// Values: 3
vec4 case_ltc_texture_irradiance_vector(CaseInput i) {
    return case_of_vec3(ltc_texture_irradiance_vector(case_ltc_walk(i, ltc_from_classic(i.d)), case_walk_reversed(i)));
}

// The footprint about a direction on a plane that the lobe meets well.
LtcTextureFootprint case_footprint(CaseInput i, LtcMatrix m) {
    vec3 meets = polygon_direction(ltc_texture_transform_back(m, case_xyz(i.a)));
    vec3 normal = polygon_direction(meets + case_xyz(i.b) * 0.5);
    return ltc_texture_footprint(m, case_xyz(i.a) * i.a.w, normal, i.b.w);
}

// textured light, centre of the footprint
//   a.xyz  upper_direction
//   a.w    log(0.001, 1)
//   b.xyz  direction
//   b.w    range(0.5, 5)
//   d.x    range(0.5, 1.5)
//   d.y    range(-0.4, 0.4)
//   d.z    range(-0.4, 0.4)
//   d.w    range(1, 2)
// Values: 3
vec4 case_ltc_texture_center(CaseInput i) { return case_of_vec3(case_footprint(i, ltc_from_classic(i.d)).center); }

// textured light, plane of the footprint of a lobe and area of that of a diffuse surface
//   a.xyz  upper_direction
//   a.w    log(0.001, 1)
//   b.xyz  direction
//   b.w    range(0.5, 5)
//   d.x    range(0.5, 1.5)
//   d.y    range(-0.4, 0.4)
//   d.z    range(-0.4, 0.4)
//   d.w    range(1, 2)
// Values: 4
vec4 case_ltc_texture_footprint(CaseInput i) {
    LtcTextureFootprint lobe = case_footprint(i, ltc_from_classic(i.d));
    LtcTextureFootprint diffuse = case_footprint(i, ltc_texture_diffuse());
    vec3 plane = cross(lobe.axis_a, lobe.axis_b);
    vec3 area = cross(diffuse.axis_a, diffuse.axis_b);
    return vec4(plane.x, plane.y, plane.z, select(lobe.valid, sqrt(dot(area, area)), 0.0));
}

// textured light, a Gaussian from conjugate radii: long deviation and short one
//   a.x    range(1, 2)
//   a.y    range(-0.5, 0.5)
//   b.x    range(-0.5, 0.5)
//   b.y    range(0.2, 0.6)
//   c.x    range(0.2, 1)
//   c.y    range(0.2, 1)
// Values: 3
vec4 case_ltc_texture_gaussian(CaseInput i) {
    LtcTextureEllipse g = ltc_texture_gaussian(ltc_texture_axes(xy(case_xyz(i.a)), xy(case_xyz(i.b))), i.c.x, i.c.y);
    return vec4(g.major.x, g.major.y, g.minor, 0.0);
}

// textured light, where a Gaussian stands
//   a.x    range(0.1, 1)
//   a.y    range(0.1, 1)
//   a.z    range(0.05, 0.1)
//   b.x    range(-1, 1)
//   b.y    range(-1, 1)
//   c.x    range(-1, 1)
//   c.y    range(-1, 1)
//   d.x    range(0.2, 1)
//   d.y    range(-0.1, 0.1)
//   d.z    range(0.2, 1)
// Values: 2
vec4 case_ltc_texture_place(CaseInput i) {
    LtcTextureEllipse g;
    g.major = vec2(i.a.x, i.a.y);
    g.minor = i.a.z;
    vec2 r = ltc_texture_place(g, vec2(i.b.x, i.b.y), vec2(i.c.x, i.c.y), case_xyz(i.d));
    return vec4(r.x, r.y, 0.0, 0.0);
}
