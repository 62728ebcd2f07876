// Disks, edges and runs of edges by the general rules (source/plane/frame/tiles/tile_pack.cpp).
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.

// Slopes from an axis at which a light is, before anything occludes it.
struct Opening {
    vec2 axis;
    float from;
    float to;
};

DiskView disk_seen(uint at) {
    return disk_view(pair_of_numbers(at + uint(kLightX)), number(at + uint(kLightRadius)), number(at + uint(kLightInverseRange)));
}

Opening disk_opening(uint at) {
    DiskView view = disk_seen(at);
    float reach = disk_slope(view, view.reach);
    return Opening(view.to, -reach, reach);
}

// Light of a disk, when the blockers are cut out.
vec3 disk_light(uint at) {
    DiskView view = disk_seen(at);
    float sum = 0.0;
    float from = low;
    for (int k = 0; k <= taken; k++) {
        float to = gap_end(k);
        if (to > from) sum += disk_share(view, from, to);
        from = after_gap(k, from);
    }
    return colour_at(at + uint(kLightColour)) * (max(sum, 0.0) * inverse_two_pi());
}

// An edge as the pixel sees it. Slopes are from its perpendicular, and run along it.
struct Edge {
    vec2 normal;  // towards the lit side
    float d;      // distance of its line
    float foot;   // foot of the perpendicular, along it
    float begin;
    float inverse_d;
    float q;  // (d / range)^2
};

Edge edge_of(vec2 point, vec2 normal, float begin, float inverse_range) {
    Edge e;
    e.normal = normal;
    e.d = dot(eye - point, normal);
    e.foot = cross2(-normal, eye);
    e.begin = begin;
    e.inverse_d = 1.0 / max(e.d, 1.0e-6);
    float in_range = max(e.d, 1.0e-6) * inverse_range;
    e.q = in_range * in_range;
    return e;
}

float slope_along(Edge e, float place) { return clamp((place - e.foot) * e.inverse_d, -kBeyond, kBeyond); }

float reach_of(Edge e) { return sqrt(max(1.0 / max(e.q, smallest_divisor()) - 1.0, 0.0)); }

// Emission of an edge.
struct Emission {
    bool ranged;
    bool linear;
    int profile;
};

// Gauss-Legendre, three nodes.
const float kOuterNode = 0.774596669241483377;

// A node, -1 to 1, and its weight, of number 0, 1 or 2.
vec2 gauss_node(int i) { return i == 1 ? vec2(0.0, 8.0 / 9.0) : vec2(i == 0 ? -kOuterNode : kOuterNode, 5.0 / 9.0); }

// Integral of a power of the cosine, 0 or 1, without a difference that cancels.
float cosine_integral(int power, float from, float to) {
    float product = from * to;
    if (power == 0) return trig_atan2_unwrapped(to - from, 1.0 + product);
    float c0 = inversesqrt(1.0 + from * from);
    float c1 = inversesqrt(1.0 + to * to);
    float c = c0 * c1;
    return product > 0.0 ? (to - from) * c * (c0 + c1) / (1.0 + (1.0 + product) * c) : to * c1 - from * c0;
}

// Weights of the radiance at both ends of an edge, for its light between two slopes. x is enough if its radiance is the same everywhere.
vec2 edge_integral(Edge e, float edge_length, Emission emission, float from, float to) {
    int power = emission.profile == 0 ? 0 : 1;
    float share_at_foot = (e.foot - e.begin) / edge_length;
    float share_by_slope = e.d / edge_length;
    float half_width = 0.5 * (to - from);
    float middle = 0.5 * (from + to);
    float nearest = max(max(from, -to), 0.0);
    if (half_width * half_width <= 0.01 * (1.0 + nearest * nearest)) {
        vec2 sum = vec2(0.0);
        for (int i = 0; i < 3; i++) {
            vec2 node = gauss_node(i);
            float t = middle + node.x * half_width;
            float sec2 = 1.0 + t * t;
            float weight = half_width * node.y / sec2;
            if (power == 1) weight *= inversesqrt(sec2);
            if (emission.ranged) {
                float window = 1.0 - e.q * sec2;
                weight *= window * window;
            }
            float share = clamp(share_at_foot + share_by_slope * t, 0.0, 1.0);
            sum += emission.linear ? weight * vec2(1.0 - share, share) : vec2(weight, 0.0);
        }
        return sum;
    }
    // The measure and the integral of the slope. Adds plane_edge_integral's terms one by one, so that drivers compile only one. A range has
    // the terms 1, -2 q and q^2, times powers that fall by 2.
    vec2 sum = vec2(cosine_integral(power, from, to), 0.0);
    int terms = emission.ranged ? 3 : 1;
    int degrees = emission.linear ? 2 : 1;
    for (int i = 0; i < 2 * terms * degrees; i++) {
        float t = (i & 1) == 0 ? from : to;
        int degree = (i >> 1) % degrees;
        int term = (i >> 1) / degrees;
        if (degree == 0 && term == 0) continue;
        float share = term == 0 ? 1.0 : term == 1 ? -2.0 * e.q : e.q * e.q;
        float value = ((i & 1) == 0 ? -share : share) * plane_term(degree, power - 2 * term, t, t);
        if (degree == 0)
            sum.x += value;
        else
            sum.y += value;
    }
    if (!emission.linear) return sum;
    float place = min(max(sum.y / max(sum.x, smallest_divisor()), from), to);
    float share = clamp(share_at_foot + share_by_slope * place, 0.0, 1.0);
    return sum.x * vec2(1.0 - share, share);
}

// Fraction of the edge at which a slope of the run's axis meets it.
float share_at(float m, vec2 begin, vec2 end) {
    float g0 = m * begin.x - begin.y;
    float g1 = m * end.x - end.y;
    return clamp(g0 / max(g0 - g1, smallest_divisor()), 0.0, 1.0);
}

// Light of an edge that every pixel sees as small, with linear radiance and no range. From one end of it by the vector `along`, the angle
// grows by cross / r^2, which is smooth.
vec3 small_part_light(uint part, vec2 run_axis, bool whole) {
    vec2 begin = pair_of_numbers(part + 12u) - eye;
    vec2 along = pair_of_numbers(part + 14u) - pair_of_numbers(part + 12u);
    vec2 seen_begin = along_axis(run_axis, begin);
    vec2 seen_end = seen_begin + along_axis(run_axis, along);
    vec2 sum = vec2(0.0);
    float from = low;
    for (int k = 0; k <= taken; k++) {
        float to = gap_end(k);
        float first = whole ? 0.0 : share_at(from, seen_begin, seen_end);
        float last = whole ? 1.0 : share_at(to, seen_begin, seen_end);
        if (to > from && last > first) {
            for (int i = 0; i < 3; i++) {
                vec2 node = gauss_node(i);
                float share = 0.5 * (first + last) + 0.5 * (last - first) * node.x;
                vec2 at = begin + share * along;
                sum += 0.5 * (last - first) * node.y / dot(at, at) * vec2(1.0 - share, share);
            }
        }
        from = after_gap(k, from);
    }
    sum *= max(cross2(begin, along), 0.0) * inverse_two_pi();
    return colour_at(part + 6u) * sum.x + colour_at(part + 9u) * sum.y;
}

// Light from one edge of a run, or from an edge on its own, over the slopes left of the run's chord.
vec3 part_light(uint part, vec2 run_axis, Emission emission, float inverse_range) {
    Edge e = edge_of(pair_of_numbers(part), pair_of_numbers(part + 2u), number(part + 4u), inverse_range);
    // An edge of a run may face away.
    if (!(e.d > 1.0e-6)) return vec3(0.0);
    float end = number(part + 5u);
    float own_low = slope_along(e, e.begin);
    float own_high = slope_along(e, end);
    if (emission.ranged) {
        float reach = reach_of(e);
        own_low = max(own_low, -reach);
        own_high = min(own_high, reach);
    }
    // A slope m of the run is the direction axis + m across.
    vec2 c = along_axis(-e.normal, run_axis);
    vec2 sum = vec2(0.0);
    float from = low;
    for (int k = 0; k <= taken; k++) {
        float to = gap_end(k);
        if (to > from) {
            vec2 a = vec2(c.x - from * c.y, c.y + from * c.x);
            vec2 b = vec2(c.x - to * c.y, c.y + to * c.x);
            // An interval is less than half a turn. So an end behind the edge's line is beyond all of the edge on its own side, unless both
            // ends are behind it.
            bool ahead = a.x > 1.0e-12 || b.x > 1.0e-12;
            float own_from = max(slope(a.x, a.y, -kBeyond), own_low);
            float own_to = min(slope(b.x, b.y, kBeyond), own_high);
            if (ahead && own_to > own_from) sum += edge_integral(e, end - e.begin, emission, own_from, own_to);
        }
        from = after_gap(k, from);
    }
    sum *= inverse_two_pi();
    if (emission.profile == 2) sum *= e.inverse_d;
    return colour_at(part + 6u) * sum.x + colour_at(part + 9u) * sum.y;
}

Opening edge_opening(uint at) {
    Edge e = edge_of(pair_of_numbers(at + uint(kLightX)), pair_of_numbers(at + uint(kLightNormal)), number(at + uint(kLightBegin)),
                     number(at + uint(kLightInverseRange)));
    vec2 axis = -e.normal;
    float from = slope_along(e, e.begin);
    float to = slope_along(e, number(at + uint(kLightEnd)));
    uint low_corners = lists[at + uint(kLightCorners)];
    uint high_corners = lists[at + uint(kLightCorners) + 1u];
    if (low_corners > 0u) {
        uint corner = at + lists[at + uint(kLightWords)] - (low_corners + high_corners) * uint(kVertex);
        from = kBeyond;
        to = -kBeyond;
        for (; low_corners > 0u; low_corners--) {
            from = min(from, slope_to(axis, pair_of_numbers(corner)));
            corner += uint(kVertex);
        }
        for (; high_corners > 0u; high_corners--) {
            to = max(to, slope_to(axis, pair_of_numbers(corner)));
            corner += uint(kVertex);
        }
    } else if (!(e.d > 1.0e-6)) {
        to = from;
    }
    return Opening(axis, from, to);
}

// Light of an edge, when the blockers are cut out. An edge that emits equally in all directions and at all distances has no parts. Neither
// has a chord that replaces such edges.
vec3 edge_light(uint at, Opening opening) {
    float inverse_range = number(at + uint(kLightInverseRange));
    uint parts = length_of_list(at, 0);
    if (parts > 0u) {
        Emission emission;
        emission.ranged = inverse_range > 0.0;
        emission.linear = lists[at + uint(kLightLinear)] == 1u;
        emission.profile = int(lists[at + uint(kLightProfile)]);
        bool by_direction_alone = !emission.ranged && emission.profile == 0;
        bool whole = taken == 0 && low == opening.from && high == opening.to;
        vec3 light = vec3(0.0);
        uint part = at + uint(kLight);
        for (; parts > 0u && low < high; parts--) {
            if (by_direction_alone && lists[part + 16u] != 0u)
                light += small_part_light(part, opening.axis, whole && lists[part + 16u] == uint(kSmallAndSeen));
            else
                light += part_light(part, opening.axis, emission, inverse_range);
            part += uint(kPart);
        }
        return light;
    }
    float sum = 0.0;
    float from = low;
    for (int k = 0; k <= taken; k++) {
        float to = gap_end(k);
        if (to > from) sum += trig_atan2_unwrapped(to - from, 1.0 + from * to);
        from = after_gap(k, from);
    }
    return colour_at(at + uint(kLightColour)) * (sum * inverse_two_pi());
}

// Light of a disk or an edge. Both take one look at the blockers, so that its code is there once.
vec3 cut_light(uint at) {
    bool is_edge = int(lists[at]) == 1;
    Opening opening;
    if (is_edge)
        opening = edge_opening(at);
    else
        opening = disk_opening(at);
    open_cut(opening.from, opening.to);
    cut_blockers(at, opening.axis);
    return is_edge ? edge_light(at, opening) : disk_light(at);
}
