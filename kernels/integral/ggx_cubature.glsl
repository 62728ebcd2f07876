// Shadowing and Fresnel over a light: the mean of G2 F under the closed form's measure, by a few nodes that the poles place.
//
// Second walk over the edges, with the sum E of the first (ggx_closed_form.glsl):
//   GgxCubature c = ggx_cubature_begin(view, e, smith, facing);
//   for each edge: c = ggx_cubature_edge(c, edge, extra_nodes);
//   vec2 r = ggx_cubature_finish(c);         // or, without the second walk: ggx_draft(view, e, smith, facing)
//   radiance = ggx_radiance(r, f0, f90)      // per channel
//
// In stretched half vector space the light's image is fanned about its centre us = E/|E|. Nodes go along each edge by
// equal steps of the angle under which the poles see it, and inwards by the moments of a spherical triangle.
// The measure itself is exact; only the smooth factor G2 F is sampled.
// Needs: constants.glsl inverse_trig.glsl complex.glsl quartic.glsl gauss_legendre.glsl microfacet.glsl conic.glsl ggx_closed_form.glsl
// Topics: ggx
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.

// The state of the second walk.
//   centre          us
//   amount          what the distribution alone sends (ggx_unshadowed)
//   extent          the length of E
//   smith           1 with shadowing, 0 without
//   facing          -1 where the light is seen from behind
//   weight          sum of the weights; weighted: of weight times (G2, G2 (1 - v.h)^5)
//   centre_weight   share of the weights that belongs to the centre
//   at_centre       (G2, G2 (1 - v.h)^5) there
//   lowest, highest of all values with weight
struct GgxCubature {
    GgxView view;
    vec3 centre;
    real amount;
    real extent;
    real smith;
    real facing;
    real weight;
    real centre_weight;
    vec2 weighted;
    vec2 at_centre;
    vec2 lowest;
    vec2 highest;
};

// Shadowing, and shadowing times Schlick's (1 - v.h)^5, at a direction of stretched half vector space.
//
//   u        unit
//   smith    1 with shadowing, 0 without
//   returns  (0, 0) where the mirrored light is not above the surface
vec2 ggx_shadowing_and_fresnel(GgxView view, vec3 u, real smith) {
    vec3 h = vec3(view.ax * u.x, view.ay * u.y, u.z);
    h = h * inversesqrt(max(dot(h, h), smallest_divisor()));
    real v_dot_h = clamp(dot(view.v, h), 0.0, 1.0);
    vec3 l = h * (2.0 * v_dot_h) - view.v;
    real lz = max(l.z, 0.0);
    real shadowing = 2.0 * lz / max(lz * view.masking + ggx_stretched_length(l, view.ax, view.ay), smallest_divisor());
    real g = select(l.z > 0.0, 1.0 + smith * (shadowing - 1.0), 0.0);
    real x = 1.0 - v_dot_h;
    real x2 = x * x;
    return vec2(g, g * (x2 * x2 * x));
}

// Starts the second walk.
//
//   e        sum of the edge vectors of the first walk, in the order in which the edges were walked
//   smith    1.0: height-correlated shadowing; 0.0: none
//   facing   1.0; -1.0 where the light is seen from behind, so that the walk ran the wrong way round
GgxCubature ggx_cubature_begin(GgxView view, vec3 e, real smith, real facing) {
    GgxCubature c;
    vec3 inward = e * facing;
    real length2 = dot(inward, inward);
    mask usable = length2 > smallest_square();
    c.view = view;
    c.centre = select(usable, inward * inversesqrt(max(length2, smallest_square())), vec3(0.0, 0.0, 1.0));
    c.amount = select(usable, ggx_unshadowed(view, inward), 0.0);
    c.extent = sqrt(length2);
    c.smith = smith;
    c.facing = facing;
    c.weight = 0.0;
    c.centre_weight = 0.0;
    c.weighted = vec2(0.0, 0.0);
    c.at_centre = ggx_shadowing_and_fresnel(view, c.centre, smith);
    c.lowest = c.at_centre;
    c.highest = c.at_centre;
    return c;
}

// Adds one node.
//
//   u        unit direction in stretched half vector space
//   weight   0 for a lane that does not have this node
GgxCubature ggx_cubature_add(GgxCubature c, vec3 u, real weight) {
    GgxCubature next = c;
    real o = weight * max(dot(c.view.w, u), 0.0);
    vec2 g = ggx_shadowing_and_fresnel(c.view, u, c.smith);
    mask counts = abs(o) > 0.0;
    next.weight = c.weight + o;
    next.weighted = c.weighted + g * o;
    next.lowest = select(counts, vec2(min(c.lowest.x, g.x), min(c.lowest.y, g.y)), c.lowest);
    next.highest = select(counts, vec2(max(c.highest.x, g.x), max(c.highest.y, g.y)), c.highest);
    return next;
}

// Node j of the rule with n nodes, n differing from lane to lane in 1 to `most`, at most 6: vec2(node, weight), weight 0 from j = n on.
vec2 ggx_rule(real n, int j, int most) {
    vec2 r = gauss_legendre_node(1, j);
    for (int k = 2; k <= most; k++) {
        r = select(n > real(k) - 0.5, gauss_legendre_node(k, j), r);
    }
    return r;
}

// Adds the nodes of one edge.
//
//   extra    more nodes along the edge than its angle asks for, and always the finer rule inwards: 0 is normal, 2 high quality
//
// Along the edge: 1 to 4 nodes for angles up to 0.25, 0.8, 1.6 and beyond. Inwards, in cos: three rules for a fan triangle,
// exact to degree 2 (with the centre and 2/3), 4 (with the centre and two more: Radau's), the finer from 0.5 on, and 8 (with four
// more) where a rough lobe sees a large light: there the horizon, at which shadowing ends, is among what is averaged.
GgxCubature ggx_cubature_edge(GgxCubature c, ConicArc edge, int extra) {
    GgxCubature next = c;
    real total = edge.sweep.x + edge.sweep.y;
    real n = 1.0 + select(total < 0.25, 0.0, 1.0) + select(total < 0.8, 0.0, 1.0) + select(total < 1.6, 0.0, 1.0) + real(extra);
    mask fine = total >= 0.5;
    if (extra > 0) {
        fine = total > -1.0;
    }
    mask wide = c.extent > 0.3 && max(c.view.ax, c.view.ay) > 0.08;
    for (int j = 0; j < 4 + extra; j++) {
        mask present = n > real(j) + 0.5 && total > 0.0;
        vec2 rule = ggx_rule(n, j, 4 + extra);
        ConicNode node = conic_node(edge, rule.x);
        vec3 u = edge.u0 + (edge.u1 + edge.u2 * node.tau) * node.tau;
        vec3 du = edge.u1 + edge.u2 * (2.0 * node.tau);
        real inverse2 = 1.0 / max(dot(u, u), smallest_divisor());
        vec3 rim = u * sqrt(inverse2);
        real rim_cosine = dot(rim, c.centre);
        vec3 out_of_centre = rim - c.centre * rim_cosine;
        vec3 outward = out_of_centre * inversesqrt(max(dot(out_of_centre, out_of_centre), smallest_divisor()));
        real om = dot(c.centre, cross(u, du)) * (c.facing * inverse2 * rule.y * total / node.density)
            / (1.0 + max(rim_cosine, -0.9));  // solid angle of the fan
        om = select(present, om, 0.0);

        next.centre_weight = next.centre_weight + om * select(wide, 0.04, select(fine, 0.111111111111111111, 0.25));
        int turns = 1;
        if (any_lane(fine && present)) {
            turns = 2;
        }
        if (any_lane(wide && present)) {
            turns = 4;
        }
        for (int k = 0; k < turns; k++) {
            real share = select(wide, 0.139759864343780571, select(fine, 0.355051025721682190, 0.666666666666666667));
            real share_weight = select(wide, 0.223103901083570916, select(fine, 0.512485826188421615, 0.75));
            if (k == 1) {
                share = select(wide, 0.416409567631083166, 0.844948974278317810);
                share_weight = select(wide, 0.311826522975741250, select(fine, 0.376403062700467274, 0.0));
            }
            if (k == 2) {
                share = 0.723156986361876117;
                share_weight = select(wide, 0.281356015149461949, 0.0);
            }
            if (k == 3) {
                share = 0.942895803885482318;
                share_weight = select(wide, 0.143713560791225886, 0.0);
            }
            next = ggx_cubature_add(next, fan_place(c.centre, outward, rim_cosine, share), om * share_weight);
            // At the end, here and below, as in conic_polish_poles.
            if (k + 1 == turns) {
                break;
            }
        }
        if (!any_lane(present && n > real(j) + 1.5)) {
            break;
        }
    }
    return next;
}

// Limits what leaves: with shadowing no lobe sends more than it gets.
//
//   mean     means of (G2, G2 (1 - v.h)^5)
vec2 ggx_limited(real amount, vec2 mean, real smith) {
    real whole = amount * mean.x;
    whole = select(smith > 0.5, min(whole, 1.0), whole);
    return vec2(whole, clamp(amount * mean.y, 0.0, whole));
}

// Ends the second walk.
//
//   returns  radiance for radiance 1 as two numbers for ggx_radiance: with F = 1, and with F = (1 - v.h)^5
//
// Degenerate: weights that cancel leave the centre's value.
// Error: see docs/measured/accuracy.md, "GGX with shadowing and Fresnel".
vec2 ggx_cubature_finish(GgxCubature c) {
    // The centre's values are known all along, its weight only now.
    real o = c.centre_weight * max(dot(c.view.w, c.centre), 0.0);
    real weight = c.weight + o;
    mask usable = weight > 1.0e-9 * c.extent;
    real scale = 1.0 / select(usable, weight, 1.0);
    vec2 mean = (c.weighted + c.at_centre * o) * scale;
    mean = vec2(clamp(mean.x, c.lowest.x, c.highest.x), clamp(mean.y, c.lowest.y, c.highest.y));
    mean = select(usable, mean, c.at_centre);
    return ggx_limited(c.amount, mean, c.smith);
}

// Shadowing and Fresnel at the centre only: one walk. Arguments as ggx_cubature_begin, result as ggx_cubature_finish.
vec2 ggx_draft(GgxView view, vec3 e, real smith, real facing) {
    GgxCubature c = ggx_cubature_begin(view, e, smith, facing);
    return ggx_limited(c.amount, c.at_centre, smith);
}

// Radiance of one channel, for radiance 1.
//
//   r        of ggx_cubature_finish or ggx_draft
//   f0, f90  Schlick's reflectances
real ggx_radiance(vec2 r, real f0, real f90) {
    return f0 * (r.x - r.y) + f90 * r.y;
}
