// Light in the plane. A thread handles a pixel and goes through its tile's lights. Closed forms integrate the visible part of each light.
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.
//
// A shader handles one kind of lights: plane_disks.comp, plane_cuts.comp and plane_arcs.comp define it as KIND. The parity of
// frames holds it to the packs.
#include "plane_layout.glsl"

layout(local_size_x = 64) in;
layout(std430, binding = 0) readonly buffer Lists { uint lists[]; };
layout(std430, binding = 1) readonly buffer Pairs { uint pairs[]; };
layout(std430, binding = 2) readonly buffer Vertices { vec4 vertices[]; };  // x and y, each as a float and its remainder
layout(std430, binding = 3) buffer Sums { float sums[]; };
#if KIND == PLANE_LISTED
layout(std430, binding = 4) readonly buffer Masks { uint masks[]; };
#endif
layout(push_constant) uniform Push { uint first_job; };

#include "prelude/prelude.glsl"
#include "math/constants.glsl"
#include "math/inverse_trig.glsl"
#include "plane/plane.glsl"

#include "plane_lights.glsl"

void main() {
    uint job = (first_job + gl_WorkGroupID.y) * uint(kJob);
    uint tile = lists[job];

    // A work group covers a quarter of the tile. Neighbouring threads have neighbouring pixels: 4 x 2 pixels of 8 threads, 8 x 4 of 32.
    uint thread = gl_LocalInvocationID.x;
    uint x = (gl_WorkGroupID.x & 1u) * 8u + (thread & 3u) + ((thread >> 3) & 1u) * 4u;
    uint y = (gl_WorkGroupID.x >> 1) * 8u + ((thread >> 2) & 1u) + ((thread >> 4) & 3u) * 2u;
    vec3 sum = light_of_job(job, float(x), float(y));

    uint slot = tile * uint(kTileSums) + y * 16u + x;
    bool fresh = lists[job + 7u] == 1u;
    for (int c = 0; c < 3; c++) {
        uint to = slot + uint(c * kPixels);
        sums[to] = (fresh ? 0.0 : sums[to]) + sum[c];
    }
    if (is_for_cpu()) sums[tile * uint(kTileSums) + uint(kToCpu)] = 1.0;
}
