// A point of a group, its view of a light's plane, and of the group's edges.
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.

// A point in front of a light's plane.
struct Eye {
    vec3 at;       // in the coordinates of the edges
    vec3 eye;      // in the light's frame, below the light's plane: shadow_project
    vec2 box;
    float height;  // only geometry below it blocks
    mat3 axes;     // axes of the light's frame
    bool turned;   // the frame is not the edges' own
    vec3 origin;   // origin of such a frame
    vec2 extent;   // half sides of the light
};

// A vertex in the light's frame.
vec3 place_of(Eye eye, vec3 v) { return eye.turned ? (v - eye.origin) * eye.axes : v; }

const int kAboveOut = 16;  // in addition to one bit for each side: left, right, bottom, top

struct End {
    vec3 h;
    vec2 cell;
    int outside;
};

End look_at(Eye eye, vec3 v) {
    End end;
    end.h = shadow_project(eye.eye, vec3(0.0, 0.0, eye.eye.z), v);
    end.cell = shadow_cell(end.h, eye.box, 0.0);
    vec2 side = eye.box * end.h.z;
    end.outside = (side.x + end.h.x <= 0.0 ? 1 : 0) | (side.x - end.h.x <= 0.0 ? 2 : 0) | (side.y + end.h.y <= 0.0 ? 4 : 0) |
                  (side.y - end.h.y <= 0.0 ? 8 : 0) | (v.z >= eye.height ? kAboveOut : 0);
    return end;
}

// Returns 1 if the point sees the front of a plane, else -1.
int facing_of(Eye eye, uint plane) {
    vec4 p = frames[plane];
    return int(shadow_facing(p.xyz, p.w, eye.at));
}

// The view of a point.
struct View {
    Eye eye;
    vec3 normal;
    vec2 scale;  // size of a cell
};

vec3 relative(View view, vec2 on_plane) { return view.eye.axes * vec3(on_plane - view.eye.eye.xy, view.eye.eye.z); }


// The edges of a light's outline, in cells.
struct Corners {
    uint first;  // place of the group's
    uint own;    // place of the point's, or 0
    uint count;
};
vec4 corner_cells(Corners c, uint i) { return vec4(ivec4(groups[c.own > 0u ? c.own + i : c.first + uint(kShadowCorner) * i])); }

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

// A point of a group.
struct Point {
    uvec4 begins;      // of the frame's vertices and planes, and of the edges; number of edges
    uint triangles;    // number of those that cross the light's plane
    Corners corners;
    uint at;           // place of its vectors
    int flags;
    uint answer;
    View view;
};

Point point_of(uint name) {
    uint head = name / uint(kGroupPoints) * uint(kGatheredHead);
    uint header = name / uint(kGroupPoints) * uint(kShadowHeader);
    uint number = name % uint(kGroupPoints);
    uvec4 h1 = groups[header + 1u];
    uvec4 h2 = groups[header + 2u];
    bool turned = (h1.w & uint(kTurned)) != 0u;
    bool own = (h1.w & uint(kOwnCorners)) != 0u;
    uint vectors = uint(kShadowPoint + (turned ? kShadowPlane : 0));
    Point point;
    point.begins = uvec4(groups[header].xy, gathered[head], gathered[head + 1u]);
    point.triangles = h2.x / uint(kTriangles);
    point.corners = Corners(h1.y, 0u, h1.w % uint(kTurned));
    point.at = h1.z + number * (vectors + (own ? point.corners.count : 0u));
    if (own) point.corners.own = point.at + vectors;
    point.flags = int(groups[point.at].w);
    point.answer = h2.y + number;
    Eye eye = eye_at(point.at, header, turned);
    point.view = View(eye, uintBitsToFloat(groups[point.at + 1u].xyz), eye.box / shadow_cells());
    return point;
}

// Appends a point to a space's list, whose work groups serve `together` points each.
void go_to_space(uint space, uint name, uint together) {
    uint place = atomicAdd(points_of[space], 1u);
    answers[spaces[space].w + place / 4u][place % 4u] = name;
    uint group = place / together;
    atomicMax(spaces[space].x, min(group + 1u, uint(kMostInRow)));
    atomicMax(spaces[space].y, group / uint(kMostInRow) + 1u);
}

// Writes the answer: what the point sees if the ray to a place of the light, in cells, is free.
void write_answer(Point point, vec2 place, uint sees) {
    // The ray ends at the height below which things block.
    Eye eye = point.view.eye;
    vec3 way = relative(point.view, place * point.view.scale) * max(1.0 + eye.height / eye.eye.z, 0.0);
    uint to = uint(kShadowAnswer) * point.answer;
    if (sees == uint(kSeesWhole) || sees >= uint(kSeesPart)) answers[to].w += uint(kAskRay);
    answers[to + 1u] = uvec4(floatBitsToUint(way), sees);
}
