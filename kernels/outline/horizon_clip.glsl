// Clipping a walked outline to the horizon, for integrals along its edges.
//
// Lambert's integral needs only the length of the arcs of the horizon that close a clipped outline
// (polygon_add_edge); every other boundary integral has to be taken along them. The clip hands them out as ordinary
// edges: where the outline comes back up, the arc from where it last went down. An outline that begins below the
// horizon comes up before it was seen to go down: this first entry is kept, and the last arc ends there.
// The arcs of a plane light lie on one half circle, and what counts is the signed sum over them; so arcs may join
// different contours, and one clip serves a whole light with its holes:
//
//   HorizonClip clip = horizon_clip_begin();
//   for each edge a, b of each contour:
//       clip = horizon_clip_edge(clip, a, b);
//       integrate clip.start, clip.end
//       if (any_lane(clip.closes)) integrate clip.arc_start, clip.arc_end
//   clip = horizon_clip_finish(clip);
//   if (any_lane(clip.closes)) integrate clip.arc_start, clip.arc_end
// each arc in two where it is wide (horizon_arc_wide, horizon_arc_middle)
//
// Frame: z the surface normal; unit directions (polygon_direction) in walk order.
// Needs: constants.glsl
// Topics: horizon
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.

// The state of a clip and what it last handed out.
//   start, end          the edge's part above the horizon; equal where there is none
//   arc_start, arc_end  an arc of the horizon that belongs to the outline; equal where there is none
//   closes              whether there is an arc
//   leave               where the outline last went down and did not come back yet; zero: nowhere
//   entry               where it came up without having been seen to go down; zero: nowhere
struct HorizonClip {
    vec3 start;
    vec3 end;
    vec3 arc_start;
    vec3 arc_end;
    mask closes;
    vec3 leave;
    vec3 entry;
};

// The state before the first edge.
HorizonClip horizon_clip_begin() {
    vec3 nowhere = vec3(0.0, 0.0, 0.0);
    HorizonClip clip;
    clip.start = nowhere;
    clip.end = nowhere;
    clip.arc_start = nowhere;
    clip.arc_end = nowhere;
    clip.closes = mask_none();
    clip.leave = nowhere;
    clip.entry = nowhere;
    return clip;
}

// The direction in which the edge from a to b crosses the plane z = 0; their z must differ in sign.
//
// Degenerate: an edge through the zenith's axis, or an end that is the zero vector, has no azimuth and gives zero.
// Error: weights of one sign, so nothing cancels unless a and b are nearly opposite.
vec3 horizon_crossing(vec3 a, vec3 b) {
    real wa = abs(b.z);
    real wb = abs(a.z);
    vec2 p = vec2(a.x * wa + b.x * wb, a.y * wa + b.y * wb);
    p = p * inversesqrt(max(dot(p, p), smallest_square()));
    return vec3(p.x, p.y, 0.0);
}

// True where an arc from a to b may be nearly half the horizon: integrals take it in two.
mask horizon_arc_wide(vec3 a, vec3 b) { return dot(a, b) < -0.9999; }

// A direction between the ends of an arc of the horizon that is wider than a right angle.
//
//   a, b     unit directions of its ends, z = 0
//   facing   1.0; -1.0 where the light is seen from behind, so that the walk ran the wrong way round
//
// Two ends that are opposite to rounding say no more which half of the horizon is meant: it is the one that the walk goes round the
// zenith, as the arcs that close an outline do.
// Degenerate: equal ends give a zero vector.
vec3 horizon_arc_middle(vec3 a, vec3 b, real facing) {
    real unsure = 1.0e-6;
    if (real_digits() > 24) {
        unsure = 1.0e-14;
    }
    vec2 across = vec2(b.y - a.y, a.x - b.x) * facing;
    real turn = (a.x * b.y - a.y * b.x) * facing;
    across = across * (inversesqrt(max(dot(across, across), smallest_square())) * select(turn < -unsure, -1.0, 1.0));
    return vec3(across.x, across.y, 0.0);
}

// Clips one edge.
//
//   a, b     unit directions of the edge's ends; z < 0 is below
//   returns  the state with start, end and, where the edge crosses and an arc is due, the arc
HorizonClip horizon_clip_edge(HorizonClip clip, vec3 a, vec3 b) {
    HorizonClip next = clip;
    mask a_below = a.z < 0.0;
    mask b_below = b.z < 0.0;
    next.start = a;
    next.end = b;
    next.closes = mask_none();
    if (any_lane(a_below || b_below)) {
        vec3 nowhere = vec3(0.0, 0.0, 0.0);
        vec3 crossing = horizon_crossing(a, b);
        next.start = select(a_below, crossing, a);
        next.end = select(b_below, crossing, b);  // both below: start = end
        mask comes_up = a_below && !b_below;
        mask goes_down = b_below && !a_below;
        mask was_left = dot(clip.leave, clip.leave) > 0.5;
        // Going down twice: a contour ended below and the next began above. The first one's last arc is due.
        mask due = goes_down && was_left;
        next.closes = (comes_up && was_left) || due;
        next.arc_end = select(due, clip.entry, crossing);
        next.arc_start = select(next.closes, clip.leave, next.arc_end);
        next.leave = select(goes_down, crossing, select(comes_up, nowhere, clip.leave));
        next.entry = select(comes_up && !was_left, crossing, select(due, nowhere, clip.entry));
    }
    return next;
}

// Ends the walk: the last arc, from where the outline went down to where it had first come up.
HorizonClip horizon_clip_finish(HorizonClip clip) {
    HorizonClip next = clip;
    next.closes = dot(clip.leave, clip.leave) > 0.5 && dot(clip.entry, clip.entry) > 0.5;
    next.start = clip.end;
    next.arc_start = select(next.closes, clip.leave, clip.entry);
    next.arc_end = clip.entry;
    return next;
}
