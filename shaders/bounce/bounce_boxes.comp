// Computes the bounds of the surfaces of a block (step 0), and of a tile's blocks (step 1), a thread each.
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "bounce.glsl"

void main() {
    int tiles = parameter(kTilesX) * parameter(kTilesY);
    int sets = parameter(kStride) * parameter(kStride);
    int of_blocks = sets * tiles * kBlocksOfTile;
    int number = int((gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * 64u + gl_LocalInvocationID.x);
    if (number >= (step == 0u ? of_blocks : sets * tiles)) return;
    vec3 low = vec3(1.0e30);
    vec3 high = vec3(-1.0e30);
    vec3 normal_low = vec3(1.0e30);
    vec3 normal_high = vec3(-1.0e30);
    for (int i = 0; i < 16; i++) {
        if (step == 0u) {
            int tile = number / kBlocksOfTile;
            ivec2 pixel = pixel_of(tile / tiles, tile % tiles, number % kBlocksOfTile * 16 + i);
            if (pixel.x < 0) continue;
            vec3 n = normals[index_of(pixel)].xyz;
            if (n == vec3(0.0)) continue;
            vec3 p = positions[index_of(pixel)].xyz;
            low = min(low, p);
            high = max(high, p);
            normal_low = min(normal_low, n);
            normal_high = max(normal_high, n);
        } else {
            int from = (number * kBlocksOfTile + i) * kBox;
            if (boxes[from].w == 1.0) continue;
            low = min(low, boxes[from].xyz - boxes[from + 1].xyz);
            high = max(high, boxes[from].xyz + boxes[from + 1].xyz);
            normal_low = min(normal_low, boxes[from + 2].xyz - boxes[from + 3].xyz);
            normal_high = max(normal_high, boxes[from + 2].xyz + boxes[from + 3].xyz);
        }
    }
    int to = (step == 0u ? number : of_blocks + number) * kBox;
    if (!(low.x <= high.x)) {
        boxes[to] = vec4(0.0, 0.0, 0.0, 1.0);
        return;
    }
    // The boxes are slightly wider than the points: the bounds are computed in float.
    vec3 center = 0.5 * (high + low);
    float slack = 1.0e-6 * dot(abs(center), vec3(1.0));
    boxes[to] = vec4(center, 0.0);
    boxes[to + 1] = vec4(0.5 * (high - low) + slack, 0.0);
    boxes[to + 2] = vec4(0.5 * (normal_high + normal_low), 0.0);
    boxes[to + 3] = vec4(0.5 * (normal_high - normal_low) + 1.0e-6, 0.0);
}
