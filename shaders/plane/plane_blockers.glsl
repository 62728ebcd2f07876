// Blockers of the general rules: intervals of slopes from an axis that they occlude (source/plane/frame/tiles/tile_cut.h).
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.

// Components of v along the axis and across it.
vec2 along_axis(vec2 axis, vec2 v) { return vec2(dot(v, axis), cross2(axis, v)); }

float slope_to(vec2 axis, vec2 v) {
    vec2 c = along_axis(axis, v - eye);
    return c.y / c.x;
}

struct Interval {
    float from;
    float to;
};

// Slopes between two directions, p the clockwise one, that span less than half a turn. Empty where both are behind the pixel.
Interval between(vec2 p, vec2 q) {
    if (!(p.x > 1.0e-12 || q.x > 1.0e-12)) return Interval(1.0, 0.0);
    return Interval(slope(p.x, p.y, -kBeyond), slope(q.x, q.y, kBeyond));
}
Interval between_in_any_order(vec2 p, vec2 q) {
    bool swap = cross2(p, q) < 0.0;
    return between(swap ? q : p, swap ? p : q);
}

bool is_nearer(uint at) { return number(at) * eye.x + number(at + 1u) * eye.y + number(at + 2u) > 0.0; }

// Direction of the outermost of some vertices on one side.
vec2 outermost(uint at, uint count, float sign_of_side) {
    vec2 v = pair_of_numbers(at) - eye;
    for (uint i = 1u; i < count; i++) {
        vec2 c = pair_of_numbers(at + i * uint(kVertex)) - eye;
        if (cross2(v, c) * sign_of_side > 0.0) v = c;
    }
    return v;
}

// Slope of a tangent to a disk that lies in front of the axis.
float disk_tangent(vec2 axis, uint at, float side) {
    vec2 v = pair_of_numbers(at) - eye;
    float radius = number(at + 2u);
    float root = plane_root(max(dot(v, v) - radius * radius, 0.0));
    vec2 c = along_axis(axis, vec2(v.x * root - side * v.y * radius, v.y * root + side * v.x * radius));
    return c.y / c.x;
}

// An ellipse: centre, half axes x and y, rows of the map to the unit circle.
struct Round {
    vec2 center;
    vec2 axis_x;
    vec2 axis_y;
    vec2 row_u;
    vec2 row_v;
};
Round round_at(uint at) {
    return Round(pair_of_numbers(at), pair_of_numbers(at + 2u), pair_of_numbers(at + 4u), pair_of_numbers(at + 6u),
                 pair_of_numbers(at + 8u));
}
vec2 to_unit(Round r, vec2 v) { return vec2(dot(r.row_u, v), dot(r.row_v, v)); }
vec2 from_unit(Round r, vec2 n) { return r.axis_x * n.x + r.axis_y * n.y; }
float outside2(vec2 unit) { return dot(unit, unit) - 1.0; }

// Tangent direction from the pixel, given in unit space: the centre's direction turned by the angle whose sine is 1 / d. It turns to the
// clockwise side (1) or the other (-1).
vec2 tangent_direction(Round r, vec2 unit, float side) {
    float tangent = sqrt(max(outside2(unit), 0.0));
    return from_unit(r, vec2(-unit.x * tangent - side * unit.y, -unit.y * tangent + side * unit.x));
}

// A line runs from the eye through a point, which is at fraction 1. Returns the fraction at which it enters the ellipse.
float entry_before(Round r, vec2 unit, vec2 v) {
    vec2 n = to_unit(r, v);
    return min(max(outside2(unit), 0.0) / max(dot(n, n), smallest_divisor()), 1.0);
}

const Interval kNone = Interval(1.0, 0.0);

// A round blocker that overlaps the light. The nearer one of the two changes only at a crossing that is visible on both. Returns what the
// blocker takes from crossing i on.
Interval taken_by_lens(uint at, uint light, vec2 axis, int i) {
    Round r = round_at(at);
    int count = int(lists[at + 10u]);
    uint crossings = at + 11u;
    vec2 unit = to_unit(r, eye - r.center);
    vec2 p = along_axis(axis, tangent_direction(r, unit, 1.0));
    vec2 q = along_axis(axis, tangent_direction(r, unit, -1.0));
    float first = slope(p.x, p.y, -kBeyond);
    float last = slope(q.x, q.y, kBeyond);
    if (!(outside2(unit) > 0.0 && (p.x > 1.0e-12 || q.x > 1.0e-12) && first < last)) return kNone;
    bool seen[4];
    float places[4];
    bool any_seen = false;
    for (int k = 0; k < count; k++) {
        uint c = crossings + uint(k * kCrossing);
        vec2 v = pair_of_numbers(c) - eye;
        // One that rounding hides counts: it is at the end of what is visible, and decides the order there.
        float slack = 1.0e-5 * (abs(v.x) + abs(v.y));
        seen[k] = dot(v, pair_of_numbers(c + 2u)) < slack && dot(v, pair_of_numbers(c + 4u)) < slack;
        vec2 along = along_axis(axis, v);
        places[k] = slope(along.x, along.y, 0.0);
        any_seen = any_seen || seen[k];
    }
    if (any_seen ? !seen[i] : i > 0) return kNone;
    if (!any_seen) {
        // The order is the same everywhere, so also towards the first crossing.
        vec2 v = pair_of_numbers(crossings) - eye;
        float light_entry = 1.0;
        if (int(lists[light]) != 1) {
            Round own = round_at(light + uint(kLightShape));
            light_entry = entry_before(own, to_unit(own, eye - own.center), v);
        }
        if (!(entry_before(r, unit, v) < light_entry)) return kNone;
    }
    // The blocker is in front from each crossing at which that begins, up to the next at which it ends. From its tangent, it is in front up
    // to a crossing at which that ends, if none has begun before.
    bool begins_here = lists[crossings + uint(i * kCrossing) + 6u] == 1u;
    float from = begins_here && any_seen ? places[i] : first;
    float to = begins_here || !any_seen ? last : places[i];
    bool counts = true;
    for (int k = 0; k < count; k++) {
        if (k == i || !seen[k]) continue;
        bool other = lists[crossings + uint(k * kCrossing) + 6u] == 1u;
        if (begins_here && !other && places[k] > places[i]) to = min(to, places[k]);
        if (!begins_here && other && places[k] < places[i]) counts = false;
    }
    return counts ? Interval(from, to) : kNone;
}

// Keeps only the directions in which a spot's light arrives. Returns directions between them in which it does not.
Interval cut_spot(uint at, vec2 axis) {
    uint kind = lists[at];
    if (kind == 0u) return kNone;
    vec2 l = along_axis(axis, pair_of_numbers(at + 1u));
    vec2 h = along_axis(axis, pair_of_numbers(at + 3u));
    bool either = l.x > 1.0e-12 || h.x > 1.0e-12;
    if (kind == 2u) {
        // The other directions are less than half a turn, from high to low.
        return either ? Interval(slope(h.x, h.y, -kBeyond), slope(l.x, l.y, kBeyond)) : kNone;
    }
    low = max(low, slope(l.x, l.y, -kBeyond));
    high = either ? min(high, slope(h.x, h.y, kBeyond)) : low;
    return kNone;
}

// Number of entries in a list of a light. The lists stand in the order of these counts.
uint length_of_list(uint light, int list) { return lists[light + uint(kLightCounts + list)]; }

const int kLastList = 11;

void cut_blockers(uint light, vec2 axis) {
    Interval next = cut_spot(light + uint(kLightSpot), axis);
    uint at = light + uint(kLight) + length_of_list(light, 0) * uint(kPart);
    for (uint n = length_of_list(light, 1); n > 0u; n--) {
        low = max(low, slope_to(axis, pair_of_numbers(at)));
        at += uint(kVertex);
    }
    for (uint n = length_of_list(light, 2); n > 0u; n--) {
        high = min(high, slope_to(axis, pair_of_numbers(at)));
        at += uint(kVertex);
    }
    for (uint n = length_of_list(light, 3); n > 0u; n--) {
        low = max(low, disk_tangent(axis, at, 1.0));
        at += uint(kDiskBlocker);
    }
    for (uint n = length_of_list(light, 4); n > 0u; n--) {
        high = min(high, disk_tangent(axis, at, -1.0));
        at += uint(kDiskBlocker);
    }
    // One loop handles the lists one after another, so that drivers compile a single `take`.
    int list = 5;
    uint left = length_of_list(light, list);
    int crossing = 0;
    do {
        take(next.from, next.to);
        next = kNone;
        if (left == 0u) {
            ++list;
            left = list <= kLastList ? length_of_list(light, list) : 0u;
            continue;
        }
        --left;
        if (list == 5) {
            next = Interval(disk_tangent(axis, at, -1.0), disk_tangent(axis, at, 1.0));
            at += uint(kDiskBlocker);
        } else if (list == 6 || list == 7) {
            uint first_count = lists[at];
            uint last_count = lists[at + 1u];
            uint v = at + uint(list == 6 ? kSpan : kBody);
            vec2 p = along_axis(axis, outermost(v, first_count, -1.0));
            vec2 q = along_axis(axis, outermost(v + first_count * uint(kVertex), last_count, 1.0));
            if (list == 6 || lists[at + 2u] == 0u || is_nearer(at + 3u)) next = between(p, q);
            at = v + (first_count + last_count) * uint(kVertex);
        } else if (list == 8 || list == 9) {
            vec2 p = along_axis(axis, pair_of_numbers(at) - eye);
            vec2 q = along_axis(axis, pair_of_numbers(at + 2u) - eye);
            if (list == 8 || is_nearer(at + 4u)) next = between_in_any_order(p, q);
            at += uint(list == 8 ? kChord : kDeep);
        } else if (list == 10) {
            Round r = round_at(at);
            vec2 unit = to_unit(r, eye - r.center);
            vec2 p = along_axis(axis, tangent_direction(r, unit, 1.0));
            vec2 q = along_axis(axis, tangent_direction(r, unit, -1.0));
            if (outside2(unit) > 0.0 && is_nearer(at + 10u)) next = between_in_any_order(p, q);
            at += uint(kRound);
        } else {
            next = taken_by_lens(at, light, axis, crossing);
            ++crossing;
            if (crossing < int(lists[at + 10u])) {
                ++left;
            } else {
                crossing = 0;
                at += uint(kLens);
            }
        }
    } while (list <= kLastList && low < high);
}
