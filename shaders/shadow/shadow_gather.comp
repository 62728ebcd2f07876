// The edges that a group of points may see: a work group walks the boxes of the mesh, and tests the edges of leaves that the group's shaft
// meets. The tests are those of source/shadow/lanes/shadow_pack.cpp, with its margins.
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.
#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_ballot : require
#extension GL_KHR_shader_subgroup_vote : require

#include "shadow_layout.glsl"

layout(local_size_x = 64) in;  // kLeaf

#include "shadow_answers.glsl"

// Software devices end a thread's loops after 65,535 turns: shadow_turns.glsl. The loops over leaves and edges take the rest.
const uint kMostNodes = 32768u;
const float kRounding = 2.0e-6;

shared uint met_leaves[kMostLeaves];
shared uint leaf_count;  // of all that are met
shared uint incidence_count;
shared uint counts[kLeaf];  // of needed edges
shared uint list_begin;

float size_of(vec3 v) { return dot(abs(v), vec3(1.0)); }
vec4 shaft_vector(uint shaft, int i) { return uintBitsToFloat(groups[shaft + uint(i)]); }

// The lanes of a subgroup test the sides of the shaft together.
bool meets_box(uint shaft, vec3 low, vec3 high) {
    vec3 middle = 0.5 * (low + high);
    vec3 half_sides = 0.5 * (high - low);
    float margin = 2.0 * kRounding * (size_of(middle) + size_of(half_sides) + shaft_vector(shaft, kShaftBounds + 3).w);
    bool beyond = false;
    for (uint i = gl_SubgroupInvocationID; i < uint(kShaftBounds); i += gl_SubgroupSize) {
        vec4 bound = shaft_vector(shaft, int(i));
        beyond = beyond || !(dot(bound.xyz, middle) - dot(abs(bound.xyz), half_sides) <= bound.w + margin * size_of(bound.xyz));
    }
    return !subgroupAny(beyond);
}

bool meets_edge(uint shaft, vec3 a, vec3 b) {
    float reach = shaft_vector(shaft, kShaftBounds + 3).w;
    vec2 margin = kRounding * (vec2(size_of(a), size_of(b)) + reach);
    bool meets = true;
    for (int i = 0; i < kShaftBounds; i++) {
        vec4 bound = shaft_vector(shaft, i);
        vec2 at = vec2(dot(bound.xyz, a), dot(bound.xyz, b)) - size_of(bound.xyz) * margin;
        meets = meets && min(at.x, at.y) <= bound.w;
    }
    return meets;
}

// Returns 1 if all points see the front of a plane, -1 if all see the back, else 0.
int facing_of_all(uint shaft, uint plane) {
    vec4 p = uintBitsToFloat(mesh[mesh[1].y + plane]);
    vec4 middle = shaft_vector(shaft, kShaftBounds + 3);
    float height = dot(p.xyz, middle.xyz) - p.w;
    float reach = kRounding * (abs(p.w) + size_of(p.xyz) * (size_of(middle.xyz) + middle.w));
    for (int i = 0; i < 3; i++) reach += abs(dot(p.xyz, shaft_vector(shaft, kShaftBounds + i).xyz));
    return abs(height) > reach ? (height > 0.0 ? 1 : -1) : 0;
}

bool may_be_contour_of_any(uint shaft, Edge edge) {
    return !has_two_triangles(edge) || may_be_contour(edge, ivec2(facing_of_all(shaft, edge.planes.x), facing_of_all(shaft, edge.planes.y)));
}

bool is_needed(uint shaft, Edge edge) {
    vec3 a = uintBitsToFloat(mesh[mesh[1].x + edge.ends.x].xyz);
    vec3 b = uintBitsToFloat(mesh[mesh[1].x + edge.ends.y].xyz);
    return meets_edge(shaft, a, b) && may_be_contour_of_any(shaft, edge);
}

void find_leaves(uint shaft) {
    uint count = 0u;
    uint turns = 0u;
    // One subgroup walks.
    uint node = gl_LocalInvocationID.x < gl_SubgroupSize ? 0u : mesh[0].y;
    while (node < mesh[0].y && turns < kMostNodes) {
        uvec4 low = mesh[subgroupBroadcastFirst(mesh[0].z + uint(kNodeVectors) * node)];
        uvec4 high = mesh[subgroupBroadcastFirst(mesh[0].z + uint(kNodeVectors) * node + 1u)];
        bool meets = meets_box(shaft, uintBitsToFloat(low.xyz), uintBitsToFloat(high.xyz));
        if (meets && low.w > 0u) {
            if (count < uint(kMostLeaves)) met_leaves[count] = low.w - 1u;
            ++count;
        }
        node = meets ? node + 1u : high.w;
        ++turns;
    }
    if (gl_LocalInvocationID.x > 0u) return;
    leaf_count = turns < kMostNodes ? count : uint(kMostLeaves) + 1u;
    atomicAdd(nodes_met, turns);
    atomicAdd(leaves_met, count);
}

// Goes through a thread's share of the edges of the leaves, neighbours as many as there are leaves, so that edges ascend from thread to thread. Writes those
// that the group needs from a place on, if `writes` is true. Returns their number.
uint list_edges(uint shaft, bool writes, uint to) {
    uint count = 0u;
    uint all = writes ? counts[gl_LocalInvocationID.x] : leaf_count;
    for (uint i = 0u; i < leaf_count && count < all; i++) {
        uint at = gl_LocalInvocationID.x * leaf_count + i;
        uint number = met_leaves[at / uint(kLeaf)] + at % uint(kLeaf);
        if (number >= mesh[0].x) continue;
        Edge edge = edge_of(number, mesh[uint(kMeshHead) + number]);
        if (!is_needed(shaft, edge)) continue;
        if (writes) gathered[to + count] = number;
        if (!writes && (edge.flags & kManyWalks) != 0) atomicAdd(incidence_count, edge.planes.y);
        ++count;
    }
    return count;
}

// The place and number of the group's edges. sees: kSeesNone, or the answer of all points where a limit is exceeded.
void write_head(uint place, uint count, uint sees) {
    uint at = uint(kGatheredHead) * gl_WorkGroupID.x;
    if (gl_LocalInvocationID.x > 0u) return;
    gathered[at] = place;
    gathered[at + 1u] = count;
    gathered[at + 2u] = sees;
}

void main() {
    uint header = uint(kShadowHeader) * gl_WorkGroupID.x;
    uint shaft = header + uint(kShaft);
    uint thread = gl_LocalInvocationID.x;
    if (thread == 0u) incidence_count = 0u;
    find_leaves(shaft);
    barrier();
    if (leaf_count > uint(kMostLeaves)) {
        write_head(0u, 0u, uint(kAskHost));
        return;
    }
    counts[thread] = list_edges(shaft, false, 0u);
    barrier();
    uint before = 0u;
    uint all = 0u;
    for (uint i = 0u; i < uint(kLeaf); i++) {
        if (i == thread) before = all;
        all += counts[i];
    }
    uint triangles = groups[header + 2u].x / uint(kTriangles);
    // A triangle takes one and a half times as many turns as an edge.
    bool too_many = all + triangles + triangles / 2u > uint(kMostEdges) || incidence_count > uint(kMostIncidences);
    if (thread == 0u && !too_many) list_begin = atomicAdd(edges_used, all);
    barrier();
    bool fits = !too_many && list_begin + all <= edges_room;
    uint place = uint(kGatheredHead) * gl_NumWorkGroups.x + list_begin;
    write_head(place, fits ? all : 0u, uint(too_many ? kAskHost : fits ? kSeesNone : kNoRoom));
    if (!fits) return;
    if (thread == 0u) atomicAdd(looks, all * (groups[header + 2u].x % uint(kTriangles)));
    list_edges(shaft, true, place + before);
}
