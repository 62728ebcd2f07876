// The only walk: corners of a light in walk order, as a point sees them, and the light's edges above the horizon.
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.

// Corners that replace a round light, gathered about a lobe.
vec3 corners[CORNER_SPACE];
int corner_count;
bool has_corners() { return KIND != kPolygon && !by_pieces(); }

//   axis, width  of the lobe, in the shading frame
void fill_corners(Light light, mat3 frame, vec3 p, vec3 axis, float width) {
    corner_count = CORNERS;
    if (KIND == kCapsule) {
        CapsuleFan fan = capsule_fan(capsule_in(light, frame, p), axis, width, CORNERS);
        for (int i = 0; i < CORNERS; i++) corners[i] = polygon_direction(capsule_fan_corner(fan, i));
    } else {
        EllipseFan fan = ellipse_fan_concentrated(ellipse_in(light, frame, p), axis, width);
        if (!CAREFUL) fan.near = false;  // the host knows that no point of the tile is near the rim
        if (fan.near) corner_count = CORNER_SPACE;
        vec2 here = ellipse_corner(fan, 0, corner_count);
        float gap_before = ellipse_gap(ellipse_corner(fan, -1, corner_count), here);
        for (int i = 0; i < corner_count; i++) {
            vec2 after = ellipse_corner(fan, i + 1, corner_count);
            float gap = ellipse_gap(here, after);
            corners[i] = polygon_direction(ellipse_corner_between(fan, here, gap_before + gap));
            here = after;
            gap_before = gap;
        }
    }
}

// Number of places of a walk. A contour begins at each place that is not joined; the first is one of them.
int outline_length(Light light) {
    if (by_pieces()) return part.places;
    if (KIND == kPolygon) return int(light.r[2].w);
    return corner_count + 1;
}

struct Place {
    vec3 direction;
    bool joined;
};

//   i        counted by the turns of the walk, from 0
Place outline_place(Light light, mat3 frame, vec3 p, int i) {
    Place place;
    if (by_pieces()) {
        vec4 v = parts[part.first + kPartHeader + i];
        place.direction = polygon_direction(transform_transposed(frame, v.xyz));
        place.joined = v.w > 0.5;
    } else if (KIND == kPolygon) {
        uint at = uint(light.r[0].w) + uint(i);
        // A walk in pieces goes on from the place at which each thread's edges ran out of space.
        if (!CHUNKED) at = in_common(at);
        vec4 v = texelFetch(vertices, int(at));
        place.direction = polygon_direction(transform_transposed(frame, v.xyz - p));
        place.joined = v.w > 0.5;
    } else {
        place.direction = corners[i > 0 ? i - 1 : corner_count - 1];
        place.joined = i > 0;
    }
    return place;
}

#include "edges.glsl"

// State of a walk that fills the edges until their space is used up.
struct ClippedWalk {
    int next;
    vec3 previous;
    HorizonClip clip;
    bool more;
};

ClippedWalk clipped_walk_begin(Light light, mat3 frame, vec3 p) {
    ClippedWalk walk;
    walk.next = 1;
    walk.previous = outline_place(light, frame, p, 0).direction;
    walk.clip = horizon_clip_begin();
    walk.more = true;
    return walk;
}

// Most edges that one place of the outline adds: an edge, and an arc in two parts. The outline's end adds no more.
const int kMostEdgesOfPlace = 3;

ClippedWalk fill_edges(ClippedWalk walk, Light light, Seen seen, mat3 frame, vec3 p) {
    edge_count = 0;
    float facing = seen.reversed ? -1.0 : 1.0;
    int count = outline_length(light);
    do {
        Place place = outline_place(light, frame, p, walk.next);
        vec3 from = place.joined ? walk.previous : place.direction;
        if (UNCUT) {
            add_edge(from, place.direction);
        } else {
            walk.clip = horizon_clip_edge(walk.clip, from, place.direction);
            add_edge(walk.clip.start, walk.clip.end);
            add_arc_of_horizon(walk.clip, facing);
        }
        walk.previous = place.direction;
        ++walk.next;
    } while (walk.next < count && (!CHUNKED || edge_count + 2 * kMostEdgesOfPlace <= EDGE_SPACE));
    if (walk.next >= count) {
        if (!UNCUT) {
            walk.clip = horizon_clip_finish(walk.clip);
            add_arc_of_horizon(walk.clip, facing);
        }
        walk.more = false;
    }
    return walk;
}

// Irradiance, from an irradiance vector, that reaches a diffuse lobe below a boundary. view: in the vector's frame.
float irradiance_below(vec3 e, vec3 view, float loss) { return loss > 0.0 ? lambert_irradiance_below(e, view, loss) : e.z; }
