// A group's edges, the light's outline and the point's own horizons, as a point sees them: segments in cells.
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.

// Each set of lanes has SPACE places of an array, from FIRST on.
#define ALL_SPACE (SPACE * int(POINTS))
#define FIRST (MINE * SPACE)

shared vec4 cells[ALL_SPACE];  // start, end: whole numbers
shared uvec2 names[ALL_SPACE];
shared int weights[ALL_SPACE];  // change of the count from the right to the left
int segment_count;
bool too_much;  // the capacity is exceeded

// Crossings of the segments that the lanes have in work. Each segment has a chain of them.
shared float crossing_at[ALL_SPACE];
shared int crossing_links[ALL_SPACE];  // the change of the count, times kLinks; place of the next crossing
// Pieces of segments at the lowest count so far: fractions of the way at which each begins and ends; its segment. Before there are any,
// piece_segments holds weights and numbers of edges that wait.
shared vec2 pieces[ALL_SPACE];
shared int piece_segments[ALL_SPACE];
const int kWaitingBits = 16;
const int kWaiting = 1 << kWaitingBits;

// Weight of the outline: larger than the number of a group's triangles. The CPU has another one.
const int kHidden = 65536;

ivec4 displacements(uvec2 named) { return ivec4(displacement(named.x), displacement(named.y)); }

// The segment that this lane has found.
vec4 found_cells;
uvec2 found_names;
int found_weight;
bool found;

void add_segment(vec4 ends, uvec2 named, int weight) {
    found_cells = ends;
    found_names = named;
    found_weight = weight;
    found = true;
}

// Appends what each lane has found, one segment at most, after the first `before`. Returns the place of this lane's, or -1.
int gather_segments(int before) {
    int all;
    int to = before + begin_of(found, all);
    too_much = too_much || before + all > SPACE;
    if (too_much || !found) to = -1;
    found = false;
    if (to >= 0) {
        cells[FIRST + to] = found_cells;
        names[FIRST + to] = found_names;
        weights[FIRST + to] = found_weight;
    }
    segment_count = before + (too_much ? 0 : all);
    return to;
}

// After gathering: each lane keeps or discards its own segment.
void keep_gathered(int before, int own, bool keep) {
    subgroupBarrier();
    found = own >= 0 && keep;
    if (found) found_weight = weights[FIRST + own];
    gather_segments(before);
}

// Distance from a side, with the sign that `outside` has, so that all edges of a vertex agree.
float side_distance(float d, int outside, int bit) { return (outside & bit) != 0 ? min(d, 0.0) : max(d, smallest_divisor()); }

// clip_name: name of the segment's ends at the box.
void add_clipped(Eye eye, End a, End b, uvec2 named, uint clip_name, int weight) {
    if ((a.outside & b.outside & 15) != 0) return;
    vec4 ends = vec4(a.cell, b.cell);
    ShadowSpan span;
    span.t0 = 0.0;
    span.t1 = 1.0;
    span.sides = vec2(0.0);
    span.inside = true;
    vec2 sa = eye.box * a.h.z;
    vec2 sb = eye.box * b.h.z;
    span = shadow_clip_side(span, side_distance(sa.x + a.h.x, a.outside, 1), side_distance(sb.x + b.h.x, b.outside, 1), 1.0);
    span = shadow_clip_side(span, side_distance(sa.x - a.h.x, a.outside, 2), side_distance(sb.x - b.h.x, b.outside, 2), 2.0);
    span = shadow_clip_side(span, side_distance(sa.y + a.h.y, a.outside, 4), side_distance(sb.y + b.h.y, b.outside, 4), 3.0);
    span = shadow_clip_side(span, side_distance(sa.y - a.h.y, a.outside, 8), side_distance(sb.y - b.h.y, b.outside, 8), 4.0);
    bool at_a = span.sides.x > 0.5;
    bool at_b = span.sides.y > 0.5;
    // An end inside stays, even if the other end lies a rounding beyond its side. Otherwise its chain would break.
    if (!(span.t0 < span.t1) && at_a && at_b) return;
    vec3 d = b.h - a.h;
    if (at_a) {
        ends.xy = shadow_cell(a.h + d * span.t0, eye.box, span.sides.x);
        named.x = clip_name | (span.sides.x < 1.5 ? kLeftName : 0u);
    }
    if (at_b) {
        ends.zw = shadow_cell(a.h + d * span.t1, eye.box, span.sides.y);
        named.y = (clip_name + 1u) | (span.sides.y < 1.5 ? kLeftName : 0u);
    }
    add_segment(ends, named, weight);
}

// The change of the count from the right of an edge to its left: 0 if it is no silhouette.
int weight_of_edge(Point point, Edge edge) {
    Eye eye = point.view.eye;
    int flags = edge.flags;
    int weight = 0;
    if ((flags & kManyWalks) != 0) {
        for (uint i = edge.planes.x; i < edge.planes.x + edge.planes.y; i++) {
            uint one = mesh[mesh[0].w + i / 4u][i % 4u];
            int facing = facing_of(eye, point.begins.y + (one & (1u << kAgainstFrom) - 1u));
            weight -= one >> kAgainstFrom != 0u ? -facing : facing;
        }
    } else {
        if ((flags & kWalks0) != 0) weight -= facing_of(eye, point.begins.y + edge.planes.x) * ((flags & kAgainst0) != 0 ? -1 : 1);
        if ((flags & kWalks1) != 0) weight -= facing_of(eye, point.begins.y + edge.planes.y) * ((flags & kAgainst1) != 0 ? -1 : 1);
    }
    return weight;
}

void see_edge(Point point, Edge edge, int weight) {
    Eye eye = point.view.eye;
    // A loop of at most one turn, here and below: software devices skip such loops, but no branches.
    for (int turn = weight == 0 ? 1 : 0; turn < 1; turn++) {
        vec3 v0 = place_of(eye, frames[point.begins.x + edge.ends.x].xyz);
        vec3 v1 = place_of(eye, frames[point.begins.x + edge.ends.y].xyz);
        End a = look_at(eye, v0);
        End b = look_at(eye, v1);
        bool above_a = (a.outside & kAboveOut) != 0;
        bool above_b = (b.outside & kAboveOut) != 0;
        if (above_a && above_b) break;
        uvec2 named = edge.ends;
        if (above_a || above_b) {
            End cut = look_at(eye, shadow_cut(v0, v1, eye.height));
            if (above_a) a = cut;
            if (above_b) b = cut;
            if (above_a) named.x = kCutName | edge.number;
            if (above_b) named.y = kCutName | edge.number;
        }
        add_clipped(eye, a, b, named, kClipName | (2u * edge.number), weight);
    }
}

#if FEW
// The segments of the edges that shadow_edges.comp has listed for the point.
void see_edges(Point point) {
    uint list = lists + uint(kListVectors) * point.answer;
    uint count = answers[uint(kShadowAnswer) * point.answer + 1u].x;
    for (uint first = 0u; first < count && !too_much; first += LANES) {
        uint i = first + LANE;
        uint number = i < count ? answers[list + i / 4u][i % 4u] : 0u;
        Edge edge = edge_of(number, i < count ? mesh[uint(kMeshHead) + number] : uvec4(0u));
        see_edge(point, edge, weight_of_edge(point, edge));
        gather_segments(segment_count);
    }
}
#else
// The segments of all edges of the group. Few of them are silhouettes for a point. They wait in shared memory until all lanes project one.
Edge edge_at(Point point, uint place) {
    uint number = gathered[point.begins.z + place];
    return edge_of(number, mesh[uint(kMeshHead) + number]);
}
void see_edges(Point point) {
    int waiting = 0;
    for (uint first = 0u; first < point.begins.w && !too_much; first += LANES) {
        uint e = first + LANE;
        int weight = e < point.begins.w ? weight_of_edge(point, edge_at(point, e)) : 0;
        int all;
        int to = waiting + begin_of(weight != 0, all);
        if (weight != 0) piece_segments[FIRST + to] = kWaiting * weight + int(e);
        waiting += all;
        if (waiting + LANES <= SPACE && first + LANES < point.begins.w) continue;
        subgroupBarrier();
        for (int i = 0; i < waiting && !too_much; i += LANES) {
            int one = i + int(LANE) < waiting ? piece_segments[FIRST + i + int(LANE)] : 0;
            see_edge(point, edge_at(point, uint(one & (kWaiting - 1))), one >> kWaitingBits);
            gather_segments(segment_count);
        }
        waiting = 0;
    }
}
#endif

#if !FEW
// The place at which the light's plane cuts a triangle's side, which goes from one corner to the next.
End cut_of(Eye eye, uint vertices, uint from, uint to) {
    vec3 a = place_of(eye, frames[vertices + from].xyz);
    vec3 b = place_of(eye, frames[vertices + to].xyz);
    return look_at(eye, from < to ? shadow_cut(a, b, eye.height) : shadow_cut(b, a, eye.height));
}

// The section of a triangle by the light's plane. It starts where the triangle's walk leaves the space below, and ends where it returns.
void see_section(Eye eye, uint vertices, uint planes, uint triangles, uint count, uint t) {
    if (t < count) {
        uvec4 triangle = groups[triangles + uint(kShadowTriangle) * t];
        uvec4 edges = groups[triangles + uint(kShadowTriangle) * t + 1u];
        bvec3 below;
        for (int c = 0; c < 3; c++) below[c] = place_of(eye, frames[vertices + triangle[c]].xyz).z < eye.height;
        int leaving = below.x && !below.y ? 0 : below.y && !below.z ? 1 : 2;
        int returning = below.y && !below.x ? 0 : below.z && !below.y ? 1 : 2;
        End a = cut_of(eye, vertices, triangle[leaving], triangle[(leaving + 1) % 3]);
        End b = cut_of(eye, vertices, triangle[returning], triangle[(returning + 1) % 3]);
        uvec2 named = kCutName | uvec2(edges[1 + leaving], edges[1 + returning]);
        int weight = -facing_of(eye, planes + triangle.w);
        if (any(below) && !all(below)) add_clipped(eye, a, b, named, kSectionName | (2u * edges.x), weight);
    }
}

// The section of a coincident triangle only adds its weight to the first one's. Two segments with the same ends could not decide which lies
// left of the other.
const int kMostSections = 48;
void see_sections(Eye eye, uint vertices, uint planes, uint triangles, uint count) {
    int first = segment_count;
    for (uint t = 0u; t < count && !too_much; t += LANES) {
        int before = segment_count;
        see_section(eye, vertices, planes, triangles, count, t + LANE);
        int own = gather_segments(before);
        subgroupBarrier();
        bool coincides = false;
        int looks = 0;
        for (int i = first; i < own && !coincides; i++) {
            ++looks;
            bool same = names[FIRST + i] == names[FIRST + own];
            coincides = same || names[FIRST + i] == names[FIRST + own].yx;
            int weight = weights[FIRST + own];
            if (coincides) atomicAdd(weights[FIRST + i], same ? weight : -weight);
        }
        keep_gathered(before, own, !coincides);
        turns -= most_of_lanes(looks);
        too_much = too_much || segment_count - first > kMostSections || turns < 0;
    }
}

#endif

// Adds the outline, and the horizons that the host has found.
void see_surroundings(Corners c, uint at, int flags) {
    for (uint first = 0u; first < c.count; first += LANES) {
        uint i = first + LANE;
        if (i < c.count) {
            uvec4 named = groups[c.first + uint(kShadowCorner) * i + 1u];
            add_segment(corner_cells(c, i), kCornerName | named.xy, -kHidden);
        }
        gather_segments(segment_count);
    }
    for (uint first = 0u; first < 2u; first += LANES) {
        uint h = first + LANE;
        if (h < 2u && (flags & (kHorizon << h)) != 0) {
            int left = flags >> (2u * h);
            uvec2 named = uvec2(kHorizonName | (2u * h)) + uvec2(0u, 1u);
            named |= uvec2((left & kHorizonLeft) != 0 ? kLeftName : 0u, (left & (2 * kHorizonLeft)) != 0 ? kLeftName : 0u);
            add_segment(vec4(ivec4(groups[at + 2u + h])), named, -kHidden);
        }
        gather_segments(segment_count);
    }
    subgroupBarrier();
}
