// Light in the plane: a thread a pixel, the lights of its tile's list in turn; what blockers leave of each is integrated in closed form.
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.
//
// A shader is one kind of lights: plane_disks.comp, plane_cuts.comp and plane_arcs.comp define which, as KIND. What stands here is what
// source/plane/frame's packs are; the parity of frames holds the two together.
#include "plane_layout.glsl"

layout(local_size_x = 64) in;
layout(std430, binding = 0) readonly buffer Lists { uint lists[]; };
layout(std430, binding = 1) readonly buffer Pairs { uint pairs[]; };
layout(std430, binding = 2) readonly buffer Vertices { vec4 vertices[]; };  // x and y, each as a float and what that leaves
layout(std430, binding = 3) buffer Sums { float sums[]; };
#if KIND == PLANE_LISTED
layout(std430, binding = 4) readonly buffer Masks { uint masks[]; };
#endif
layout(push_constant) uniform Push { uint first_job; };

#include "prelude/prelude.glsl"
#include "math/constants.glsl"
#include "math/inverse_trig.glsl"
#include "plane/plane.glsl"

const float kInverseTurn = 0.159154943091895336;  // 1 / (2 pi)

float number(uint at) { return uintBitsToFloat(lists[at]); }
vec2 pair_of_numbers(uint at) { return vec2(number(at), number(at + 1u)); }
vec3 colour_at(uint at) { return vec3(number(at), number(at + 1u), number(at + 2u)); }
float cross2(vec2 a, vec2 b) { return a.x * b.y - a.y * b.x; }

vec2 eye;  // the pixel, from the tile's centre

#include "plane_cut.glsl"
#include "plane_disk.glsl"
#if KIND == PLANE_DISKS || KIND == PLANE_LISTED
#include "plane_events.glsl"
#else
#include "plane_blockers.glsl"
#if KIND == PLANE_CUTS
#include "plane_edge.glsl"
#else
#include "plane_arc.glsl"
#endif
#endif

void main() {
    uint job = (first_job + gl_WorkGroupID.y) * uint(kJob);
    uint tile = lists[job];
    uint at = lists[job + 1u];
    uint count = lists[job + 2u];
    vec4 center = vec4(number(job + 3u), number(job + 4u), number(job + 5u), number(job + 6u));

    // A quarter of the tile, in which neighbours are neighbours: 4 x 2 pixels of 8 threads, 8 x 4 of 32.
    uint thread = gl_LocalInvocationID.x;
    uint x = (gl_WorkGroupID.x & 1u) * 8u + (thread & 3u) + ((thread >> 3) & 1u) * 4u;
    uint y = (gl_WorkGroupID.x >> 1) * 8u + ((thread >> 2) & 1u) + ((thread >> 4) & 3u) * 2u;
    vec2 pixel_step = vec2(number(0u), number(1u));
    eye = (vec2(float(x), float(y)) - 7.5) * pixel_step;

    too_many = false;
    turns = 0;
    vec3 sum = vec3(0.0);
    for (uint i = 0u; i < count; i++) {
        ++turns;
#if KIND == PLANE_LISTED
        sum += listed_light(at, center);
        at += uint(kListedLight);
#elif KIND == PLANE_DISKS
        sum += event_light(at, center);
        at += uint(kDiskLight) + lists[at + 7u];
#else
#if KIND == PLANE_CUTS
        sum += int(lists[at]) == 1 ? edge_light(at) : disk_light(at);
#else
        sum += arc_light(at);
#endif
        at += lists[at + uint(kLightWords)];
#endif
    }

    uint slot = tile * uint(kTileSums) + y * 16u + x;
    bool fresh = lists[job + 7u] == 1u;
    for (int c = 0; c < 3; c++) {
        uint to = slot + uint(c * kPixels);
        sums[to] = (fresh ? 0.0 : sums[to]) + sum[c];
    }
    if (too_many || turns > kMostTurns) sums[tile * uint(kTileSums) + uint(kToCpu)] = 1.0;
}
