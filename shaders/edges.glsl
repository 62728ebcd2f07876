// Edges above the horizon, including the arcs of the horizon that close them.
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.

vec3 edge_begins[EDGE_SPACE];
vec3 edge_ends[EDGE_SPACE];
int edge_count;

void add_edge(vec3 a, vec3 b) {
    vec3 chord = b - a;
    if (dot(chord, chord) > smallest_divisor() && edge_count < EDGE_SPACE) {
        edge_begins[edge_count] = a;
        edge_ends[edge_count] = b;
        ++edge_count;
    }
}

void add_arc_of_horizon(HorizonClip clip, float facing) {
    if (!clip.closes) return;
    vec3 start = clip.arc_start;
    if (horizon_arc_wide(start, clip.arc_end)) {
        vec3 middle = horizon_arc_middle(start, clip.arc_end, facing);
        add_edge(start, middle);
        start = middle;
    }
    add_edge(start, clip.arc_end);
}
