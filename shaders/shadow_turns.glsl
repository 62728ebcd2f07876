// Budget of turns that the loops for a point may take.
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.

// Software devices silently end a thread's loops after 65,535 turns in all. The lanes of a subgroup turn together, and a loop that ends at
// once takes a turn as well. So a turn looks at four segments, and a second loop handles those for which floats are not enough. The rest
// of the budget is for pairs that need a close look, two turns each, for the sorting of crossings and for coincident sections.
const int kAtOnce = 4;
const int kMostTurns = 62000;
const int kMostIncidences = 1024;  // tile_shadows.cpp
int turns;  // remaining budget

// Capacities for segments that may cross a segment, or the left ray from its middle, and for those that do cross it.
const int kClose = 256;
const int kCrossings = 96;

// A triangle takes half more turns than an edge. A segment takes a look at all others, pieces between crossings (again where lanes gather
// them), and five loops and their ends. Region and record go through segments and pieces fourteen times.
int turns_left(uint edges, uint triangles) {
    int gathered = int(4u * (edges / LANES + 1u) + 6u * (triangles / LANES + 1u)) + kMostIncidences;
    int own = SEGMENT_SPACE / int(LANES) + 1;
    int cut = own * (SEGMENT_SPACE / kAtOnce + 2 * kCrossings + 5 + 14);
    return kMostTurns - gathered - cut;
}
