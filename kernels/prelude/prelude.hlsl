// The kernel dialect in HLSL. Goes before the kernels; docs/dialect.md is the manual.
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.
#define real float
#define mask bool
#define vec2 float2
#define vec3 float3
#define vec4 float4
#define mat3 float3x3
#define inversesqrt rsqrt
#define select steradian_select  // HLSL 2021 has a select of its own, with other overloads

// Bits of the mantissa: kernels choose their polynomials by it.
int real_digits() { return 24; }

// A lane is all there is.
bool any_lane(bool m) { return m; }
bool all_lanes(bool m) { return m; }

float steradian_select(bool m, float a, float b) { return m ? a : b; }
float2 steradian_select(bool m, float2 a, float2 b) { return m ? a : b; }
float3 steradian_select(bool m, float3 a, float3 b) { return m ? a : b; }
float4 steradian_select(bool m, float4 a, float4 b) { return m ? a : b; }

float2 xy(float3 v) { return v.xy; }

// float3x3(c0, c1, c2) makes rows of what GLSL makes columns. Nothing else looks inside, so that m[0] is the first
// column of the dialect here too.
float3 transform(float3x3 m, float3 v) { return m[0] * v.x + m[1] * v.y + m[2] * v.z; }
float3 transform_transposed(float3x3 m, float3 v) { return float3(dot(m[0], v), dot(m[1], v), dot(m[2], v)); }
