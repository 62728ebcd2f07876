// Finds the first triangle that each ray of a shadow map meets, a thread a ray.
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "../shadow/ray_layout.glsl"

layout(local_size_x = 64) in;
layout(std430, binding = 0) readonly buffer Rays { vec4 rays[]; };
layout(std430, binding = 1) writeonly buffer Met { uint met[]; };
layout(std430, binding = 2) readonly buffer Hierarchy { uvec4 hierarchy[]; };
layout(push_constant) uniform Push { uint count; };

#include "../shadow/ray_hierarchy.glsl"

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= count) return;
    vec4 from = rays[i * uint(kMapRay)];
    vec3 along = rays[i * uint(kMapRay) + 1u].xyz;
    met[i] = dot(along, along) > 0.0 ? met_along(ray_of(from.xyz, along), from.w, 3.0e38, false) : uint(kMeetsNothing);
}
