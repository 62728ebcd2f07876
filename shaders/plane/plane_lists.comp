// Lists of the plane: the blockers that matter to a round light in a tile, found by the event lines of each pair
// (source/plane/frame/events/event_pack.cpp). A thread handles a tile and a light.
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "plane_layout.glsl"

layout(local_size_x = 64) in;
layout(std430, binding = 0) readonly buffer Lists { uint lists[]; };
layout(std430, binding = 1) readonly buffer Pairs { uint pairs[]; };
layout(std430, binding = 4) writeonly buffer Masks { uint masks[]; };
layout(push_constant) uniform Push { uint first_disk; };

float number(uint at) { return uintBitsToFloat(lists[at]); }

#include "plane_mask.glsl"

void main() {
    uint disk = lists[kDiskHeader] + (first_disk + gl_WorkGroupID.y) * uint(kDisk);
    uint cell = gl_WorkGroupID.x * 64u + gl_LocalInvocationID.x;
    if (cell >= lists[disk + uint(kDiskTiles) + 2u] * lists[disk + uint(kDiskTiles) + 3u]) return;
    vec2 p = tile_from_disk(disk, cell);
    float reach = reach_of_tile();

    uint first = lists[disk + uint(kDiskFirstPair)];
    uint count = lists[disk + uint(kDiskPairs)];
    uint words = (count + 31u) / 32u;
    uint to = lists[disk + uint(kDiskMasks)] + cell * (words + 1u);
    bool hidden = false;
    uint bits = 0u;
    for (uint i = 0u; i < count; i++) {
        uint pair = (first + i) * uint(kPair);
        if (pair_touches(pair, p, reach)) bits |= 1u << (i & 31u);
        hidden = hidden || pair_hides(pair, p, reach);
        if ((i & 31u) == 31u || i + 1u == count) {
            masks[to + 1u + i / 32u] = bits;
            bits = 0u;
        }
    }
    masks[to] = hidden ? 1u : 0u;
}
