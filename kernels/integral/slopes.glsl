// Derivatives of integrals over polygonal lights, by the boundary: how the integral changes as an edge moves.
//
// When an edge from a to b moves, the integral changes by the lobe times cosine along the edge times the motion across it:
//
//   d integral = - INT f(l) N.(x da + y db) ds,   l = x a + y b on the edge's part above the horizon, N its plane's unit normal
//
// The horizon, and the arcs of it that close an outline, do not move with the light, and have no term. All derivatives are along the
// edge's normal, so that one number for each end says all:
//
//   derivative by the unit direction a = normal by_start,  by the vertex v_a = normal by_start / |v_a|
//
// No projection is needed, since the normal is across both ends. Where the light is seen from behind, the sum changes its sign.
// Frame and walk order: as polygon.glsl has them. docs/theory/derivatives.md has the derivation.
// Needs: constants.glsl inverse_trig.glsl polygon.glsl complex.glsl quartic.glsl gauss_legendre.glsl microfacet.glsl phong.glsl conic.glsl ltc.glsl ggx_closed_form.glsl moment.glsl moment_cosine.glsl
// Topics: edge, polygon_edge, polygon_part, ltc_edge, ltc_part, phong_edge, phong_part, ggx_edge
// Source: Reynolds' transport theorem, applied to the boundary integrals of polygon.glsl, ltc.glsl, moment.glsl and ggx_closed_form.glsl.
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.

// Derivatives of one integral by an edge's ends.
//   normal    of the edge's part, start cross end: not unit
//   by_start, by_end  derivative by the end's unit direction, over the normal
struct EdgeSlopes {
    vec3 normal;
    real by_start;
    real by_end;
};

// The same for two integrals: with F = 1, and with F = (1 - v.h)^5.
//   turn, turn_of_fresnel  INT f (2 (N.h) h - N) ds, N the plane's unit normal: the edge's part of the derivative by the view
struct EdgeSlopesOfBoth {
    vec3 normal;
    vec2 by_start;
    vec2 by_end;
    vec3 turn;
    vec3 turn_of_fresnel;
};

// Irradiance of an edge's part by its own ends, which are not below the horizon.
//
// INT l_z s ds over the arc, l = s start + t end, has the closed form |n| (start_z P + end_z Q) / 2 with F the angle over the sine,
// Q its slope and P = F - c Q.
// Error: opposite ends, where the point lies on the edge, give finite numbers.
EdgeSlopes edge_irradiance_slopes(vec3 start, vec3 end) {
    EdgeSlopes slopes;
    slopes.normal = cross(start, end - start);
    real c = dot(start, end);
    vec2 half_angle = trig_angle_over_sine_and_slope(c, dot(slopes.normal, slopes.normal)) * 0.5;
    real q = half_angle.y;
    real p = half_angle.x - c * q;
    slopes.by_start = -(start.z * p + end.z * q);
    slopes.by_end = -(end.z * p + start.z * q);
    return slopes;
}

// The derivatives by an edge's ends from those by the ends of its part.
EdgeSlopes edge_slopes_of_whole(EdgePart part, EdgeSlopes of_part) {
    EdgeSlopes slopes = of_part;
    if (any_lane(part.rises || part.sinks)) {
        slopes.by_start = part.start_a * of_part.by_start + part.end_a * of_part.by_end;
        slopes.by_end = part.start_b * of_part.by_start + part.end_b * of_part.by_end;
    }
    return slopes;
}

// Derivatives of the irradiance for radiance 1 (polygon_irradiance) by the ends of one edge.
//
//   part     of edge_above_horizon: a walk that computes the value has it already (polygon_add_part)
//
// Degenerate: an edge of no length, or below the horizon, has a normal of 0. Opposite ends, where the point lies on the edge, give
// finite numbers.
// Error: see docs/measured/accuracy.md, "polygon, edge slopes".
EdgeSlopes polygon_part_slopes(EdgePart part) {
    return edge_slopes_of_whole(part, edge_irradiance_slopes(part.start, part.end));
}

// The same from the ends.
//
//   a, b     unit directions of the ends (polygon_direction), in walk order
EdgeSlopes polygon_edge_slopes(vec3 a, vec3 b) {
    return polygon_part_slopes(edge_above_horizon(a, b));
}

// Derivatives of the integral of a linearly transformed cosine (ltc_integral) by the ends of one edge.
//
//   part       of ltc_part
//   lobe_part  edge_above_horizon(part.start, part.end): above the lobe's own horizon
//   returns    derivatives by ltc_direction(m, a) and ltc_direction(m, b): the derivative by a is ltc_edge_transform_back of it
//
// The edges that close the real horizon lie in its image and do not move.
// Degenerate: as polygon_part_slopes.
// Error: see docs/measured/accuracy.md, "LTC, edge slopes".
EdgeSlopes ltc_part_slopes(EdgePart part, EdgePart lobe_part) {
    EdgeSlopes slopes = edge_slopes_of_whole(part, polygon_part_slopes(lobe_part));
    slopes.normal = slopes.normal * inverse_pi();
    return slopes;
}

// The same from the ends.
//
//   a, b     unit directions of the ends in the shading frame, in walk order
EdgeSlopes ltc_edge_slopes(LtcMatrix m, vec3 a, vec3 b) {
    EdgePart part = ltc_part(m, a, b, ltc_direction(m, a), ltc_direction(m, b));
    return ltc_part_slopes(part, edge_above_horizon(part.start, part.end));
}

// The derivative by v from that by ltc_direction(m, v): M^-T over the length of M^-1 v.
vec3 ltc_edge_transform_back(LtcMatrix m, vec3 v, vec3 g) {
    vec3 under = ltc_transform(m, v);
    return ltc_transform_transposed(m, g * inversesqrt(max(dot(under, under), smallest_square())));
}

// Derivatives of the Phong lobe's integral, (n + 1)/(2 pi) times the moment, by the ends of one edge.
//
//   part     of edge_above_horizon
//   r        unit axis of the lobe, the mirrored view
//   n        exponent, 0 or more
//   low      1 for n < 7, else 0; the same for every lane
//
// On the edge, x = l.r = c cos phi with phi from the foot. So INT x^n l dphi is that of x^(n + 1) towards the foot, and has the
// antiderivative -x^(n + 1)/(n + 1) across it. Edges shorter than two widths of the lobe, in front of its equator, take Gauss and Legendre's
// rule, since a difference of two antiderivatives would lose their digits: its error is 3e-5 at two widths.
// Degenerate: an edge of no length, or behind the lobe's equator, has derivatives of 0.
// Error: see docs/measured/accuracy.md, "Phong, edge slopes"; that of moment_cosine_front, 4e-5 of the full lobe for n >= 1.
EdgeSlopes phong_part_slopes(EdgePart part, vec3 r, real n, int low) {
    vec3 sum = part.start + part.end;
    vec3 chord = part.end - part.start;
    real chord2 = dot(chord, chord);
    real sum_inverse = inversesqrt(max(dot(sum, sum), smallest_divisor()));
    real chord_inverse = inversesqrt(max(chord2, smallest_divisor()));
    // The axis at the part's middle and along it there.
    real axis_middle = dot(r, sum) * sum_inverse;
    real axis_along = dot(r, chord) * chord_inverse;
    real m = n + 1.0;
    // INT f cos t dt and INT f sin t dt, with t from the middle.
    real even = 0.0;
    real odd = 0.0;
    mask is_short = chord2 * m < 4.0 && chord2 < 1.0 && dot(r, part.start) > 0.0 && dot(r, part.end) > 0.0;
    if (any_lane(is_short)) {
        real half_tangent = sum_inverse * chord2 * chord_inverse;
        for (int i = 0; i < 4; i++) {
            vec2 rule = gauss_legendre_node(4, i);
            real u = half_tangent * (2.0 * rule.x - 1.0);
            real cosine = inversesqrt(1.0 + u * u);
            real x = (axis_middle + axis_along * u) * cosine;
            real w = 2.0 * half_tangent * rule.y * phong_power(x, n) * cosine * cosine * cosine;
            even = even + w;
            odd = odd + w * u;
        }
    }
    if (any_lane(!is_short)) {
        MomentEdge edge = moment_edge(part.start, part.end, r);
        real towards = moment_cosine_front(edge, m, low);
        real across = (phong_power(edge.x0, m) - phong_power(edge.x1, m)) / m;
        real over_c2 = 1.0 / (edge.c * edge.c);
        even = select(is_short, even, (towards * axis_middle - across * axis_along) * over_c2);
        odd = select(is_short, odd, (towards * axis_along + across * axis_middle) * over_c2);
    }
    EdgeSlopes of_part;
    of_part.normal = cross(part.start, chord);
    real n2 = dot(of_part.normal, of_part.normal);
    real scale = select(n2 > smallest_divisor(), -m * inverse_two_pi() * inversesqrt(max(n2, smallest_divisor())), 0.0);
    even = even * sum_inverse;
    odd = odd * chord_inverse;
    of_part.by_start = (even - odd) * scale;
    of_part.by_end = (even + odd) * scale;
    return edge_slopes_of_whole(part, of_part);
}

// The same from the ends.
//
//   a, b     unit directions of the ends (polygon_direction), in walk order
EdgeSlopes phong_edge_slopes(vec3 a, vec3 b, vec3 r, real n, int low) {
    return phong_part_slopes(edge_above_horizon(a, b), r, n, low);
}

// Derivatives of the GGX lobe's integral, with shadowing and Fresnel, by the ends of one edge.
//
//   part     of edge_above_horizon
//   arc      ggx_edge(view, part.start, part.end): an edge whose value was computed has it already
//   smith    1 with shadowing, 0 without
//   nodes, pieces  Gauss and Legendre's nodes (1 to 6, or 8) in each of so many equal pieces of the poles' angle
//
// Only the lobe along the edge counts, so that shadowing and Fresnel are exact here but for the rule. 4 nodes serve packs, 6 single values.
// Degenerate: an edge of no length has derivatives of 0.
// Error: see docs/measured/accuracy.md, "GGX, edge slopes"; with 6 nodes 4.0e-3 of the light's largest derivative at the 99th percentile.
EdgeSlopesOfBoth ggx_edge_slopes_of_part(GgxView view, EdgePart part, ConicArc arc, real smith, int nodes, int pieces) {
    vec3 sum = part.start + part.end;
    vec3 chord = part.end - part.start;
    real sum_inverse = inversesqrt(max(dot(sum, sum), smallest_divisor()));
    real chord_inverse = inversesqrt(max(dot(chord, chord), smallest_divisor()));
    // (cosine, sine) of the angle from the part's middle to the place from which tau counts: one of the ends, or the middle.
    real half_cosine = 0.5 / sum_inverse;
    real half_sine = 0.5 / chord_inverse;
    mask from_start = !(arc.begin < 0.0);
    mask from_end = !(arc.end > 0.0);
    vec2 base = vec2(select(from_start || from_end, half_cosine, 1.0), select(from_start, -half_sine, select(from_end, half_sine, 0.0)));
    vec3 n = cross(part.start, chord);
    vec3 across = n * inversesqrt(max(dot(n, n), smallest_divisor()));
    vec2 even = vec2(0.0, 0.0);
    vec2 odd = vec2(0.0, 0.0);
    vec3 turn = vec3(0.0, 0.0, 0.0);
    vec3 turn_of_fresnel = vec3(0.0, 0.0, 0.0);
    real total = arc.sweep.x + arc.sweep.y;
    real share = 1.0 / real(pieces);
    for (int i = 0; i < pieces; i++) {
        for (int j = 0; j < nodes; j++) {
            vec2 rule = gauss_legendre_node(nodes, j);
            ConicNode node = conic_node(arc, (rule.x + real(i)) * share);
            vec3 u = arc.u0 + (arc.u1 + arc.u2 * node.tau) * node.tau;
            vec3 p = vec3(u.x * view.ax, u.y * view.ay, u.z);  // (l + v) times a positive factor
            real p2 = max(dot(p, p), smallest_divisor());
            real along = dot(p, view.v);
            real u2 = max(dot(u, u), smallest_divisor());
            vec3 l = p * (2.0 * along / p2) - view.v;
            real g = 1.0 + smith * (ggx_shadowing(l, view.v, view.ax, view.ay) - 1.0);
            real w = (p2 / u2) * (along / u2) * g * rule.y * share * total / max(node.density, smallest_divisor());
            real p_inverse = inversesqrt(p2);
            vec2 both = vec2(w, w * fresnel_schlick(0.0, 1.0, along * p_inverse));
            vec3 h = p * p_inverse;
            vec3 moved = h * (2.0 * dot(across, h)) - across;
            turn = turn + moved * both.x;
            turn_of_fresnel = turn_of_fresnel + moved * both.y;
            // l = even (start + end) + odd (end - start), by its angle from the middle: from l itself, a short edge in float would lose
            // the digits of `odd`.
            real t = node.tau * arc.scale;
            real d = 1.0 / (1.0 + t * t);
            vec2 angle = complex_product(base, vec2((1.0 - t * t) * d, 2.0 * t * d));
            even = even + both * (angle.x * sum_inverse);
            odd = odd + both * (angle.y * chord_inverse);
        }
    }
    real density = arc.scale * inverse_pi() / (view.ax * view.ay * view.v.z);
    density = select(arc.end > arc.begin, density, 0.0);
    real scale = -density * inversesqrt(max(dot(n, n), smallest_divisor()));
    vec2 by_part_start = (even - odd) * scale;
    vec2 by_part_end = (even + odd) * scale;
    EdgeSlopesOfBoth slopes;
    slopes.normal = n;
    slopes.by_start = by_part_start * part.start_a + by_part_end * part.end_a;
    slopes.by_end = by_part_start * part.start_b + by_part_end * part.end_b;
    slopes.turn = turn * density;
    slopes.turn_of_fresnel = turn_of_fresnel * density;
    return slopes;
}

// The same from the ends.
//
//   a, b     unit directions of the ends (polygon_direction), in walk order
EdgeSlopesOfBoth ggx_edge_slopes(GgxView view, vec3 a, vec3 b, real smith, int nodes, int pieces) {
    EdgePart part = edge_above_horizon(a, b);
    return ggx_edge_slopes_of_part(view, part, ggx_edge(view, part.start, part.end), smith, nodes, pieces);
}
