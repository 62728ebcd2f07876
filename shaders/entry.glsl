// Which pixel a thread has, and which lights: a work group is 64 pixels of a square of an entry of the lists.
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.

struct Entry {
    uint tile;
    uint slot;
    uint first;  // of its lights in the lists
    uint count;
    uint own;    // where the lobe begins that it is about: own_lobe.glsl
};

// The groups of a square lie below each other, those of two squares side by side in turn.
uint group_of_square(uint square, uint row) { return (square / 2u * uint(kGroupsOfSquare) + row) * 2u + square % 2u; }

// A value that all threads of a work group have in common, so that the compiler sees it: llvmpipe then reads there once, not for each thread.
//
// Right for what follows from the group's number, from the lists and from how often loops have turned, also where threads have left
// or skipped something: a subgroup lies within a work group, and its operations take in the threads alone that stand at the same turn
// of each loop around them (of SPIR-V, one dynamic instance), so that the first of these tells the others what they have. Not right
// for a place at which each thread arrives in its own number of turns.
uint in_common(uint value) { return subgroupBroadcastFirst(value); }

uint listed(uint at) { return texelFetch(lists, int(in_common(at))).x; }

Entry entry_here() {
    uint at = (first_entry + gl_WorkGroupID.y) * uint(kEntry);
    uint square = listed(at);
    Entry entry;
    entry.tile = square / uint(kSquares);
    entry.slot = group_of_square(square % uint(kSquares), gl_WorkGroupID.x) * uint(kGroup) + gl_LocalInvocationID.x;
    entry.first = listed(at + 1u);
    entry.count = listed(at + 2u);
    entry.own = listed(at + 3u);
    return entry;
}
