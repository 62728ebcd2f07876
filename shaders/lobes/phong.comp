// Phong lobes of exponent N under a polygon, by the methods that benches compare. A thread handles a point, edge after edge of the outline
// above the horizon.
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.
#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_ballot : require

layout(constant_id = 0) const int METHOD = 0;  // number in phong_methods.glsl
layout(constant_id = 1) const int N = 1;
layout(constant_id = 2) const int F_IS_X = 0;  // form of the fits
layout(constant_id = 3) const int CORNERS = 4;
const int LOW_EXPONENT = 0;

layout(local_size_x = 64) in;
layout(std430, binding = 0) readonly buffer Points { vec4 points[]; };    // position, normal and view of each
layout(std430, binding = 1) readonly buffer Corners { vec4 corners[]; };  // then the light's normal
layout(std430, binding = 2) buffer Results { float results[]; };
layout(push_constant) uniform Push { uint count; };

#include "prelude/prelude.glsl"
#include "math/constants.glsl"
#include "math/frame.glsl"
#include "math/inverse_trig.glsl"
#include "outline/polygon.glsl"
#include "outline/horizon_clip.glsl"
#include "lobe/phong.glsl"
#include "integral/moment.glsl"
#include "integral/moment_quadrature.glsl"
#include "integral/moment_series.glsl"
#include "integral/moment_cosine.glsl"
#define PHONG_COMPARISON
#include "phong_front.glsl"
#include "../lights/edges.glsl"

void main() {
    uint i = (gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * 64u + gl_LocalInvocationID.x;
    if (i >= count) return;
    vec3 p = points[3u * i].xyz;
    mat3 frame = frame_from_normal(points[3u * i + 1u].xyz);
    vec3 view = transform_transposed(frame, points[3u * i + 2u].xyz);
    bool lit = view.z > 0.0 && dot(p - corners[0].xyz, corners[CORNERS].xyz) > 0.0;

    vec3 axis = phong_mirror(view);
    float sum = 0.0;
    begin_clip(1.0);
    vec3 previous = polygon_direction(transform_transposed(frame, corners[CORNERS - 1].xyz - p));
    for (int k = 0; k <= CORNERS; k++) {
        vec3 here = polygon_direction(transform_transposed(frame, corners[min(k, CORNERS - 1)].xyz - p));
        put_clipped(previous, here, k == CORNERS);
        do {
            if (has_clipped_edge()) {
                MomentEdge edge = moment_edge(clip_begin, clip_end, axis);
                sum += moment_edge_share(edge, phong_front(edge, float(N)));
            }
        } while (next_arc());
        previous = here;
    }
    results[i] = lit ? moment_phong_radiance(sum, false) : 0.0;
}
