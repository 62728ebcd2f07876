// The buffers of the search for visible parts: shadow_layout.glsl.
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.

layout(std430, binding = 0) readonly buffer Groups { uvec4 groups[]; };
layout(std430, binding = 2) buffer Answers {
    uint parts_used;  // vectors of all parts, including those that did not fit
    uint parts_room;
    uint left;
    uint seen;
    uint lists;
    uint seen_at_once;
    uint edges_used;  // by all groups, including those that did not fit
    uint edges_room;
    uint points_of[8];
    uvec4 spaces[kShadowSpaces];
    uvec4 answers[];
};
layout(std430, binding = 6) readonly buffer Mesh { uvec4 mesh[]; };
layout(std430, binding = 7) readonly buffer Frames { vec4 frames[]; };
// For each group the place and number of its edges; then their numbers in the mesh.
layout(std430, binding = 8) coherent buffer Gathered { uint gathered[]; };
