// Decides if a pair of a round light and a blocker matters to a square of pixels, and if it occludes the light from all of it.
// Needs `lists`, `pairs` and `number`.
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.

float line_at(uint line, vec2 p) {
    return uintBitsToFloat(pairs[line]) * p.x + (uintBitsToFloat(pairs[line + 1u]) * p.y - uintBitsToFloat(pairs[line + 2u]));
}

// p: the square's centre relative to the light's; reach: half its side, plus the most by which rounding may move a line.
bool pair_touches(uint pair, vec2 p, float reach) {
    return min(line_at(pair, p), min(line_at(pair + 3u, p), line_at(pair + 6u, p))) >= -reach;
}
bool pair_hides(uint pair, vec2 p, float reach) {
    return min(line_at(pair + 9u, p), min(line_at(pair + 12u, p), line_at(pair + 15u, p))) > reach;
}

// Centre of one of a disk's tiles relative to the disk's, and the reach of tiles.
vec2 tile_from_disk(uint disk, uint cell) {
    uint across = lists[disk + uint(kDiskTiles) + 2u];
    uint column = lists[disk + uint(kDiskTiles)] + cell % across;
    uint row = lists[disk + uint(kDiskTiles) + 1u] + cell / across;
    return (vec2(float(column), float(row)) * 16.0 + 8.0) * vec2(number(0u), number(1u)) - vec2(number(disk + uint(kDiskCorner)), number(disk + uint(kDiskCorner) + 1u));
}
float reach_of_tile() { return 7.5 * max(number(0u), number(1u)) + number(2u); }
