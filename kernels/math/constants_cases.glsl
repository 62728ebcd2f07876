// Parity cases of constants.glsl; tests/parity/case.glsl says how to write one.
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.

// constants: pi, its inverses, masks; times a number
//   a.x    range(1, 2)
// Error: relative
// Values: 4
vec4 case_constants(CaseInput i) {
    vec4 r = vec4(pi(), inverse_pi(), inverse_two_pi(), select(mask_all() && !mask_none(), 1.0, 2.0));
    return r * i.a.x;
}

// constants: floors of divisors; times a number
//   a.x    range(1, 2)
// Error: relative
// Values: 3
vec4 case_constants_smallest(CaseInput i) {
    return vec4(smallest_square(), smallest_length(), smallest_divisor(), 0.0) * i.a.x;
}
