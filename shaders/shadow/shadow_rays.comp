// Tests if the rays to the places that shadow_parts.comp has found are free, and writes the states of the points: a thread a point. If the
// parts or edges exceed their capacity, it stops the lighting that follows.
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.
#version 450
#extension GL_GOOGLE_include_directive : require

#include "ray_layout.glsl"
#include "shadow_layout.glsl"

layout(local_size_x = 64) in;
layout(std430, binding = 2) buffer Answers {
    uint parts_used;
    uint parts_room;
    uint left;
    uint found;
    uint lists;
    uint seen_at_once;
    uint edges_used;
    uint edges_room;
    uint others[4 * kAnswersHead - 8];
    uvec4 answers[];
};
layout(std430, binding = 3) readonly buffer Hierarchy { uvec4 hierarchy[]; };
layout(std430, binding = 4) writeonly buffer States { uint states[]; };
layout(std430, binding = 5) writeonly buffer Gates { uint gates[]; };
layout(push_constant) uniform Push { uint count; };

#include "ray_hierarchy.glsl"

void main() {
    uint number = gl_GlobalInvocationID.x;
    if (number >= count) return;
    uvec4 from = answers[uint(kShadowAnswer) * number];
    uvec4 to = answers[uint(kShadowAnswer) * number + 1u];
    uint sees = to.w;
    if ((from.w & uint(kAskRay)) != 0u) {
        uint met = met_along(ray_of(uintBitsToFloat(from.xyz), uintBitsToFloat(to.xyz)), 0.0, 1.0, true);
        if (met != uint(kMeetsNothing)) sees = uint(met == uint(kHostFinds) ? kAskHost : kSeesNone);
        answers[uint(kShadowAnswer) * number + 1u].w = sees;
        if (met == uint(kMeetsNothing)) states[from.w - uint(kAskRay)] = sees;
    }
    if (sees == uint(kAskHost)) atomicAdd(left, 1u);
    if (sees >= uint(kSeesPart)) atomicAdd(found, 1u);
    bool exceeds = parts_used > parts_room || edges_used > edges_room;
    for (uint i = exceeds ? number : uint(gates.length()); i < uint(gates.length()); i += count) gates[i] = 0u;
}
