// Algorithm 2 of Xia et al. 2023, first pass: the lobe of each texel of the shadow map for the incoming light, a thread a texel.
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "bounce_layout.glsl"

layout(local_size_x = 64) in;
layout(std430, binding = 0) readonly buffer Texels { vec4 texels[]; };
layout(std430, binding = 1) buffer Lobes { vec4 lobes[]; };
layout(std430, binding = 2) readonly buffer Tables { vec4 tables[]; };
layout(push_constant) uniform Push { uint count; };

#include "bounce_kernels.glsl"
#include "bounce_lobe.glsl"

void main() {
    uint i = (gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * 64u + gl_LocalInvocationID.x;
    if (i >= count) return;
    vec4 surface = texels[i * uint(kTexel)];
    vec3 normal = surface.xyz;
    float alpha = surface.w;
    vec3 incoming = texels[i * uint(kTexel) + 1u].xyz;
    mat3 frame = frame_from_normal_and_view(normal, incoming);
    LtcMatrix matrix = lobe_matrix(normal, incoming, frame, alpha);
    IndirectLobe lobe = indirect_turned(indirect_lobe(matrix, frame));
    vec4 magnitude = look_up_magnitude(sqrt(alpha), dot(normal, incoming));
    uint to = i * uint(kLobe);
    lobes[to] = vec4(lobe.x, lobe.scale);
    lobes[to + 1u] = vec4(lobe.y, magnitude.x);
    lobes[to + 2u] = vec4(lobe.z, magnitude.y);
    lobes[to + 3u] = vec4(indirect_largest_stretch(matrix), 0.0, 0.0, 0.0);
}
