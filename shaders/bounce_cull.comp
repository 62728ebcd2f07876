// Finds the virtual lights that can matter to a tile's blocks. A thread tests 32 of the tile's set against the tile, then against its
// blocks. The tests are those of source/render/bounce/cull_pack.cpp.
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "bounce.glsl"

const float kBallCenter = 0.46;
const float kBallRadius = 0.628;
const float kBallAlong = 0.54;

struct Box {
    vec3 center;
    vec3 extent;
    vec3 normal;
    vec3 turn;
};
Box box_at(int number) {
    int at = number * kBox;
    return Box(boxes[at].xyz, boxes[at + 1].xyz, boxes[at + 2].xyz, boxes[at + 3].xyz);
}

float distance2(vec3 p, Box box) {
    vec3 d = max(abs(p - box.center) - box.extent, vec3(0.0));
    return dot(d, d);
}

bool egg_reaches(int light, Box box) {
    vec3 at = lights[light].xyz;
    vec3 n = -lights[light + 1].xyz;
    float range = lights[light + 5].x;
    float height = dot(n, box.center) + dot(abs(n), box.extent) - lights[light + 5].y;
    vec3 v = at - box.center;
    float above = dot(box.normal, v) + dot(abs(box.normal), box.extent) + dot(box.turn, abs(v) + box.extent);
    if (!(height > 0.0 && above > 0.0)) return false;
    float d2 = distance2(at, box);
    float range2 = range * range;
    float reach = range2 * height;
    float ball2 = distance2(at + n * (range * kBallCenter), box);
    return d2 * d2 * d2 <= reach * reach && ball2 <= range2 * (kBallRadius * kBallRadius);
}

bool spheroid_reaches(int light, Box box) {
    vec4 x = lights[light + kSpheroid];
    vec4 y = lights[light + kSpheroid + 1];
    vec4 z = lights[light + kSpheroid + 2];
    vec3 n = -lights[light + 4].xyz;
    vec3 q = vec3(x.w - dot(x.xyz, box.center), y.w - dot(y.xyz, box.center), z.w - dot(z.xyz, box.center));
    float wz = kBallAlong * q.z + kBallCenter;
    float deep = kBallAlong * dot(abs(z.xyz), box.extent);
    float highest = wz + deep + 1.0e-6 * (abs(z.w) + 1.0);  // plus the rounding of a difference
    if (!(highest > 0.0 && dot(n, box.center) + dot(abs(n), box.extent) > lights[light + 6].w)) return false;
    float q2 = dot(q, q);
    float gap = q2 - dot(abs(x.xyz * q.x + y.xyz * q.y + z.xyz * q.z), box.extent);
    vec3 least = vec3(kBallRadius * max(abs(q.x) - dot(abs(x.xyz), box.extent), 0.0),
                      kBallRadius * max(abs(q.y) - dot(abs(y.xyz), box.extent), 0.0), max(abs(wz) - deep, 0.0));
    float w2 = dot(least, least);
    return !(gap > 0.0 && gap * gap > q2) && w2 * w2 * w2 <= highest * highest;
}

bool reaches(int kind, int first, int i, Box box) {
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
        Box box = box_at(tile_box);
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
