// How many turns a thread's loops may take.
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.

// Software devices end a thread's loops after 65,535 turns in all, silently; eight threads turn together, and a loop that ends at once takes a
// turn as well. So a turn looks at four segments, and those for which floats are not enough are gone through afterwards: with a space of 256
// segments that takes a quarter of the turns, and 5,120 edges (tile_shadows.cpp), four turns each, a third. Of what the space and the group's
// edges leave, each of the eight has its share for pairs that are looked at closely, two turns each, and for the sorting of crossings: even if
// no two of them share a turn.
const int kAtOnce = 4;
const int kCrossings = 32;  // of one segment
const int kMostTurns = 62000;
const int kMostIncidences = 1024;  // tile_shadows.cpp
const int kThreadsAtOnce = 8;
int own_turns;
int most_own_turns;

// A triangle takes half more turns than an edge. Of a segment: a look at all others, pieces between crossings, five loops and their ends; and
// region and record go through segments and pieces fourteen times.
int turns_left(uint edges, uint triangles) {
    int gathered = int(4u * edges + 6u * triangles) + kMostIncidences;
    int cut = SEGMENT_SPACE * (SEGMENT_SPACE / kAtOnce + kCrossings + 5 + 14);
    return (kMostTurns - gathered - cut) / kThreadsAtOnce;
}
