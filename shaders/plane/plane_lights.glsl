// The lights of a list, one after another, as a pixel sees them. The shader that includes this has `lists`, `pairs`, `vertices` and, for
// lists that the device computes, `masks`.
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.

float number(uint at) { return uintBitsToFloat(lists[at]); }
vec2 pair_of_numbers(uint at) { return vec2(number(at), number(at + 1u)); }
vec3 colour_at(uint at) { return vec3(number(at), number(at + 1u), number(at + 2u)); }
float cross2(vec2 a, vec2 b) { return a.x * b.y - a.y * b.x; }

vec2 eye;  // the pixel, relative to the tile's centre

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

// Light of a job at pixel (x, y) of its tile.
vec3 light_of_job(uint job, float x, float y) {
    uint at = lists[job + 1u];
    uint count = lists[job + 2u];
    vec4 center = vec4(number(job + 3u), number(job + 4u), number(job + 5u), number(job + 6u));
    eye = (vec2(x, y) - 7.5) * vec2(number(0u), number(1u));
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
        sum += cut_light(at);
#else
        sum += arc_light(at);
#endif
        at += lists[at + uint(kLightWords)];
#endif
    }
    return sum;
}

// Returns true if the last job exceeded a thread's budget.
bool is_for_cpu() { return too_many || turns > kMostTurns; }
