// The region that the pieces bound: tests if it is thin, and finds a place well inside it.
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.

const float kThin = 1.0 / 4096.0;
const int kTrials = 4;
const int kNoPiece = 1 << 20;

bool region_is_wide() {
    float twice = 0.0;
    float perimeter = 0.0;
    for (int i = int(LANE); i < piece_count; i += LANES) {
        vec4 p = piece_ends(i) / shadow_cells();
        vec2 d = p.zw - p.xy;
        twice += p.x * d.y - p.y * d.x;
        perimeter += length(d);
    }
    vec2 sums = sum_of_lanes(vec2(twice, perimeter));
    return sums.x > 2.0 * kThin * sums.y;
}

// Distance from a place along a unit direction to the next segment except `but`.
float distance_to_next(vec2 from, vec2 n, int but) {
    float nearest = 1.0e30;
    for (int i = int(LANE); i < segment_count; i += LANES) {
        vec2 a = cells[FIRST + i].xy;
        vec2 f = cells[FIRST + i].zw - a;
        vec2 p = a - from;
        float det = n.x * f.y - n.y * f.x;
        float inverse = 1.0 / (det != 0.0 ? det : 1.0);
        float distance = (p.x * f.y - p.y * f.x) * inverse;
        float t = (p.x * n.y - p.y * n.x) * inverse;
        if (i != but && det != 0.0 && distance > 0.0 && t >= 0.0 && t <= 1.0) nearest = min(nearest, distance);
    }
    return least_of_lanes(vec2(nearest)).x;
}

// Distance of a place from all segments, or 0 if its count is above the level or uncertain.
float room_at(vec2 q, int base) {
    float least2 = 1.0e30;
    int count = 0;
    bool certain = true;
    for (int i = int(LANE); i < segment_count; i += LANES) {
        vec4 s = cells[FIRST + i];
        vec2 f = s.zw - s.xy;
        vec2 p = q - s.xy;
        vec2 r = p - clamp(dot(p, f) / max(dot(f, f), 1.0), 0.0, 1.0) * f;
        least2 = min(least2, dot(r, r));
        // The place is not in whole numbers, so differences round as well.
        float a = f.x * p.y;
        float b = f.y * p.x;
        if (is_across(s, q.y)) {
            certain = certain && abs(a - b) > 1.0e-6 * (abs(a) + abs(b));
            count -= a < b ? weights[FIRST + i] : 0;
        }
    }
    certain = !any_of_lanes(!certain);
    count = base + sum_of_lanes(count);
    least2 = least_of_lanes(vec2(least2)).x;
    return certain && count <= level ? sqrt(least2) : 0.0;
}

// Tries places from the middles of the longest pieces along their normals, half way to the next segment. z: distance from all segments.
vec3 place_inside(int base) {
    vec3 best = vec3(0.0);
    float last = 1.0e30;
    int last_number = -1;
    for (int trial = 0; trial < kTrials; trial++) {
        float longest = 0.0;
        int number = kNoPiece;
        for (int i = int(LANE); i < piece_count; i += LANES) {
            vec4 p = piece_ends(i);
            vec2 d = p.zw - p.xy;
            float length2 = dot(d, d);
            if ((length2 < last || (length2 == last && i > last_number)) && length2 > longest) {
                longest = length2;
                number = i;
            }
        }
        last = -least_of_lanes(vec2(-longest)).x;
        number = least_of_lanes(longest == last ? number : kNoPiece);
        if (number == kNoPiece) break;
        last_number = number;
        vec4 p = piece_ends(number);
        vec2 n = vec2(p.y - p.w, p.z - p.x) * inversesqrt(last);
        vec2 middle = 0.5 * (p.xy + p.zw);
        float distance = distance_to_next(middle, n, piece_segments[FIRST + number]);
        if (distance > 1.0e9) continue;
        vec2 q = middle + 0.5 * distance * n;
        float room = room_at(q, base);
        if (room > best.z) best = vec3(q, room);
        if (best.z > shadow_cells() / 1024.0) break;
    }
    return best;
}
