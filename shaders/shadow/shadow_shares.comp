// Adds the light that arrives from partly occluded round lights, after all lobes have summed it up: a thread a pixel.
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.
#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_ballot : require

#include "../layout.glsl"
#include "shadow_layout.glsl"

// Same declarations as in direct.glsl.
layout(local_size_x = 64) in;
layout(std430, binding = 4) readonly buffer Lists { uint lists[]; };
layout(std430, binding = 5) buffer Radiance { vec4 radiance[]; };
layout(std430, binding = 6) readonly buffer States { uint states[]; };
layout(std430, binding = 7) readonly buffer Parts { vec4 parts[]; };
layout(push_constant) uniform Push { uint first_entry; };

#include "../entry.glsl"

// Light that arrives from the light itself: the same fraction as from the polygon that replaces it. The fraction is at most 1, because
// approximate methods may find more for a part than for the whole.
float arriving(float light, float part, float polygon) { return polygon > 0.0 ? min(part / polygon, 1.0) * light : 0.0; }

void main() {
    Entry entry = entry_here();
    vec3 sum = vec3(0.0);
    for (uint i = 0u; i < entry.count; i++) {
        uint state = states[listed(entry.first + 2u * i + 1u) + entry.slot];
        if (state < uint(kSeesPart)) continue;
        int record = int(state) - kSeesPart;
        int ahead = int(parts[record + 3].w);
        if (ahead == 0) continue;
        vec3 part = parts[record + ahead - kPartSums].xyz;
        vec3 polygon = parts[record + ahead - kPartSums + 1].xyz;
        vec3 light = parts[record + ahead - kPartSums + 2].xyz;
        for (int c = 0; c < 3; c++) sum[c] += arriving(light[c], part[c], polygon[c]);
    }
    radiance[entry.tile * uint(kRadiance) + entry.slot].xyz += sum;
}
