// Parity cases of microfacet.glsl; tests/parity/case.glsl says how to write one.
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.

// half vector
//   a.xyz  upper_direction
//   b.xyz  upper_direction
// Values: 3
vec4 case_microfacet_half_vector(CaseInput i) {
    return case_of_vec3(microfacet_half_vector(case_xyz(i.a), case_xyz(i.b)));
}

// GGX distribution
//   a.xyz  upper_direction
//   b.x    log(0.01, 1)
//   b.y    log(0.01, 1)
// Error: relative
vec4 case_ggx_distribution(CaseInput i) {
    return case_of_real(ggx_distribution(case_xyz(i.a), i.b.x, i.b.y));
}

// GGX shadowing
//   a.xyz  direction
//   b.xyz  direction
//   c.x    log(0.0001, 1)
//   c.y    log(0.0001, 1)
// Error: relative
vec4 case_ggx_shadowing(CaseInput i) {
    return case_of_real(ggx_shadowing(case_xyz(i.a), case_xyz(i.b), i.c.x, i.c.y));
}

// Schlick's Fresnel
//   a.x    range(0, 1)
//   a.y    range(0, 1)
//   a.z    range(0, 1)
vec4 case_fresnel_schlick(CaseInput i) { return case_of_real(fresnel_schlick(i.a.x, i.a.y, i.a.z)); }

// Beckmann distribution
//   a.xyz  upper_direction
//   b.x    log(0.1, 1)
//   b.y    log(0.1, 1)
vec4 case_beckmann_distribution(CaseInput i) {
    return case_of_real(beckmann_distribution(case_xyz(i.a), i.b.x, i.b.y));
}

// GGX lobe
//   a.xyz  direction
//   b.xyz  upper_direction
//   c.x    log(0.01, 1)
//   c.y    log(0.01, 1)
// Error: relative
vec4 case_ggx_lobe(CaseInput i) { return case_of_real(ggx_lobe(case_xyz(i.a), case_xyz(i.b), i.c.x, i.c.y)); }
