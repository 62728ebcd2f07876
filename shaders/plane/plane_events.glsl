// A round light's blockers by event lines (source/plane/frame/events/event_lines.h).
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.

float number_of_pair(uint pair, int line, int i) { return uintBitsToFloat(pairs[pair + uint(line * 3 + i)]); }
float pair_line(uint pair, int line, vec2 p) {
    return number_of_pair(pair, line, 0) * p.x + (number_of_pair(pair, line, 1) * p.y - number_of_pair(pair, line, 2));
}

// A vertex relative to the tile's centre.
vec2 vertex_at(uint number, vec4 center) {
    vec4 v = vertices[number];
    return vec2((v.x - center.x) + (v.y - center.y), (v.z - center.z) + (v.w - center.w));
}

// The ends of a pair's round blocker; its centre is the vertex `first`.
PlaneRoundEnds round_ends(uint pair, uint first, vec2 p, vec2 light, vec4 center) {
    vec2 from_light = vertex_at(first, center) - light;
    return plane_round_ends(-p, from_light - p, from_light, uintBitsToFloat(pairs[pair + uint(kPairRadius)]));
}

// Places of a round blocker's ends.
vec2 round_places(uint pair, uint first, vec2 p, vec2 light, vec4 center) {
    PlaneRoundEnds e = round_ends(pair, first, p, light, center);
    if (!e.begins_ahead && !e.ends_ahead) return vec2(1.0, -1.0);
    return vec2(e.begins_ahead ? e.begin : -1.0e6, e.ends_ahead ? e.end : 1.0e6);
}

// Places of the ends of a blocker with corners. A vertex behind the pixel is beyond all of the light, on that side of the blocker's nearest
// point, which is ahead.
vec2 polygon_places(uint pair, uint first, uint count, vec2 p, vec2 light, vec4 center) {
    vec3 line = vec3(number_of_pair(pair, 2, 0), number_of_pair(pair, 2, 1), number_of_pair(pair, 2, 2));
    vec2 near = line.xy * (line.z / dot(line.xy, line.xy)) - p;
    vec2 places = vec2(1.0e6, -1.0e6);
    turns += int(count);
    for (uint k = 0u; k < count; k++) {
        vec2 v = vertex_at(first + k, center);
        vec2 from_eye = v - eye;
        vec2 from_light = v - light;
        float across = from_light.y * from_eye.x - from_light.x * from_eye.y;
        float place = across * inversesqrt(max(dot(from_eye, from_eye), smallest_divisor()));
        if (!(dot(p, from_eye) < 0.0)) place = plane_beyond(cross2(near, from_eye));
        places = vec2(min(places.x, place), max(places.y, place));
    }
    return places;
}

// A blocker within the light, or one for which no line decides.
void take_within(uint pair, vec2 p, vec2 light, vec4 center) {
    if (!(pair_line(pair, 2, p) > 0.0)) return;
    uint first = pairs[pair + uint(kPairFirst)];
    uint kind = pairs[pair + uint(kPairKind)];
    vec2 places;
    if ((kind & 255u) == 1u)
        places = round_places(pair, first, p, light, center);
    else
        places = polygon_places(pair, first, kind >> 8, p, light, center);
    take(places.x, places.y);
}

// Occludes everything from one end of the light up to the blocker's end, or down to its beginning.
void take_end(uint pair, bool from_low, vec2 p, vec2 light, vec4 center) {
    uint first = pairs[pair + uint(kPairFirst)];
    uint kind = pairs[pair + uint(kPairKind)];
    if ((kind & 255u) == 1u) {
        PlaneRoundEnds e = round_ends(pair, first, p, light, center);
        if (from_low)
            low = max(low, e.end);
        else
            high = min(high, e.begin);
        return;
    }
    uint chain = pairs[pair + uint(kPairChain)] >> (from_low ? 0 : 16);
    uint count = kind >> 8;
    uint k = chain & 255u;
    uint more = (chain >> 8) & 255u;
    turns += int(more);
    for (; more > 0u; more--) {
        vec2 v = vertex_at(first + k, center);
        float place = plane_place_on_light(v - light, v - eye);
        low = from_low ? max(low, place) : low;
        high = from_low ? high : min(high, place);
        k = k + 1u < count ? k + 1u : 0u;
    }
}

// Cuts out what one pair occludes, decided by the lines that the pixel is clear of.
void take_pair(uint pair, vec2 p, vec2 light, vec4 center, float slack) {
    ++turns;
    float separator = pair_line(pair, 2, p);
    if (pair_line(pair, 0, p) < -slack || pair_line(pair, 1, p) < -slack || separator < -slack) return;
    bool beyond = separator > slack && pair_line(pair, 5, p) > slack;
    bool from_low = beyond && pair_line(pair, 3, p) > slack;
    bool to_high = beyond && pair_line(pair, 4, p) > slack;
    if (from_low && to_high)
        high = low;
    else if (from_low || to_high)
        take_end(pair, from_low, p, light, center);
    else
        take_within(pair, p, light, center);
}

// Light from the part that is left of a light.
float share_left(DiskView view) {
    float sum = 0.0;
    float from = max(low, -view.reach);
    high = min(high, view.reach);
    for (int k = 0; k <= taken; k++) {
        float to = gap_end(k);
        if (to > from) sum += disk_share(view, disk_slope(view, from), disk_slope(view, to));
        from = after_gap(k, from);
    }
    turns += taken + 1;
    return max(sum, 0.0) * inverse_two_pi();
}

#if KIND == PLANE_DISKS

vec3 event_light(uint at, vec4 center) {
    vec2 light = pair_of_numbers(at);
    DiskView view = disk_view(light, number(at + 2u), number(at + 3u));
    uint count = lists[at + 7u];
    open_cut(-view.reach, view.reach);
    for (uint i = 0u; i < count && low < high; i++)
        take_pair(lists[at + uint(kDiskLight) + i] * uint(kPair), eye - light, light, center, number(2u));
    return colour_at(at + 4u) * share_left(view);
}

#else

// Uses the lists that shaders/plane/plane_lists.comp has computed.
vec3 listed_light(uint at, vec4 center) {
    uint disk = lists[at];
    uint mask_at = lists[at + 1u];
    if (masks[mask_at] == 1u) return vec3(0.0);  // occluded from all of the tile
    vec2 light = vec2((number(disk) - center.x) + (number(disk + 1u) - center.y), (number(disk + 2u) - center.z) + (number(disk + 3u) - center.w));
    DiskView view = disk_view(light, number(disk + 4u), number(disk + 5u));
    uint first = lists[disk + uint(kDiskFirstPair)];
    uint words = (lists[disk + uint(kDiskPairs)] + 31u) / 32u;
    open_cut(-view.reach, view.reach);
    for (uint w = 0u; w < words && low < high; w++) {
        uint left = masks[mask_at + 1u + w];
        ++turns;
        while (left != 0u && low < high) {
            uint i = 32u * w + uint(findLSB(left));
            left &= left - 1u;
            take_pair((first + i) * uint(kPair), eye - light, light, center, number(2u));
        }
    }
    return colour_at(disk + 6u) * share_left(view);
}

#endif
