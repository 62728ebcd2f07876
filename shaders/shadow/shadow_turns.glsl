// Budget of turns that the loops for a point may take.
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.

// Software devices silently end a thread's loops after 65,535 turns in all. The lanes of a subgroup turn together, and a loop that ends at
// once takes a turn as well. So a turn looks at eight segments. The rest of the budget is for near pairs, for pairs for which floats are not
// enough, for the sorting of crossings and for coincident sections.
const int kSetOfPairs = 32;  // pairs of a segment whose results are bits of one number
const int kMostTurns = 62000;
int turns;  // remaining budget

// An edge takes as many turns as a triangle. A segment takes a look at all others, kSetOfPairs at a time, and six loops and their ends.
// Region and record go through segments and pieces fourteen times.
int turns_left(uint edges, uint triangles) {
    int gathered = int(6u * (edges / uint(LANES) + triangles / uint(LANES) + 2u)) + kMostIncidences;
    int own = SPACE / LANES + 1;
    int cut = own * (SPACE / kAtOnce + 4 * (SPACE / kSetOfPairs + 1) + 6 + 2 + 14 + SPACE / kAtOnce + 16);
    return kMostTurns - gathered - cut;
}
