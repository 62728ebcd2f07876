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
