// Declarations for all parity cases. A case is a kernel as a function of sixteen reals, so that one harness runs it in every language.
//
// How to add a case: write a function `vec4 case_NAME(CaseInput i)` in the dialect, in kernels/FOLDER/x_cases.glsl beside the
// kernel's x.glsl. Its comment's first line is the row's title in docs/measured/accuracy.md; the lines after it say where the inputs come from,
//     //   a.xyz  direction                 members of the input, then a domain (below); members not named are 0
//   then `Error: relative` or `Error: absolute` (the default), `Values: N`, how many of the four results count, and
//   `Bound: statistical` with its reason above the case, where running error analysis finds no bound (shaken.h).
// No other step is needed: make_cases.py reads these files and writes the C++ table and the shaders' entry points. A file of cases
// automatically has x.glsl, all that x.glsl needs and this file. It names other files that it calls in a Needs: line, including files of
// cases. A test fails while a kernel function is reached by no case.
//
// Domains (made in double with a fixed seed, rounded to float, the same for every target):
//   direction, upper_direction     unit vectors, uniform on the sphere or on its upper half
//   vector(low, high)              a direction times a length whose logarithm is uniform
//   range(low, high)               uniform
//   log(low, high)                 positive, its logarithm uniform
//   signed_log(low, high)          the same with either sign
//   integer(low, high)             whole numbers
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.

// The input of a case.
struct CaseInput {
    vec4 a;
    vec4 b;
    vec4 c;
    vec4 d;
};

// The first three numbers of four.
vec3 case_xyz(vec4 v) { return vec3(v.x, v.y, v.z); }

// A result of three numbers.
vec4 case_of_vec3(vec3 v) { return vec4(v.x, v.y, v.z, 0.0); }

// A result of one number.
vec4 case_of_real(real x) { return vec4(x, 0.0, 0.0, 0.0); }
