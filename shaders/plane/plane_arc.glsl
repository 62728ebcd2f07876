// Arcs of ellipses. The visible part of an arc is an interval. Where emission changes along it or with distance, Gauss-Kronrod quadrature
// integrates it, halved until its two rules agree (source/plane/frame/tiles/tile_arc.h).
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.

// Gauss-Kronrod, 7 and 15 nodes; Piessens et al., QUADPACK, 1983. A row: a node, its weight, its weight in Gauss' rule, and in a rule that
// is 0 up to degree 11.
const vec4 kNodes[8] = vec4[8](vec4(0.991455371120812639, 0.022935322010529225, 0.0, 0.009991356662876932),
                               vec4(0.949107912342758525, 0.063092092629978553, 0.129484966168869693, -0.025246739496563773),
                               vec4(0.864864423359769073, 0.104790010322250184, 0.0, 0.029058304001152294),
                               vec4(0.741531185599394440, 0.140653259715525919, 0.279705391489276668, -0.019997310073577482),
                               vec4(0.586087235467691130, 0.169004726639267903, 0.0, 0.000805380980923889),
                               vec4(0.405845151377397167, 0.190350578064785410, 0.381830050505118945, 0.022153524494280635),
                               vec4(0.207784955007898468, 0.204432940075298892, 0.0, -0.040392629162145345),
                               vec4(0.0, 0.209482141084727828, 0.417959183673469388, 0.047256225186105581));
const int kDeepest = 12;
const int kMostHalvings = 64;

struct Arc {
    Round shape;
    vec2 unit;  // the eye in the ellipse's space
    float d2;
    float inverse_d2;
    float det;
    vec2 ramp;
    float ramp_at_center;
    float inverse_range;
    int profile;
    bool linear;
};

// The place z = tan(beta / 2) in the direction of a slope. beta is the angle at which the ray hits the unit circle.
float place_on_arc(Arc arc, vec2 axis, float m) {
    vec2 n = to_unit(arc.shape, axis + m * vec2(-axis.y, axis.x));
    float s = clamp(cross2(n, arc.unit) * inversesqrt(max(dot(n, n), smallest_divisor())), -1.0, 1.0);
    return s / (1.0 + sqrt(max(1.0 - s * s, 0.0)));
}

// Weights of the radiance at both ends of the ramp, for the light from a place.
vec2 arc_node(Arc arc, float z) {
    float over = 1.0 / (1.0 + z * z);
    float s = 2.0 * z * over;
    float c = (1.0 - z * z) * over;
    float root = plane_root(max(arc.d2 - s * s, 1.0e-12));
    float t = root - c;
    // The ray's direction in unit space, mapped from there to the plane. Its length is the scale between the two spaces along it.
    vec2 n = vec2(-arc.unit.x * root + arc.unit.y * s, -arc.unit.y * root - arc.unit.x * s) * arc.inverse_d2;
    vec2 direction = from_unit(arc.shape, n);
    float m2 = dot(direction, direction);
    vec2 hit = arc.unit + n * t;
    // d beta = 2 dz over, d psi = c / root d beta, and the angle in the plane is det / m2 times as much.
    float weight = 2.0 * over * c * arc.det / (root * m2);
    if (arc.profile == 1) {
        vec2 normal = hit.x * arc.shape.axis_y - hit.y * arc.shape.axis_x;
        weight *= c * arc.det * inversesqrt(max(dot(normal, normal) * m2, smallest_divisor()));
    }
    if (arc.profile == 2) weight *= inversesqrt(max(t * t * m2, 1.0e-24));
    if (arc.inverse_range > 0.0) {
        float window = max(1.0 - t * t * m2 * arc.inverse_range * arc.inverse_range, 0.0);
        weight *= window * window;
    }
    if (!arc.linear) return vec2(weight, 0.0);
    float share = clamp(dot(from_unit(arc.shape, hit), arc.ramp) + arc.ramp_at_center, 0.0, 1.0);
    return weight * vec2(1.0 - share, share);
}

vec2 arc_integral(Arc arc, float from, float to) {
    float waiting[kDeepest];
    int count = 0;
    int halvings = 0;
    vec2 sum = vec2(0.0);
    vec2 kronrod = vec2(0.0);
    vec2 gauss = vec2(0.0);
    vec2 null_rule = vec2(0.0);
    // One loop goes through the parts, and through the nodes of each: drivers compile it in a tenth of the time of two loops.
    int i = 0;
    bool more = true;
    while (more) {
        float half_length = 0.5 * (to - from);
        vec4 rule = kNodes[i < 8 ? i : 14 - i];
        vec2 node = arc_node(arc, 0.5 * (from + to) + half_length * (i < 8 ? -rule.x : rule.x));
        kronrod += rule.y * node;
        gauss += rule.z * node;
        null_rule += rule.w * node;
        ++i;
        if (i < 15) continue;
        i = 0;
        // tile_arc.h derives the bounds.
        vec2 part = half_length * kronrod;
        vec2 off = abs(half_length * (kronrod - gauss));
        vec2 null_off = abs(half_length * null_rule);
        float own = part.x + part.y;
        float scale = arc.profile == 2 ? own : max(1.0, own);
        bool good = max(off.x, off.y) <= 2.0e-4 * scale && max(null_off.x, null_off.y) <= 1.2e-4 * scale;
        kronrod = vec2(0.0);
        gauss = vec2(0.0);
        null_rule = vec2(0.0);
        if (!good && count < kDeepest && halvings < kMostHalvings) {
            ++halvings;
            waiting[count] = to;
            ++count;
            to = 0.5 * (from + to);
        } else {
            sum += part;
            more = count > 0;
            if (more) {
                from = to;
                --count;
                to = waiting[count];
            }
        }
    }
    return sum;
}

vec3 arc_light(uint at) {
    uint own = at + uint(kLightArc);  // ends, ends and middle in unit space, least cosine, whole, between tangents, det, ramp, its value at the centre
    Arc arc;
    arc.shape = round_at(at + uint(kLightShape));
    arc.unit = to_unit(arc.shape, eye - arc.shape.center);
    arc.d2 = max(outside2(arc.unit), 1.0e-6) + 1.0;
    arc.inverse_d2 = 1.0 / arc.d2;
    arc.det = number(own + 13u);
    arc.ramp = pair_of_numbers(own + 14u);
    arc.ramp_at_center = number(own + 16u);
    arc.inverse_range = number(at + uint(kLightInverseRange));
    arc.profile = int(lists[at + uint(kLightProfile)]);
    arc.linear = lists[at + uint(kLightLinear)] == 1u;

    vec2 p = tangent_direction(arc.shape, arc.unit, 1.0);
    vec2 q = tangent_direction(arc.shape, arc.unit, -1.0);
    vec2 axis = pair_of_numbers(at + uint(kLightX)) - eye;
    if (lists[own + 12u] == 1u) axis = p * inversesqrt(max(dot(p, p), smallest_divisor())) + q * inversesqrt(max(dot(q, q), smallest_divisor()));
    vec2 along_p = along_axis(axis, p);
    vec2 along_q = along_axis(axis, q);
    float from = slope(along_p.x, along_p.y, -kBeyond);
    float to = slope(along_q.x, along_q.y, kBeyond);
    bool outside = outside2(arc.unit) > 1.0e-6;
    if (lists[own + 11u] == 0u) {
        // As seen from outside, the near side runs clockwise: the arc's first end is the high one.
        bool first = dot(arc.unit, pair_of_numbers(own + 4u)) > 1.0;
        bool last = dot(arc.unit, pair_of_numbers(own + 6u)) > 1.0;
        float middle = dot(arc.unit, pair_of_numbers(own + 8u));
        if (first) to = min(to, slope_to(axis, pair_of_numbers(own)));
        if (last) from = max(from, slope_to(axis, pair_of_numbers(own + 2u)));
        outside = outside && (first || last || middle > number(own + 10u) * sqrt(outside2(arc.unit) + 1.0));
    }
    open_cut(from, outside ? to : from);
    cut_blockers(at, axis);

    bool plain = arc.profile == 0 && !(arc.inverse_range > 0.0) && !arc.linear;
    vec2 sum = vec2(0.0);
    from = low;
    for (int k = 0; k <= taken; k++) {
        to = gap_end(k);
        if (to > from) {
            if (plain)
                sum.x += trig_atan2_unwrapped(to - from, 1.0 + from * to);
            else {
                // A narrow part that rounding reverses is empty.
                float first = place_on_arc(arc, axis, from);
                sum += arc_integral(arc, first, max(place_on_arc(arc, axis, to), first));
            }
        }
        from = after_gap(k, from);
    }
    return (colour_at(at + uint(kLightColour)) * sum.x + colour_at(at + uint(kLightColourEnd)) * sum.y) * inverse_two_pi();
}
