// Tests if the rays to the places that shadow_parts.comp has found are free: a thread a point.
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.
#version 450
#extension GL_GOOGLE_include_directive : require

#include "ray_layout.glsl"
#include "shadow_layout.glsl"

layout(local_size_x = 64) in;
layout(std430, binding = 2) buffer Answers {
    uvec4 head[kShadowSpaces + 1];
    uvec4 answers[];
};
layout(std430, binding = 3) readonly buffer Hierarchy { uvec4 hierarchy[]; };
layout(push_constant) uniform Push { uint count; };

#include "ray_hierarchy.glsl"

void main() {
    uint number = gl_GlobalInvocationID.x;
    if (number >= count) return;
    uvec4 from = answers[uint(kShadowAnswer) * number];
    uvec4 to = answers[uint(kShadowAnswer) * number + 1u];
    if ((from.w & uint(kAskRay)) == 0u) return;
    int way = way_along(ray_of(uintBitsToFloat(from.xyz), uintBitsToFloat(to.xyz)));
    if (way == kNotKnown) return;
    answers[uint(kShadowAnswer) * number].w = from.w - uint(kAskRay);
    if (way == kBlocked) answers[uint(kShadowAnswer) * number + 1u].w = uint(kSeesNone);
}
