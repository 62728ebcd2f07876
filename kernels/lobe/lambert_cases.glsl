// Parity cases of lambert.glsl; tests/parity/case.glsl says how to write one.
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.

// Lambert radiance
//   a.x    range(0, 3.14159)
// Error: relative
vec4 case_lambert_radiance(CaseInput i) { return case_of_real(lambert_radiance(i.a.x)); }

// Lambert lobe
//   a.xyz  direction
// Error: relative
vec4 case_lambert_lobe(CaseInput i) { return case_of_real(lambert_lobe(case_xyz(i.a))); }

// Lambert lobe under a dielectric boundary
//   a.xyz  upper_direction
//   b.xyz  upper_direction
//   a.w    range(0, 1)
vec4 case_lambert_irradiance_below(CaseInput i) {
    return case_of_real(lambert_irradiance_below(case_xyz(i.a), case_xyz(i.b), i.a.w));
}
