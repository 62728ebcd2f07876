// The edges of its group that each point may see as segments: a work group a group, a thread a point. A point without any is answered at
// once. Others go to the space that their segments surely fit.
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.
#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_ballot : require

#include "shadow_layout.glsl"

layout(local_size_x = 64) in;               // kGroupPoints
// Capacities of the spaces, and points of a work group of the first two.
layout(constant_id = 0) const int SPACE_0 = 16;
layout(constant_id = 1) const int SPACE_1 = 48;
layout(constant_id = 2) const int SPACE_2 = 96;
layout(constant_id = 3) const int SPACE_3 = 192;
layout(constant_id = 4) const int TOGETHER_0 = 1;
layout(constant_id = 5) const int TOGETHER_1 = 1;

#include "prelude/prelude.glsl"
#include "math/constants.glsl"
#include "shadow/shadow.glsl"

#include "shadow_answers.glsl"
#include "shadow_view.glsl"

// A vector at a place that all points of a group have in common: in_common of ../entry.glsl.
vec4 of_frame(uint at) { return frames[subgroupBroadcastFirst(at)]; }

// Compilers round the same text in two shaders in two ways. What is nearer to a decision than this fraction of its terms is kept.
const float kOpen = 1.0e-5;

// Returns 1 or -1 as facing_of, or 0 if it is open.
int clear_facing(Eye eye, uint plane) {
    vec4 p = of_frame(plane);
    float d = dot(p.xyz, eye.at) - p.w;
    return abs(d) > kOpen * (dot(abs(p.xyz), abs(eye.at)) + abs(p.w)) ? (d > 0.0 ? 1 : -1) : 0;
}

bool may_be_silhouette(Eye eye, uvec4 begins, Edge edge) {
    if (!has_two_triangles(edge)) return true;
    return may_be_contour(edge, ivec2(clear_facing(eye, begins.y + edge.planes.x), clear_facing(eye, begins.y + edge.planes.y)));
}

// The sides of the box that a place is surely beyond, and kAboveOut.
int surely_outside(Eye eye, vec3 v) {
    vec3 h = shadow_project(eye.eye, vec3(0.0, 0.0, eye.eye.z), v);
    vec2 side = eye.box * h.z;
    float size = dot(abs(v), vec3(1.0)) + (eye.turned ? dot(abs(eye.origin), vec3(1.0)) : 0.0);
    float open = -kOpen * (size * (abs(eye.eye.x) + abs(eye.eye.y) + eye.eye.z) + (eye.box.x + eye.box.y) * (size + eye.eye.z));
    return (side.x + h.x < open ? 1 : 0) | (side.x - h.x < open ? 2 : 0) | (side.y + h.y < open ? 4 : 0) | (side.y - h.y < open ? 8 : 0) |
           (v.z > eye.height + kOpen * size ? kAboveOut : 0);
}

bool may_be_segment(Eye eye, uvec4 begins, Edge edge) {
    vec3 v0 = place_of(eye, of_frame(begins.x + edge.ends.x).xyz);
    vec3 v1 = place_of(eye, of_frame(begins.x + edge.ends.y).xyz);
    return (surely_outside(eye, v0) & surely_outside(eye, v1)) == 0;
}

void main() {
    uint group = gl_WorkGroupID.x;
    if (gl_LocalInvocationID.x >= groups[uint(kShadowHeader) * group + 2u].x % uint(kTriangles)) return;
    uint name = uint(kGroupPoints) * group + gl_LocalInvocationID.x;
    Point point = point_of(name);
    uint sees = gathered[uint(kGatheredHead) * group + 2u];
    if (sees != uint(kSeesNone)) {
        write_answer(point, vec2(0.0), sees);
        return;
    }
    uint list = lists + uint(kListVectors) * point.answer;
    uint count = 0u;
    for (uint e = 0u; e < point.begins.w; e++) {
        uint number = gathered[subgroupBroadcastFirst(point.begins.z + e)];
        Edge edge = edge_of(number, mesh[subgroupBroadcastFirst(uint(kMeshHead) + number)]);
        if (!may_be_silhouette(point.view.eye, point.begins, edge) || !may_be_segment(point.view.eye, point.begins, edge)) continue;
        if (count < uint(kMostListed)) answers[list + count / 4u][count % 4u] = number;
        ++count;
    }
    if (count + point.triangles == 0u && (point.flags & kArranged) == 0) {
        atomicAdd(seen_at_once, 1u);
        write_answer(point, vec2(0.0), uint(kSeesWhole));
        return;
    }
    int segments = int(count + point.triangles + point.corners.count) + 2;  // two horizons
    // Listed edges have no sections beside them.
    bool few = segments <= SPACE_1 && count <= uint(kMostListed) && point.triangles == 0u;
    uint space = few ? (segments <= SPACE_0 ? 0u : 1u) : segments <= SPACE_2 ? 2u : segments <= SPACE_3 ? 3u : 4u;
    if (few) answers[uint(kShadowAnswer) * point.answer + 1u].x = count;
    go_to_space(space, name, uint(space == 0u ? TOGETHER_0 : space == 1u ? TOGETHER_1 : 1));
}
