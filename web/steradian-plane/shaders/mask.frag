// One word of a disk's masks, as shaders/plane/plane_lists.comp writes them: of each tile whether one blocker hides the disk from all of it, then a
// bit a pair.
#include "../../../shaders/plane/plane_layout.glsl"
#include "textures.glsl"
flat in uint disk;
out uint mask;

float number(uint at) { return uintBitsToFloat(lists[at]); }
#include "../../../shaders/plane/plane_mask.glsl"

void main() {
    uint first = lists[disk + uint(kDiskFirstPair)];
    uint count = lists[disk + uint(kDiskPairs)];
    uint words = (count + 31u) / 32u + 1u;
    // Below the disk's first word this wraps, and is beyond its last.
    uint at = uint(gl_FragCoord.y) * 2048u + uint(gl_FragCoord.x) - lists[disk + uint(kDiskMasks)];
    uint cell = at / words;
    uint word = at % words;
    if (cell >= lists[disk + uint(kDiskTiles) + 2u] * lists[disk + uint(kDiskTiles) + 3u]) discard;
    vec2 p = tile_from_disk(disk, cell);
    float reach = reach_of_tile();
    uint found = 0u;
    uint begin = word == 0u ? 0u : 32u * (word - 1u);
    uint end = word == 0u ? count : min(begin + 32u, count);
    for (uint i = begin; i < end; i++) {
        uint pair = (first + i) * uint(kPair);
        if (word == 0u)
            found |= pair_hides(pair, p, reach) ? 1u : 0u;
        else
            found |= pair_touches(pair, p, reach) ? 1u << (i & 31u) : 0u;
    }
    mask = found;
}
