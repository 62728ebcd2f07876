// The part of an edge above the horizon, and the arcs of the horizon that close an outline, one after another.
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.

vec3 clip_begin;  // the current edge
vec3 clip_end;
// HorizonClip from edge to edge, without what the next edge does not need: places of the horizon have z = 0.
vec2 clip_leave;
vec2 clip_entry;
float clip_facing;  // -1.0 where the light is seen from behind
vec2 arc_begin;
vec2 arc_end;
int arcs_left;  // a wide arc is taken in two

void begin_clip(float facing) {
    clip_leave = vec2(0.0);
    clip_entry = vec2(0.0);
    clip_facing = facing;
}

void put_edge(vec3 a, vec3 b) {
    clip_begin = a;
    clip_end = b;
    arcs_left = 0;
}

//   closes   the outline ends: there is no edge, but there may be an arc
void put_clipped(vec3 a, vec3 b, bool closes) {
    HorizonClip clip = horizon_clip_begin();
    clip.leave = vec3(clip_leave, 0.0);
    clip.entry = vec3(clip_entry, 0.0);
    if (closes)
        clip = horizon_clip_finish(clip);
    else
        clip = horizon_clip_edge(clip, a, b);
    put_edge(clip.start, clip.end);
    clip_leave = clip.leave.xy;
    clip_entry = clip.entry.xy;
    arc_begin = clip.arc_start.xy;
    arc_end = clip.arc_end.xy;
    if (clip.closes) arcs_left = horizon_arc_wide(clip.arc_start, clip.arc_end) ? 2 : 1;
}

bool has_clipped_edge() {
    vec3 chord = clip_end - clip_begin;
    return dot(chord, chord) > smallest_divisor();
}

// Goes on to the next arc of the horizon; a thread without one gets an edge without length. False: no thread has one. Threads that leave a
// loop together need fewer registers, since none keeps its sums while others go on.
bool next_arc() {
    clip_begin = clip_end;
    if (arcs_left > 0) {
        clip_begin = vec3(arc_begin, 0.0);
        clip_end = vec3(arc_end, 0.0);
        if (arcs_left == 2) clip_end = horizon_arc_middle(clip_begin, clip_end, clip_facing);
        arc_begin = clip_end.xy;
    }
    bool there = arcs_left > 0;
    --arcs_left;
    return subgroupBallot(there) != uvec4(0u);
}
