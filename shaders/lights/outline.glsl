// The only walk: edges of a light in walk order, as a point sees them, whole or above the horizon. Nothing is stored from edge to edge, so
// a lobe that needs two walks makes two: private arrays would live in memory.
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.

// The polygon that replaces a round light, gathered about a lobe.
EllipseFan ellipse_fan_about;
CapsuleFan capsule_fan_about;
vec2 corner_here;         // an ellipse's corner, and its gap to the one before
float corner_gap_before;
const int kCornersNearRim = 32;
bool has_corners() { return KIND != kPolygon && !by_pieces(); }
bool has_ellipse() { return KIND != kCapsule && has_corners(); }
int corner_count() { return has_ellipse() && ellipse_fan_about.near ? kCornersNearRim : CORNERS; }

//   axis, width  of the lobe, in the shading frame
void prepare_corners(Light light, mat3 frame, vec3 p, vec3 axis, float width) {
    if (KIND == kCapsule) {
        capsule_fan_about = capsule_fan(capsule_in(light, frame, p), axis, width, CORNERS);
    } else {
        ellipse_fan_about = ellipse_fan_concentrated(ellipse_in(frame), axis, width);
        if (NEAR_RIM == 0) ellipse_fan_about.near = false;  // the host knows that no point of the tile is near the rim
    }
}

// The turns of a walk: from outline_first() up to, but not including, outline_length(). Those before turn 1 prepare the first edge.
int outline_first() { return has_ellipse() ? -2 : 0; }
int outline_length(Light light) {
    if (by_pieces()) return part.places;
    if (KIND == kPolygon) return int(light.r[2].w);
    return corner_count() + 1;
}

struct Place {
    vec3 direction;
    bool joined;  // a contour begins at each place that is not; the first is one of them
};

// transform_transposed for a right-handed frame, without its y, which would take registers.
vec3 into_frame(mat3 frame, vec3 d) { return vec3(dot(frame[0], d), dot(frame[2], cross(frame[0], d)), dot(frame[2], d)); }

// The place of one turn. An ellipse's corners need their neighbours, so its turns come one after another.
Place outline_place(Light light, mat3 frame, vec3 p, int i) {
    Place place;
    if (by_pieces()) {
        vec4 v = parts[part.first + kPartHeader + i];
        place.direction = polygon_direction(into_frame(frame, v.xyz));
        place.joined = v.w > 0.5;
    } else if (KIND == kPolygon) {
        vec4 v = vertices[in_common(uint(light.r[0].w) + uint(i))];
        place.direction = polygon_direction(into_frame(frame, v.xyz - p));
        place.joined = v.w > 0.5;
    } else if (KIND == kCapsule) {
        place.direction = polygon_direction(capsule_fan_corner(capsule_fan_about, i > 0 ? i - 1 : CORNERS - 1));
        place.joined = i > 0;
    } else {
        int count = corner_count();
        vec2 after = ellipse_corner(ellipse_fan_about, i < 0 ? i + count : i < count ? i : 0, count);
        float gap = ellipse_gap(corner_here, after);
        place.direction = polygon_direction(ellipse_corner_between(ellipse_fan_about, corner_here, corner_gap_before + gap));
        place.joined = i > 0;
        corner_here = after;
        corner_gap_before = gap;
    }
    return place;
}

// The edge that ends at the place of the last turn. Degenerate where a contour begins.
vec3 edge_begin;
vec3 edge_end;
void next_edge(Light light, mat3 frame, vec3 p, int i) {
    Place place = outline_place(light, frame, p, i);
    edge_begin = place.joined ? edge_end : place.direction;
    edge_end = place.direction;
}

#include "edges.glsl"

// The edges above the horizon, with the arcs of the horizon that close them:
//
//   begin_clip(facing);
//   for (int i = outline_first(); i < clipped_length(light); i++) {
//       if (!clipped_place(light, frame, p, i)) continue;
//       do { use clip_begin, clip_end if has_clipped_edge() } while (!UNCUT && next_arc());
//   }
int clipped_length(Light light) { return outline_length(light) + (UNCUT ? 0 : 1); }  // the last turn closes the outline

bool clipped_place(Light light, mat3 frame, vec3 p, int i) {
    bool closes = !UNCUT && i == outline_length(light);
    if (closes)
        edge_begin = edge_end;
    else
        next_edge(light, frame, p, i);
    if (i < 1) return false;
    if (UNCUT)
        put_edge(edge_begin, edge_end);
    else
        put_clipped(edge_begin, edge_end, closes);
    return true;
}

// Irradiance, from an irradiance vector, that reaches a diffuse lobe below a boundary. view: in the vector's frame.
float irradiance_below(vec3 e, vec3 view, float loss) { return loss > 0.0 ? lambert_irradiance_below(e, view, loss) : e.z; }
