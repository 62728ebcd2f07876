// The kernel dialect in GLSL 4.50 and GLSL ES 3.00. Goes before the kernels and after #version; docs/dialect.md is
// the manual. The C++ side is include/steradian/real.h and vec.h.
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.
#ifdef GL_ES
precision highp float;
precision highp int;
#endif

#define real float
#define mask bool

// Bits of the mantissa: kernels choose their polynomials by it.
int real_digits() { return 24; }

// A lane is all there is.
bool any_lane(bool m) { return m; }
bool all_lanes(bool m) { return m; }

float select(bool m, float a, float b) { return m ? a : b; }
vec2 select(bool m, vec2 a, vec2 b) { return m ? a : b; }
vec3 select(bool m, vec3 a, vec3 b) { return m ? a : b; }
vec4 select(bool m, vec4 a, vec4 b) { return m ? a : b; }

vec2 xy(vec3 v) { return v.xy; }

// A mat3 is three columns, and these two are all that kernels do with it.
vec3 transform(mat3 m, vec3 v) { return m[0] * v.x + m[1] * v.y + m[2] * v.z; }
vec3 transform_transposed(mat3 m, vec3 v) { return vec3(dot(m[0], v), dot(m[1], v), dot(m[2], v)); }
