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

Entry entry_here() {
    uint at = (first_entry + gl_WorkGroupID.y) * uint(kEntry);
    uint square = lists[at];
    Entry entry;
    entry.tile = square / uint(kSquares);
    entry.slot = group_of_square(square % uint(kSquares), gl_WorkGroupID.x) * uint(kGroup) + gl_LocalInvocationID.x;
    entry.first = lists[at + 1u];
    entry.count = lists[at + 2u];
    entry.own = lists[at + 3u];
    return entry;
}
