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
    uint points_of[kShadowSpaces];
    uint looks;
    uint nodes_met;   // by the walks of all groups
    uint leaves_met;
    uint work[kWork * kShadowSpaces];
    uvec4 spaces[kShadowSpaces];
    uvec4 answers[];
};
layout(std430, binding = 6) readonly buffer Mesh { uvec4 mesh[]; };
layout(std430, binding = 7) readonly buffer Frames { vec4 frames[]; };
// A head for each group; then the numbers of their edges in the mesh.
layout(std430, binding = 8) buffer Gathered { uint gathered[]; };

struct Edge {
    uint number;
    uvec2 ends;
    uvec2 planes;  // or incidences: shadow_layout.glsl
    int flags;
};
Edge edge_of(uint number, uvec4 vector) {
    return Edge(number, uvec2(vector.x & (1u << kFlagsFrom) - 1u, vector.y), vector.zw, int(vector.x >> kFlagsFrom));
}

// Only an edge between two triangles may surely be no contour: facing is 1 or -1 for each of them, or 0 if it is open.
bool has_two_triangles(Edge edge) { return (edge.flags & kManyWalks) == 0 && (edge.flags & kWalks1) != 0; }
bool may_be_contour(Edge edge, ivec2 facing) {
    bool opposite = ((edge.flags & kAgainst0) != 0) != ((edge.flags & kAgainst1) != 0);
    return facing.x == 0 || facing.y == 0 || (opposite ? facing.x != facing.y : facing.x == facing.y);
}
