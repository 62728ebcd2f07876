// Visible parts of flat lights behind edges: a work group of one subgroup finds those of a point. docs/shadows.md.
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.
#version 450
#extension GL_GOOGLE_include_directive : require

#include "shadow_layout.glsl"

layout(constant_id = 0) const int SEGMENT_SPACE = 32;
layout(constant_id = 1) const int PIECE_SPACE = 32;  // for pieces, and for the crossings of LANES segments

layout(std430, binding = 0) readonly buffer Groups { uvec4 groups[]; };
layout(std430, binding = 1) writeonly buffer Parts { vec4 parts[]; };
layout(std430, binding = 2) buffer Answers {
    uint parts_begin;
    uint parts_used;  // by all parts, including those that did not fit
    uint parts_room;
    uint left;
    uvec4 counts;
    uvec4 spaces[kShadowSpaces];
    uvec4 answers[];
};
layout(push_constant) uniform Push { uint space; };

#include "prelude/prelude.glsl"
#include "math/constants.glsl"
#include "shadow/shadow.glsl"

#include "shadow_lanes.glsl"
#include "shadow_exact.glsl"
#include "shadow_turns.glsl"
#include "shadow_segments.glsl"
#include "shadow_count.glsl"
#include "shadow_region.glsl"

// The view of the part in work.
struct View {
    Eye eye;
    vec3 normal;
    vec2 scale;  // size of a cell
};

vec3 relative(View view, vec2 on_plane) { return view.eye.axes * vec3(on_plane - view.eye.eye.xy, view.eye.eye.z); }

// A place in cells, relative to the point. It is on or above the point's horizon, so that no rounding puts an edge below.
vec3 corner_at(View view, vec2 cell) {
    vec3 d = relative(view, cell * view.scale);
    return d + view.normal * max(1.0e-6 * length(d) - dot(d, view.normal), 0.0);
}

// Area moments of a region that edges bound, about a place of the light's plane.
struct Moments {
    float area;
    vec2 first;
    vec3 second;  // xx, xy, yy
};

Moments moments_add(Moments m, vec2 a, vec2 b) {
    float twice = a.x * b.y - a.y * b.x;
    m.area += twice / 2.0;
    m.first += twice * (a + b) / 6.0;
    m.second.xz += twice * (a * a + a * b + b * b) / 12.0;
    m.second.y += twice * (2.0 * a.x * a.y + a.x * b.y + b.x * a.y + 2.0 * b.x * b.y) / 24.0;
    return m;
}

Moments moments_of_lanes(Moments m) { return Moments(subgroupAdd(m.area), subgroupAdd(m.first), subgroupAdd(m.second)); }

// Writes a part's record without its places. It includes the four elements that replace the part if it is small: quarters_of of
// source/shapes/area_moments.h.
//
//   about  place about which the moments are, in cells
//   ahead  distance to the polygon's record, or 0
void write_record(View view, Moments m, vec2 about, uint at, uint places, uint ahead) {
    vec2 c = m.first / m.area;
    vec3 second = m.second / m.area - vec3(c.x * c.x, c.x * c.y, c.y * c.y);
    float middle = (second.x + second.z) / 2.0;
    float apart = length(vec2((second.x - second.z) / 2.0, second.y));
    float turn = 0.5 * atan(2.0 * second.y, second.x - second.z);
    vec2 along = vec2(cos(turn), sin(turn));
    vec2 reach = sqrt(max(2.0 * vec2(middle + apart, middle - apart), 0.0));
    Eye eye = view.eye;
    if (LANE > 0u) return;
    bool small = m.area > 0.0 && dot(eye.eye, eye.eye) > 100.0 * dot(eye.extent, eye.extent);  // kNeverSmall
    parts[at] = vec4(relative(view, about * view.scale + c), float(places));
    parts[at + 1u] = vec4(eye.axes * vec3(along, 0.0) * reach.x, small ? dot(reach, reach) / 2.0 : 1.0e30);
    parts[at + 2u] = vec4(eye.axes * vec3(-along.y, along.x, 0.0) * reach.y, 1.0);
    parts[at + 3u] = vec4(-eye.axes[2] * m.area, float(ahead));
}

void write_part(View view, vec2 inside, uint at, uint ahead) {
    Moments m = Moments(0.0, vec2(0.0), vec3(0.0));
    for (int i = int(LANE); i < piece_count; i += int(LANES)) {
        vec4 p = piece_ends(i);
        m = moments_add(m, (p.xy - inside) * view.scale, (p.zw - inside) * view.scale);
        parts[at + uint(kPartHeader + 2 * i)] = vec4(corner_at(view, p.xy), 0.0);
        parts[at + uint(kPartHeader + 2 * i + 1)] = vec4(corner_at(view, p.zw), 1.0);
    }
    write_record(view, moments_of_lanes(m), inside, at, 2u * uint(piece_count), ahead);
}

// Writes the polygon that replaces a round light, one contour, after the space for the sums.
void write_polygon(View view, Corners corners, uint at) {
    for (int i = int(LANE); i < kPartSums; i += int(LANES)) parts[at + uint(i)] = vec4(0.0);
    at += uint(kPartSums);
    Moments m = Moments(0.0, vec2(0.0), vec3(0.0));
    for (uint i = LANE; i < corners.count; i += LANES) {
        vec4 edge = corner_cells(corners, i) * view.scale.xyxy;
        m = moments_add(m, edge.xy, edge.zw);
        if (i == 0u) parts[at + uint(kPartHeader)] = vec4(relative(view, edge.xy), 0.0);
        parts[at + uint(kPartHeader) + i + 1u] = vec4(relative(view, edge.zw), 1.0);
    }
    write_record(view, moments_of_lanes(m), vec2(0.0), at, corners.count + 1u, 0u);
}

Eye eye_at(uint at, uint header, bool turned) {
    uint plane = turned ? at + uint(kShadowPoint) : header + 3u;
    vec4 x = uintBitsToFloat(groups[plane]);
    vec4 y = uintBitsToFloat(groups[plane + 1u]);
    vec4 z = uintBitsToFloat(groups[plane + 2u]);
    Eye eye;
    eye.eye = uintBitsToFloat(groups[at].xyz);
    eye.at = vec3(eye.eye.xy, -eye.eye.z);
    eye.box = uintBitsToFloat(groups[header + 2u].zw);
    eye.height = z.w;
    eye.axes = mat3(x.xyz, y.xyz, z.xyz);
    eye.extent = vec2(x.w, y.w);
    eye.turned = turned;
    if (turned) {
        vec4 origin = uintBitsToFloat(groups[plane + 3u]);
        vec4 place = uintBitsToFloat(groups[plane + 4u]);
        eye.origin = origin.xyz;
        eye.at = place.xyz;
        eye.box = vec2(origin.w, place.w);
    }
    return eye;
}

void main() {
    if (gl_NumSubgroups > 1u) return;
    uint point = answers[spaces[space].w + gl_WorkGroupID.x / 4u][gl_WorkGroupID.x % 4u];
    uint header = point / uint(kGroupPoints) * uint(kShadowHeader);
    uvec4 h2 = groups[header + 2u];
    uint number = point % uint(kGroupPoints);
    found = false;
    uvec4 begins = groups[header];
    uvec4 h1 = groups[header + 1u];
    bool turned = (h1.w & uint(kTurned)) != 0u;
    bool own = (h1.w & uint(kOwnCorners)) != 0u;
    uint vectors = uint(kShadowPoint + (turned ? kShadowPlane : 0));
    Corners corners = Corners(h1.y, 0u, h1.w % uint(kTurned));
    uint at = h1.z + number * (vectors + (own ? corners.count : 0u));
    if (own) corners.own = at + vectors;
    int flags = int(groups[at].w);
    int base = kHidden * (flags / kBase);
    Eye eye = eye_at(at, header, turned);
    View view = View(eye, uintBitsToFloat(groups[at + 1u].xyz), eye.box / shadow_cells());

    segment_count = 0;
    piece_count = 0;
    too_much = false;
    turns = turns_left(begins.w, h2.x / uint(kTriangles));
    see_edges(eye, begins, h1.x);
    see_sections(eye, begins.x, begins.y, corners.first + uint(kShadowCorner) * corners.count, h2.x / uint(kTriangles));
    bool occluded = segment_count > 0;
    vec3 place = vec3(0.0);
    uint sees = uint(kSeesWhole);
    if (!too_much && (occluded || (flags & kArranged) != 0)) {
        see_surroundings(corners, at, flags);
        cut_segments(base);
        bool wide = !too_much && piece_count > 0 && region_is_wide();
        if (wide) place = place_inside(base);
        if (too_much || (piece_count > 0 && !(place.z > shadow_cells() / 8192.0))) {
            sees = uint(kAskHost);
        } else if (piece_count == 0) {
            sees = uint(kSeesNone);
        } else if (occluded || (flags & kCutByTriangle) != 0) {
            bool shares = (flags & kShares) != 0;
            uint room = uint(kPartHeader + 2 * piece_count);
            uint room_of_polygon = shares ? uint(kPartSums + kPartHeader) + corners.count + 1u : 0u;
            uint begin = LANE > 0u ? 0u : atomicAdd(parts_used, room + room_of_polygon);
            begin = subgroupBroadcastFirst(begin);
            if (begin + room + room_of_polygon <= parts_room) {
                write_part(view, place.xy, parts_begin + begin, shares ? room + uint(kPartSums) : 0u);
                if (shares) write_polygon(view, corners, parts_begin + begin + room);
                sees = uint(kSeesPart) + parts_begin + begin;
            } else {
                sees = uint(kNoRoom);
            }
        }
    }
    if (LANE > 0u) return;
    if (too_much && space + 1u < uint(kShadowSpaces)) {
        uint place = atomicAdd(spaces[space + 1u].x, 1u);
        answers[spaces[space + 1u].w + place / 4u][place % 4u] = point;
        return;
    }
    if (too_much) sees = uint(kAskHost);
    // The ray ends at the height below which things block.
    vec3 way = relative(view, place.xy * view.scale) * max(1.0 + eye.height / eye.eye.z, 0.0);
    uint to = uint(kShadowAnswer) * (h2.y + number);
    if (sees == uint(kSeesWhole) || sees >= uint(kSeesPart)) answers[to].w += uint(kAskRay);
    answers[to + 1u] = uvec4(floatBitsToUint(way), sees);
}
