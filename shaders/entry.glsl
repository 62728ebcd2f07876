// The pixel of a thread, and its lights. A work group covers 64 pixels of a square of an entry of the lists.
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.

struct Entry {
    uint tile;
    uint slot;
    uint first;  // place of its lights in the lists
    uint count;
    uint own;    // place where the entry's lobe begins: own_lobe.glsl
};

// Groups of one square lie below each other; groups of two squares lie side by side in turn.
uint group_of_square(uint square, uint row) { return (square / 2u * uint(kGroupsOfSquare) + row) * 2u + square % 2u; }

// Returns a value that all threads of a work group have in common, so that the compiler knows it. llvmpipe then reads there once, not once
// for each thread.
//
// Valid for values that follow from the group's number, from the lists and from the number of turns of loops. This also holds where threads
// have returned or skipped something. A subgroup lies within a work group. Its operations include only the threads at the same turn of each
// loop around them (one dynamic instance of SPIR-V). So the first of these has the others' value. Not valid at a place that each thread
// reaches after its own number of turns.
uint in_common(uint value) { return subgroupBroadcastFirst(value); }

uint listed(uint at) { return lists[in_common(at)]; }

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
