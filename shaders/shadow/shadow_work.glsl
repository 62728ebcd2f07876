// The work of a space, for reports: COUNTS is 1. Lanes of a wave wait for each other, so turns of loops are those of kTogether lanes.
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.

const int kTogether = FEW == 1 ? 16 : 64;
int looks_counted;  // at eight segments
int near_counted;
int open_counted;
int near_turns;
int crossing_turns;
int sort_turns;
#define SETS (SPACE / kSetOfPairs + 2)
shared int most_turns[COUNTS * SETS * int(POINTS) + 1];  // of the lanes so far, for each set of pairs
int most_crossings;

void begin_counting() {
    looks_counted = 0;
    near_counted = 0;
    open_counted = 0;
    near_turns = 0;
    crossing_turns = 0;
    sort_turns = 0;
    most_crossings = 0;
    if (COUNTS == 1)
        for (int i = int(LANE); i < SETS; i += LANES) most_turns[MINE * SETS + i] = 0;
}

void count_turns(int set, int near) {
    if (COUNTS == 0) return;
    int most = most_of_lanes(near);
    near_counted += sum_of_lanes(near);
    if (LANE == 0u) most_turns[MINE * SETS + set] = max(most_turns[MINE * SETS + set], most);
    subgroupBarrier();
}

void count_crossings(int steps) { most_crossings = max(most_crossings, steps); }

// After each turn of all lanes.
void add_turns(int first) {
    if (COUNTS == 0 || ((first + LANES) % kTogether != 0 && first + LANES < segment_count)) return;
    crossing_turns += most_crossings;
    most_crossings = 0;
    for (int set = 0; set < SETS; set++) {
        near_turns += most_turns[MINE * SETS + set];
        most_turns[MINE * SETS + set] = 0;
    }
}

// Adds a point's work to the sums of the space.
void count_work(uint edges, uint triangles) {
    if (LANE > 0u) return;
    uint at = uint(kWork) * space;
    atomicAdd(work[at], edges);
    atomicAdd(work[at + 1u], triangles);
    atomicAdd(work[at + 2u], uint(segment_count));
    atomicAdd(work[at + 3u], uint(segment_count * segment_count + kPairUnit / 2) / uint(kPairUnit));
    atomicAdd(work[at + 4u], uint(near_counted));
    atomicAdd(work[at + 5u], uint(open_counted));
    atomicAdd(work[at + 6u], uint(looks_counted));
    atomicAdd(work[at + 7u], uint(near_turns));
    atomicAdd(work[at + 8u], uint(sort_turns));
    atomicAdd(work[at + 9u], uint(crossing_turns));
}
