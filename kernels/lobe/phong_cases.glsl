// Parity cases of phong.glsl; tests/parity/case.glsl says how to write one.
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.

// power of a cosine
//   a.x    range(0.9, 1)
//   a.y    log(1, 100)
// Error: relative
vec4 case_phong_power(CaseInput i) { return case_of_real(phong_power(i.a.x, i.a.y)); }

// Phong lobe about the mirrored view
//   a.xyz  upper_direction
//   b.xyz  upper_direction
//   a.w    log(1, 1000)
vec4 case_phong_lobe(CaseInput i) {
    return case_of_real(phong_lobe(case_xyz(i.a), phong_mirror(case_xyz(i.b)), i.a.w));
}

// Blinn-Phong distribution
//   a.xyz  upper_direction
//   a.w    log(1, 1000)
vec4 case_blinn_phong_distribution(CaseInput i) {
    return case_of_real(blinn_phong_distribution(case_xyz(i.a), i.a.w));
}
