// Lists of the plane: which blockers matter to a round light in a tile, a thread a tile and light, by the event lines of each pair
// (source/plane/frame/event_pack.cpp).
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

float line_at(uint line, vec2 p) {
    return uintBitsToFloat(pairs[line]) * p.x + (uintBitsToFloat(pairs[line + 1u]) * p.y - uintBitsToFloat(pairs[line + 2u]));
}

void main() {
    uint disk = lists[kDiskHeader] + (first_disk + gl_WorkGroupID.y) * uint(kDisk);
    uint across = lists[disk + uint(kDiskTiles) + 2u];
    uint cell = gl_WorkGroupID.x * 64u + gl_LocalInvocationID.x;
    if (cell >= across * lists[disk + uint(kDiskTiles) + 3u]) return;
    uint column = lists[disk + uint(kDiskTiles)] + cell % across;
    uint row = lists[disk + uint(kDiskTiles) + 1u] + cell / across;
    vec2 pixel_step = vec2(number(0u), number(1u));
    vec2 p = (vec2(float(column), float(row)) * 16.0 + 8.0) * pixel_step - vec2(number(disk + uint(kDiskCorner)), number(disk + uint(kDiskCorner) + 1u));
    float reach = 7.5 * max(pixel_step.x, pixel_step.y) + number(2u);

    uint first = lists[disk + uint(kDiskFirstPair)];
    uint count = lists[disk + uint(kDiskPairs)];
    uint words = (count + 31u) / 32u;
    uint to = lists[disk + uint(kDiskMasks)] + cell * (words + 1u);
    bool hidden = false;
    uint bits = 0u;
    for (uint i = 0u; i < count; i++) {
        uint pair = (first + i) * uint(kPair);
        float inner = min(line_at(pair, p), min(line_at(pair + 3u, p), line_at(pair + 6u, p)));
        float outer = min(line_at(pair + 9u, p), min(line_at(pair + 12u, p), line_at(pair + 15u, p)));
        if (inner >= -reach) bits |= 1u << (i & 31u);
        hidden = hidden || outer > reach;
        if ((i & 31u) == 31u || i + 1u == count) {
            masks[to + 1u + i / 32u] = bits;
            bits = 0u;
        }
    }
    masks[to] = hidden ? 1u : 0u;
}
