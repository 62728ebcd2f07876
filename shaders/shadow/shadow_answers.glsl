// The buffers of groups and answers: shadow_layout.glsl.
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.

layout(std430, binding = 0) readonly buffer Groups { uvec4 groups[]; };
layout(std430, binding = 2) buffer Answers {
    uint parts_used;  // vectors of all parts, including those that did not fit
    uint parts_room;
    uint left;
    uint seen;
    uint lists;
    uint seen_at_once;
    uint unused[2];
    uint points_of[8];
    uvec4 spaces[kShadowSpaces];
    uvec4 answers[];
};
