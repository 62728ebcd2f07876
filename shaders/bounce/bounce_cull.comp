// Finds the virtual lights that can matter to a tile's blocks. A thread tests 32 of the tile's set against the tile, then against its
// blocks.
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "bounce.glsl"
#include "bounce_kernels.glsl"

IndirectBox box_at(int number) {
    int at = number * kBox;
    return IndirectBox(boxes[at].xyz, boxes[at + 1].xyz, boxes[at + 2].xyz, boxes[at + 3].xyz);
}

bool egg_reaches(int light, IndirectBox box) {
    return indirect_egg_reaches(box, lights[light].xyz, -lights[light + 1].xyz, lights[light + 5].x, lights[light + 5].y);
}

bool spheroid_reaches(int light, IndirectBox box) {
    vec4 x = lights[light + kSpheroid];
    vec4 y = lights[light + kSpheroid + 1];
    vec4 z = lights[light + kSpheroid + 2];
    return indirect_spheroid_reaches(box, x.xyz, y.xyz, z.xyz, vec3(x.w, y.w, z.w), -lights[light + 4].xyz, lights[light + 6].w);
}

bool reaches(int kind, int first, int i, IndirectBox box) {
    if (kind == 0) return egg_reaches(first + i * kDiffuse, box);
    return spheroid_reaches(first + i * kGlossy, box);
}

void main() {
    int words = parameter(kMaskWords);
    int tiles = parameter(kTilesX) * parameter(kTilesY);
    int all_tiles = parameter(kStride) * parameter(kStride) * tiles;
    int number = int((gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * 64u + gl_LocalInvocationID.x);
    if (number >= all_tiles * words) return;
    int tile = number / words;
    int word = number % words;
    int set = kSets + tile / tiles * kSet;
    int tile_box = all_tiles * kBlocksOfTile + tile;
    bool empty = boxes[tile_box * kBox].w == 1.0;
    for (int kind = 0; kind < 2; kind++) {
        int first = parameter(set + 2 * kind);
        int count = empty ? 0 : clamp(parameter(set + 2 * kind + 1) - 32 * word, 0, 32);
        IndirectBox box = box_at(tile_box);
        uint near = 0u;
        for (int i = 0; i < count; i++)
            if (reaches(kind, first, 32 * word + i, box)) near |= 1u << i;
        for (int block = 0; block < kBlocksOfTile; block++) {
            int at = tile * kBlocksOfTile + block;
            uint last = 0u;
            uint left = boxes[at * kBox].w == 1.0 ? 0u : near;
            if (left != 0u) box = box_at(at);
            while (left != 0u) {
                int i = findLSB(left);
                left &= left - 1u;
                if (reaches(kind, first, 32 * word + i, box)) last |= 1u << i;
            }
            masks[(at * 2 + kind) * words + word] = last;
        }
    }
}
