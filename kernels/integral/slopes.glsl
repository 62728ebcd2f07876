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
// Needs: constants.glsl inverse_trig.glsl polygon.glsl complex.glsl quartic.glsl gauss_legendre.glsl microfacet.glsl conic.glsl ltc.glsl ggx_closed_form.glsl
// Topics: edge, polygon_edge, ltc_edge, ggx_edge
// Source: Reynolds' transport theorem, applied to the boundary integrals of polygon.glsl, ltc.glsl and ggx_closed_form.glsl.
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.

// The part of an edge above the horizon, by its ends: start = a start_a + b start_b, end = a end_a + b end_b.
//   start, end  unit directions; equal where nothing is above
struct EdgePart {
    vec3 start;
    vec3 end;
    real start_a;
    real start_b;
    real end_a;
    real end_b;
};

// Derivatives of one integral by an edge's ends.
//   normal    of the edge's part, start cross end: not unit
//   by_start, by_end  derivative by the end's unit direction, over the normal
struct EdgeSlopes {
    vec3 normal;
    real by_start;
    real by_end;
};

// The same for two integrals: with F = 1, and with F = (1 - v.h)^5.
struct EdgeSlopesOfBoth {
    vec3 normal;
    vec2 by_start;
    vec2 by_end;
};

// Clips an edge to the horizon z = 0.
//
//   a, b     unit directions of the ends (polygon_direction), in walk order
//
// Degenerate: an edge below the horizon has equal ends.
EdgePart edge_above_horizon(vec3 a, vec3 b) {
    mask a_below = a.z < 0.0;
    mask b_below = b.z < 0.0;
    // The weights are those of polygon_add_edge: of one sign, so that nothing cancels.
    real wa = abs(b.z);
    real wb = abs(a.z);
    vec2 p = vec2(a.x * wa + b.x * wb, a.y * wa + b.y * wb);
    real scale = inversesqrt(max(dot(p, p), smallest_square()));
    vec3 crossing = vec3(p.x * scale, p.y * scale, 0.0);
    EdgePart part;
    part.start = select(a_below, crossing, a);
    part.end = select(b_below, crossing, b);
    part.start_a = select(a_below, wa * scale, 1.0);
    part.start_b = select(a_below, wb * scale, 0.0);
    part.end_a = select(b_below, wa * scale, 0.0);
    part.end_b = select(b_below, wb * scale, 1.0);
    return part;
}

// Irradiance of an edge's part by its own ends, which are not below the horizon.
//
//   returns  vec2(by the start, by the end), over start cross end
//
// INT l_z s ds over the arc, l = s start + t end, has the closed form |n| (start_z P + end_z Q) / 2 with F the angle over the sine,
// Q its slope and P = F - c Q.
vec2 edge_irradiance_slopes(vec3 start, vec3 end) {
    vec3 n = cross(start, end - start);
    real c = dot(start, end);
    real s2 = dot(n, n);
    real f = trig_angle_over_sine(c, s2);
    real q = trig_angle_over_sine_slope(c, s2, f);
    real p = min(f, 1.0e12) - c * q;
    return vec2(-0.5 * (start.z * p + end.z * q), -0.5 * (end.z * p + start.z * q));
}

// An edge's derivatives from those of its part.
//
//   g        vec2(by the part's start, by its end), over their cross product
EdgeSlopes edge_slopes_of_part(EdgePart part, vec2 g) {
    EdgeSlopes slopes;
    slopes.normal = cross(part.start, part.end - part.start);
    slopes.by_start = part.start_a * g.x + part.end_a * g.y;
    slopes.by_end = part.start_b * g.x + part.end_b * g.y;
    return slopes;
}

// Derivatives of the irradiance for radiance 1 (polygon_irradiance) by the ends of one edge.
//
//   a, b     unit directions of the ends (polygon_direction), in walk order
//
// Degenerate: an edge of no length, or below the horizon, has a normal of 0. Opposite ends, where the point lies on the edge, give
// finite numbers.
// Error: see docs/measured/accuracy.md, "polygon, edge slopes".
EdgeSlopes polygon_edge_slopes(vec3 a, vec3 b) {
    EdgePart part = edge_above_horizon(a, b);
    return edge_slopes_of_part(part, edge_irradiance_slopes(part.start, part.end));
}

// Derivatives of the integral of a linearly transformed cosine (ltc_integral) by the ends of one edge.
//
//   a, b     unit directions of the ends in the shading frame, in walk order
//   m        the lobe's inverse matrix
//   returns  derivatives by M^-1 a and M^-1 b: the derivative by a is ltc_edge_transform_back(m, normal by_start)
//
// The edges that close the real horizon lie in its image and do not move.
// Degenerate: as polygon_edge_slopes.
// Error: see docs/measured/accuracy.md, "LTC, edge slopes".
EdgeSlopes ltc_edge_slopes(LtcMatrix m, vec3 a, vec3 b) {
    EdgePart real_part = edge_above_horizon(a, b);
    vec3 start = ltc_transform(m, real_part.start);
    vec3 end = ltc_transform(m, real_part.end);
    real start_scale = inversesqrt(max(dot(start, start), smallest_square()));
    real end_scale = inversesqrt(max(dot(end, end), smallest_square()));
    EdgePart lobe_part = edge_above_horizon(start * start_scale, end * end_scale);
    EdgePart part = lobe_part;
    part.start_a = lobe_part.start_a * start_scale * real_part.start_a + lobe_part.start_b * end_scale * real_part.end_a;
    part.start_b = lobe_part.start_a * start_scale * real_part.start_b + lobe_part.start_b * end_scale * real_part.end_b;
    part.end_a = lobe_part.end_a * start_scale * real_part.start_a + lobe_part.end_b * end_scale * real_part.end_a;
    part.end_b = lobe_part.end_a * start_scale * real_part.start_b + lobe_part.end_b * end_scale * real_part.end_b;
    return edge_slopes_of_part(part, edge_irradiance_slopes(part.start, part.end) * inverse_pi());
}

// The transpose of M^-1 times a vector: takes derivatives by M^-1 v to derivatives by v.
vec3 ltc_edge_transform_back(LtcMatrix m, vec3 g) {
    return vec3(m.xx * g.x + m.zx * g.z, m.yy * g.y, m.xz * g.x + m.zz * g.z);
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
    vec2 even = vec2(0.0, 0.0);
    vec2 odd = vec2(0.0, 0.0);
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
            vec2 both = vec2(w, w * fresnel_schlick(0.0, 1.0, along * inversesqrt(p2)));
            // l = even (start + end) + odd (end - start), by its angle from the middle: from l itself, a short edge in float would lose
            // the digits of `odd`.
            real t = node.tau * arc.scale;
            real d = 1.0 / (1.0 + t * t);
            vec2 angle = complex_product(base, vec2((1.0 - t * t) * d, 2.0 * t * d));
            even = even + both * (angle.x * sum_inverse);
            odd = odd + both * (angle.y * chord_inverse);
        }
    }
    vec3 n = cross(part.start, chord);
    real scale = -arc.scale * inverse_pi() / (view.ax * view.ay * view.v.z) * inversesqrt(max(dot(n, n), smallest_divisor()));
    scale = select(arc.end > arc.begin, scale, 0.0);
    vec2 by_part_start = (even - odd) * scale;
    vec2 by_part_end = (even + odd) * scale;
    EdgeSlopesOfBoth slopes;
    slopes.normal = n;
    slopes.by_start = by_part_start * part.start_a + by_part_end * part.end_a;
    slopes.by_end = by_part_start * part.start_b + by_part_end * part.end_b;
    return slopes;
}

// The same from the ends.
//
//   a, b     unit directions of the ends (polygon_direction), in walk order
EdgeSlopesOfBoth ggx_edge_slopes(GgxView view, vec3 a, vec3 b, real smith, int nodes, int pieces) {
    EdgePart part = edge_above_horizon(a, b);
    return ggx_edge_slopes_of_part(view, part, ggx_edge(view, part.start, part.end), smith, nodes, pieces);
}
