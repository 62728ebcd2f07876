// Visible parts of flat lights behind edges: a work group of one subgroup finds those of a point, or of some points. docs/shadows.md.
// The macro FEW (0 or 1) tells if it is some points, whose edges
// shadow_edges.comp has listed, and whose light no triangle crosses.
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.
#version 450
#extension GL_GOOGLE_include_directive : require

#include "shadow_layout.glsl"

layout(constant_id = 0) const int SPACE = 32;  // for segments, for pieces, and for the crossings of LANES segments

layout(std430, binding = 1) writeonly buffer Parts { vec4 parts[]; };
layout(constant_id = 4) const int TOGETHER = 1;  // points of a work group of the next space
layout(constant_id = 5) const int COUNTS = 0;  // 1: the work of the space is summed up
layout(push_constant) uniform Push { uint space; };

#include "prelude/prelude.glsl"
#include "math/constants.glsl"
#include "shadow/shadow.glsl"

#include "shadow_lanes.glsl"
#include "shadow_answers.glsl"
#include "shadow_view.glsl"
#include "shadow_exact.glsl"
#include "shadow_turns.glsl"
#include "shadow_segments.glsl"
#include "shadow_work.glsl"
#include "shadow_order.glsl"
#include "shadow_count.glsl"
#include "shadow_pieces.glsl"
#include "shadow_region.glsl"

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

Moments moments_of_lanes(Moments m) {
    vec2 last = sum_of_lanes(vec2(m.second.z, m.area));
    return Moments(last.y, sum_of_lanes(m.first), vec3(sum_of_lanes(m.second.xy), last.x));
}

// The record of an outline, without its places.
struct Record {
    Moments moments;  // about a place in cells
    vec2 about;
    uint at;
    uint places;
    uint ahead;  // distance to the polygon's record, or 0
};

// Writes a lane's record. It includes the four elements that replace the outline if it is small: quarters_of of
// source/shapes/area_moments.h.
void write_record(View view, Record record) {
    Moments m = record.moments;
    vec2 c = m.first / m.area;
    vec3 second = m.second / m.area - vec3(c.x * c.x, c.x * c.y, c.y * c.y);
    float middle = (second.x + second.z) / 2.0;
    float apart = length(vec2((second.x - second.z) / 2.0, second.y));
    float turn = 0.5 * atan(2.0 * second.y, second.x - second.z);
    vec2 along = vec2(cos(turn), sin(turn));
    vec2 reach = sqrt(max(2.0 * vec2(middle + apart, middle - apart), 0.0));
    Eye eye = view.eye;
    uint at = record.at;
    bool small = m.area > 0.0 && dot(eye.eye, eye.eye) > 100.0 * dot(eye.extent, eye.extent);  // kNeverSmall
    parts[at] = vec4(relative(view, record.about * view.scale + c), float(record.places));
    parts[at + 1u] = vec4(eye.axes * vec3(along, 0.0) * reach.x, small ? dot(reach, reach) / 2.0 : 1.0e30);
    parts[at + 2u] = vec4(eye.axes * vec3(-along.y, along.x, 0.0) * reach.y, 1.0);
    parts[at + 3u] = vec4(-eye.axes[2] * m.area, float(record.ahead));
}

// Writes the places of a part.
Record write_part(View view, vec2 inside, uint at, uint ahead) {
    Moments m = Moments(0.0, vec2(0.0), vec3(0.0));
    for (int i = int(LANE); i < piece_count; i += LANES) {
        vec4 p = piece_ends(i);
        m = moments_add(m, (p.xy - inside) * view.scale, (p.zw - inside) * view.scale);
        parts[at + uint(kPartHeader + 2 * i)] = vec4(corner_at(view, p.xy), 0.0);
        parts[at + uint(kPartHeader + 2 * i + 1)] = vec4(corner_at(view, p.zw), 1.0);
    }
    return Record(moments_of_lanes(m), inside, at, 2u * uint(piece_count), ahead);
}

// Writes the places of the polygon that replaces a round light, one contour, after the space for the sums.
Record write_polygon(View view, Corners corners, uint at) {
    for (int i = int(LANE); i < kPartSums; i += LANES) parts[at + uint(i)] = vec4(0.0);
    at += uint(kPartSums);
    Moments m = Moments(0.0, vec2(0.0), vec3(0.0));
    for (uint i = LANE; i < corners.count; i += LANES) {
        vec4 edge = corner_cells(corners, i) * view.scale.xyxy;
        m = moments_add(m, edge.xy, edge.zw);
        if (i == 0u) parts[at + uint(kPartHeader)] = vec4(relative(view, edge.xy), 0.0);
        parts[at + uint(kPartHeader) + i + 1u] = vec4(relative(view, edge.zw), 1.0);
    }
    return Record(moments_of_lanes(m), vec2(0.0), at, corners.count + 1u, 0u);
}

void main() {
    // The first spaces have few segments a point, so that a subgroup serves several points.
    uint place_of_point = (gl_WorkGroupID.y * uint(kMostInRow) + gl_WorkGroupID.x) * POINTS + uint(MINE);
    if (gl_NumSubgroups > 1u || place_of_point >= points_of[space] || edges_used > edges_room) return;
    uint name = answers[spaces[space].w + place_of_point / 4u][place_of_point % 4u];
    Point point = point_of(name);
    View view = point.view;
    int base = kHidden * (point.flags / kBase);
    found = false;
    segment_count = 0;
    piece_count = 0;
    begin_counting();
    too_much = false;
    turns = turns_left(point.begins.w, point.triangles);
    see_edges(point);
#if !FEW
    see_sections(view.eye, point.begins.x, point.begins.y, point.corners.first + uint(kShadowCorner) * point.corners.count, point.triangles);
#endif
    bool occluded = segment_count > 0;
    vec3 place = vec3(0.0);
    uint sees = uint(kSeesWhole);
    if (!too_much && (occluded || (point.flags & kArranged) != 0)) {
        see_surroundings(point.corners, point.at, point.flags);
        cut_segments(base);
        bool wide = !too_much && piece_count > 0 && region_is_wide();
        if (wide) place = place_inside(base);
        if (too_much || (piece_count > 0 && !(place.z > shadow_cells() / 8192.0))) {
            sees = uint(kAskHost);
        } else if (piece_count == 0) {
            sees = uint(kSeesNone);
        } else if (occluded || (point.flags & kCutByTriangle) != 0) {
            bool shares = (point.flags & kShares) != 0;
            uint room = uint(kPartHeader + 2 * piece_count);
            uint room_of_polygon = shares ? uint(kPartSums + kPartHeader) + point.corners.count + 1u : 0u;
            int of_lane = LANE > 0u ? 0 : int(atomicAdd(parts_used, room + room_of_polygon));
            uint begin = uint(most_of_lanes(of_lane));
            if (begin + room + room_of_polygon <= parts_room) {
                // The first lane writes the part's record, the second one the polygon's.
                Record record = write_part(view, place.xy, begin, shares ? room + uint(kPartSums) : 0u);
                if (shares) {
                    Record of_polygon = write_polygon(view, point.corners, begin + room);
                    if (LANE == 1u) record = of_polygon;
                }
                if (LANE < (shares ? 2u : 1u)) write_record(view, record);
                sees = uint(kSeesPart) + begin;
            } else {
                sees = uint(kNoRoom);
            }
        }
    }
    if (COUNTS == 1) count_work(FEW == 1 ? answers[uint(kShadowAnswer) * point.answer + 1u].x : point.begins.w, FEW == 1 ? 0u : point.triangles);
    if (LANE > 0u) return;
    if (too_much && space + 1u < uint(kShadowSpaces))
        go_to_space(space + 1u, name, uint(TOGETHER));
    else
        write_answer(point, place.xy, too_much ? uint(kAskHost) : sees);
}
