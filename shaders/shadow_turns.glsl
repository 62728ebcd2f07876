// Budget of turns that the loops for a point may take.
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.

// Software devices silently end a thread's loops after 65,535 turns in all. The threads of a subgroup turn together, and a loop that ends
// at once takes a turn as well. So a turn looks at four segments, and a second loop handles those for which floats are not enough. With a
// capacity of 256 segments that takes a thread a quarter of the turns. 5,120 edges (tile_shadows.cpp), four turns each, take a third.
// The rest is for pairs that need a close look, two turns each, for the sorting of crossings and for coincident sections. Where each
// thread has its own point, each of eight has its fraction of the rest, even if no two of them share a turn.
const int kAtOnce = 4;
const int kMostTurns = 62000;
const int kMostIncidences = 1024;  // tile_shadows.cpp
const int kPointsAtOnce = LANES == 1u ? 8 : 1;
int turns;  // remaining budget

// Capacities for segments that may cross a segment, or the left ray from its middle, and for those that do cross it.
#ifdef MANY_EDGES
const int kClose = 256;
const int kCrossings = 96;
#else
const int kClose = 128;
const int kCrossings = 32;
#endif

// A triangle takes half more turns than an edge. A segment takes a look at all others, pieces between crossings (again where lanes gather
// them), and five loops and their ends. Region and record go through segments and pieces fourteen times.
int turns_left(uint edges, uint triangles) {
    int gathered = int(4u * (edges / LANES + 1u) + 6u * (triangles / LANES + 1u)) + kMostIncidences;
    int own = SEGMENT_SPACE / int(LANES) + (LANES == 1u ? 0 : 1);
    int cut = own * (SEGMENT_SPACE / kAtOnce + kCrossings * (LANES == 1u ? 1 : 2) + 5 + 14);
    return (kMostTurns - gathered - cut) / kPointsAtOnce;
}
