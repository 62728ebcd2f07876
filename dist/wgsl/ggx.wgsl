// Steradian 0.1.0, ggx: GGX in closed form, and half vector methods for Blinn-Phong and Beckmann, for WGSL.
//
// Put it before your module's text; it has no bindings.
// It needs these files before it, in this order: math.wgsl, polygon.wgsl, lobe.wgsl, round.wgsl, phong.wgsl, ltc.wgsl.
// Made by dist/make_dist.py from kernels/ and dist/source/: change those.
//
// MIT License
//
// Copyright (c) 2026 The Steradian authors
//
// Permission is hereby granted, free of charge, to any person obtaining a copy
// of this software and associated documentation files (the "Software"), to deal
// in the Software without restriction, including without limitation the rights
// to use, copy, modify, merge, publish, distribute, sublicense, and/or sell
// copies of the Software, and to permit persons to whom the Software is
// furnished to do so, subject to the following conditions:
//
// The above copyright notice and this permission notice shall be included in all
// copies or substantial portions of the Software.
//
// THE SOFTWARE IS PROVIDED "AS IS", WITHOUT WARRANTY OF ANY KIND, EXPRESS OR
// IMPLIED, INCLUDING BUT NOT LIMITED TO THE WARRANTIES OF MERCHANTABILITY,
// FITNESS FOR A PARTICULAR PURPOSE AND NONINFRINGEMENT. IN NO EVENT SHALL THE
// AUTHORS OR COPYRIGHT HOLDERS BE LIABLE FOR ANY CLAIM, DAMAGES OR OTHER
// LIABILITY, WHETHER IN AN ACTION OF CONTRACT, TORT OR OTHERWISE, ARISING FROM,
// OUT OF OR IN CONNECTION WITH THE SOFTWARE OR THE USE OR OTHER DEALINGS IN THE
// SOFTWARE.

// ==== charlie_cubature ====

// Charlie's sheen under an area light: cubature over the light's outline, fanned about its mean direction.
//
// The lobe is smooth, with a hole where others have a peak; no transformed cosine is like it, but a few nodes are.
// Two walks along the outline, clipped to the horizon (horizon_clip.glsl): the first sums e = steradian_polygon_edge(start, end),
// the second the nodes.
//   SteradianCharlieCubature c = steradian_charlie_cubature_begin(steradian_charlie_prepare(v, alpha), e, facing);
//   for each edge: c = steradian_charlie_cubature_edge(c, start, end);
//   real radiance = steradian_charlie_cubature_finish(c);

// The state of the second walk.
//   centre   where the light is on average: what its outline is fanned about
//   facing   1.0; -1.0 where the outline is walked the wrong way round
//   sum      over the nodes so far
//   at_centre  the centre's weight, which all edges share
struct SteradianCharlieCubature {
    lobe: SteradianCharlieLobe,
    centre: vec3f,
    facing: f32,
    sum: f32,
    at_centre: f32,
}

// Starts the second walk.
//
//   e        sum of the edge vectors of the first walk, in the order in which the edges were walked
//   facing   1.0; -1.0 where the light is seen from behind, so that the walk ran the wrong way round
fn steradian_charlie_cubature_begin(lobe: SteradianCharlieLobe, e: vec3f, facing: f32) -> SteradianCharlieCubature {
    let inward = e * facing;
    let length2 = dot(inward, inward);
    var c: SteradianCharlieCubature;
    c.lobe = lobe;
    c.centre = select(vec3f(0.0, 0.0, 1.0), inward * inverseSqrt(max(length2, steradian_smallest_square())), length2 > steradian_smallest_square());
    c.facing = facing;
    c.sum = 0.0;
    c.at_centre = 0.0;
    return c;
}

// Adds the nodes of an arc of at most a quarter of a circle.
//
//   a, b     unit directions of its ends, in walk order
//
// Along the chord, whose points' directions have a fan of det(c, a, b) / |u|^2 per length: 2 to 4 nodes of Gauss for
// angles up to 0.25, 0.8 and beyond. Inwards, in the cosine: Radau's rule of four nodes, of which the centre is one.
fn steradian_charlie_cubature_arc(c: SteradianCharlieCubature, a: vec3f, b: vec3f) -> SteradianCharlieCubature {
    var next = c;
    let cosine = dot(a, b);
    let n = 2.0 + select(0.0, 1.0, cosine < 0.968912421710644784) + select(0.0, 1.0, cosine < 0.696706709347165421);
    let fan = dot(c.centre, cross(a, b)) * c.facing;
    for (var j: i32 = 0; j < 4; j++) {
        let present = n > f32(j) + 0.5 && abs(fan) > 0.0;
        if (present) {
            let rule = select(select(steradian_gauss_legendre_node(2, j), steradian_gauss_legendre_node(3, j), n > 2.5), steradian_gauss_legendre_node(4, j), n > 3.5);
            let u = a + (b - a) * rule.x;
            let inverse2 = 1.0 / max(dot(u, u), steradian_smallest_divisor());
            let rim = u * sqrt(inverse2);
            let rim_cosine = dot(rim, c.centre);
            let aside = rim - c.centre * rim_cosine;
            let outward = aside * inverseSqrt(max(dot(aside, aside), steradian_smallest_divisor()));
            let weight = select(0.0, fan * inverse2 * rule.y / (1.0 + max(rim_cosine, -0.9)), present);
            next.at_centre = next.at_centre + 0.0625 * weight;
            var radial = 0.328844319980059696 * steradian_charlie_lobe(c.lobe, steradian_fan_place(c.centre, outward, rim_cosine, 0.212340538239152943));
            radial = radial + 0.388193468843171893 * steradian_charlie_lobe(c.lobe, steradian_fan_place(c.centre, outward, rim_cosine, 0.590533135559265283));
            radial = radial + 0.220462211176768373 * steradian_charlie_lobe(c.lobe, steradian_fan_place(c.centre, outward, rim_cosine, 0.911412040487296148));
            next.sum = next.sum + weight * radial;
        }
    }
    return next;
}

// Adds the nodes of one edge, or of an arc of the horizon; one longer than a quarter of a circle in two halves.
fn steradian_charlie_cubature_edge(c: SteradianCharlieCubature, a: vec3f, b: vec3f) -> SteradianCharlieCubature {
    let wide = dot(a, b) < 0.0;
    var middle = a + b;
    middle = select(b, middle * inverseSqrt(max(dot(middle, middle), steradian_smallest_divisor())), wide);
    var next = steradian_charlie_cubature_arc(c, a, middle);
    if (wide) {
        next = steradian_charlie_cubature_arc(next, middle, b);
    }
    return next;
}

// Radiance of colour 1 for radiance 1, at least 0.
//
// Error: see docs/measured/accuracy.md, "Sheen".
fn steradian_charlie_cubature_finish(c: SteradianCharlieCubature) -> f32 {
    return max(c.sum + c.at_centre * steradian_charlie_lobe(c.lobe, c.centre), 0.0);
}

// ==== ggx_closed_form ====

// The GGX lobe over a light in closed form: what the distribution of half vectors alone sends, without shadowing and
// Fresnel (ggx_cubature.glsl adds both).
//
// In stretched half vector space, u = normalize(h_x/ax, h_y/ay, h_z) and w = (ax v_x, ay v_y, v_z), the lobe is the plain
// measure: D(h) (v.h) dh = (w.u) du / pi. The integral over the light is (w.E) / (pi v_z), E the irradiance vector of the
// light's image. A light edge is an arc l(angle); with tau = tan(angle/2) its image is the conic
//   u(tau) = S (l + v) (1 + tau^2),  S = diag(1/ax, 1/ay, 1):
//
//   E = sum of steradian_conic_vector(steradian_ggx_edge(view, a, b)) over the edges clipped to the horizon (horizon_clip.glsl),
//   negated where the light is seen from behind; then steradian_ggx_unshadowed(view, E).
//
// docs/theory/ggx.md has the derivation.
// Frame: z the surface normal, x and y the directions of the widths. Walk order, as polygon.glsl has it.

// The values of the view and the surface that the lobe's integrals need.
//   v        unit view, z > 0
//   w        (ax v_x, ay v_y, v_z): w.u is v.h in stretched space
//   ax, ay   widths: roughness squared, at least 1.0e-4
//   masking  the view's |v|' / v_z of Smith's shadowing, at least 1
struct SteradianGgxView {
    v: vec3f,
    w: vec3f,
    ax: f32,
    ay: f32,
    masking: f32,
}

// Prepares a view.
//
// Degenerate: a view at or below the surface counts as v_z = 1.0e-6; callers give 0 for it.
fn steradian_ggx_view(v: vec3f, ax: f32, ay: f32) -> SteradianGgxView {
    var view: SteradianGgxView;
    let z = max(v.z, 1.0e-6);
    view.v = vec3f(v.x, v.y, z);
    view.w = vec3f(ax * v.x, ay * v.y, z);
    view.ax = ax;
    view.ay = ay;
    view.masking = sqrt(dot(view.w, view.w)) / z;
    return view;
}

// One edge of a light as a scaled arc in stretched half vector space, without its poles (steradian_conic_scaled).
//
//   a, b     unit directions of the ends, in walk order, not below the horizon
//
// tau counts from the edge's middle; where the middle is near the view, and u2 = S (v - l) would vanish, from the end that
// is further from it.
// Degenerate: a = b, and a = -b, which spans no plane, give an arc of no length.
fn steradian_ggx_edge_scaled(view: SteradianGgxView, a: vec3f, b: vec3f) -> SteradianConicArc {
    let chord = b - a;
    let sum = a + b;
    let chord2 = dot(chord, chord);
    let sum2 = dot(sum, sum);
    let usable = chord2 > steradian_smallest_divisor() && sum2 > 1.0e-12;
    let middle = sum * inverseSqrt(max(sum2, steradian_smallest_divisor()));
    let along = chord * inverseSqrt(max(chord2, steradian_smallest_square()));
    let half_sine = 0.5 * sqrt(chord2);
    let half_cosine = max(0.5 * sqrt(sum2), 1.0e-6);

    let from_end = dot(middle, view.v) > 0.9;
    let side = select(0.0, select(1.0, -1.0, dot(chord, view.v) > 0.0), from_end);
    let turn_cosine = select(1.0, half_cosine, from_end);
    let base = middle * turn_cosine + along * (side * half_sine);
    let q = along * turn_cosine - middle * (side * half_sine);
    let reach = select(0.0, half_sine / (half_cosine + select(1.0, 0.0, from_end)), usable);

    let x = 1.0 / view.ax;
    let y = 1.0 / view.ay;
    let u0 = view.v + base;
    let u2 = view.v - base;
    return steradian_conic_scaled(
        vec3f(u0.x * x, u0.y * y, u0.z), vec3f(q.x * x, q.y * y, q.z) * 2.0, vec3f(u2.x * x, u2.y * y, u2.z),
        select(-reach, 0.0, side < 0.0), select(reach, 0.0, side > 0.0));
}

// One edge of a light as an arc in stretched half vector space. Arguments and degenerate case: steradian_ggx_edge_scaled.
fn steradian_ggx_edge(view: SteradianGgxView, a: vec3f, b: vec3f) -> SteradianConicArc {
    let arc = steradian_ggx_edge_scaled(view, a, b);
    return steradian_conic_with_poles(arc, steradian_conic_poles(arc));
}

// Radiance that the distribution of half vectors alone sends to the view, for radiance 1: INT D / (4 v_z) over the light.
//
//   e        sum over the edges of steradian_conic_vector, negated where the light is seen from behind
//   returns  not negative; above 1 is possible, since nothing shadows: 5.4 at alpha 0.72 and 86 degrees
fn steradian_ggx_unshadowed(view: SteradianGgxView, e: vec3f) -> f32 {
    return max(dot(view.w, e), 0.0) * steradian_inverse_pi() / view.v.z;
}

// The lobe itself towards the view, with F = 1 and with F = (1 - v.h)^5: BRDF times cosine, for steradian_ggx_radiance.
//
//   l        unit direction of the light; below the surface 0
//   smith    1 with shadowing, 0 without
fn steradian_ggx_lobe_and_fresnel(view: SteradianGgxView, l: vec3f, smith: f32) -> vec2f {
    let h = steradian_microfacet_half_vector(l, view.v);
    let g = 1.0 + smith * (steradian_ggx_shadowing(l, view.v, view.ax, view.ay) - 1.0);
    let plain = steradian_microfacet_lobe_unshadowed(steradian_ggx_distribution(h, view.ax, view.ay) * g, l, view.v);
    return vec2f(plain, plain * steradian_fresnel_schlick(0.0, 1.0, dot(view.v, h)));
}

// ==== ggx_cubature ====

// Shadowing and Fresnel over a light: the mean of G2 F under the closed form's measure, by a few nodes that the poles place.
//
// Second walk over the edges, with the sum E of the first (ggx_closed_form.glsl):
//   SteradianGgxCubature c = steradian_ggx_cubature_begin(view, e, smith, facing);
//   for each edge: c = steradian_ggx_cubature_edge(c, edge, extra_nodes);
//   vec2 r = steradian_ggx_cubature_finish(c);         // or, without the second walk: steradian_ggx_draft(view, e, smith, facing)
//   radiance = steradian_ggx_radiance(r, f0, f90)      // per channel
//
// In stretched half vector space the light's image is fanned about its centre us = E/|E|. Nodes go along each edge by
// equal steps of the angle under which the poles see it, and inwards by the moments of a spherical triangle.
// The measure itself is exact; only the smooth factor G2 F is sampled.

// The state of the second walk.
//   centre          us
//   amount          what the distribution alone sends (steradian_ggx_unshadowed)
//   extent          the length of E
//   smith           1 with shadowing, 0 without
//   facing          -1 where the light is seen from behind
//   weight          sum of the weights; weighted: of weight times (G2, G2 (1 - v.h)^5)
//   centre_weight   share of the weights that belongs to the centre
//   at_centre       (G2, G2 (1 - v.h)^5) there
//   lowest, highest of all values with weight
struct SteradianGgxCubature {
    view: SteradianGgxView,
    centre: vec3f,
    amount: f32,
    extent: f32,
    smith: f32,
    facing: f32,
    weight: f32,
    centre_weight: f32,
    weighted: vec2f,
    at_centre: vec2f,
    lowest: vec2f,
    highest: vec2f,
}

// Shadowing, and shadowing times Schlick's (1 - v.h)^5, at a direction of stretched half vector space.
//
//   u        unit
//   smith    1 with shadowing, 0 without
//   returns  (0, 0) where the mirrored light is not above the surface
fn steradian_ggx_shadowing_and_fresnel(view: SteradianGgxView, u: vec3f, smith: f32) -> vec2f {
    var h = vec3f(view.ax * u.x, view.ay * u.y, u.z);
    h = h * inverseSqrt(max(dot(h, h), steradian_smallest_divisor()));
    let v_dot_h = clamp(dot(view.v, h), 0.0, 1.0);
    let l = h * (2.0 * v_dot_h) - view.v;
    let lz = max(l.z, 0.0);
    let shadowing = 2.0 * lz / max(lz * view.masking + steradian_ggx_stretched_length(l, view.ax, view.ay), steradian_smallest_divisor());
    let g = select(0.0, 1.0 + smith * (shadowing - 1.0), l.z > 0.0);
    let x = 1.0 - v_dot_h;
    let x2 = x * x;
    return vec2f(g, g * (x2 * x2 * x));
}

// Starts the second walk.
//
//   e        sum of the edge vectors of the first walk, in the order in which the edges were walked
//   smith    1.0: height-correlated shadowing; 0.0: none
//   facing   1.0; -1.0 where the light is seen from behind, so that the walk ran the wrong way round
fn steradian_ggx_cubature_begin(view: SteradianGgxView, e: vec3f, smith: f32, facing: f32) -> SteradianGgxCubature {
    var c: SteradianGgxCubature;
    let inward = e * facing;
    let length2 = dot(inward, inward);
    let usable = length2 > steradian_smallest_square();
    c.view = view;
    c.centre = select(vec3f(0.0, 0.0, 1.0), inward * inverseSqrt(max(length2, steradian_smallest_square())), usable);
    c.amount = select(0.0, steradian_ggx_unshadowed(view, inward), usable);
    c.extent = sqrt(length2);
    c.smith = smith;
    c.facing = facing;
    c.weight = 0.0;
    c.centre_weight = 0.0;
    c.weighted = vec2f(0.0, 0.0);
    c.at_centre = steradian_ggx_shadowing_and_fresnel(view, c.centre, smith);
    c.lowest = c.at_centre;
    c.highest = c.at_centre;
    return c;
}

// Adds one node.
//
//   u        unit direction in stretched half vector space
//   weight   0 for a lane that does not have this node
fn steradian_ggx_cubature_add(c: SteradianGgxCubature, u: vec3f, weight: f32) -> SteradianGgxCubature {
    var next = c;
    let o = weight * max(dot(c.view.w, u), 0.0);
    let g = steradian_ggx_shadowing_and_fresnel(c.view, u, c.smith);
    let counts = abs(o) > 0.0;
    next.weight = c.weight + o;
    next.weighted = c.weighted + g * o;
    next.lowest = select(c.lowest, vec2f(min(c.lowest.x, g.x), min(c.lowest.y, g.y)), counts);
    next.highest = select(c.highest, vec2f(max(c.highest.x, g.x), max(c.highest.y, g.y)), counts);
    return next;
}

// Node j of the rule with n nodes, n differing from lane to lane in 1 to `most`, at most 6: vec2(node, weight), weight 0 from j = n on.
fn steradian_ggx_rule(n: f32, j: i32, most: i32) -> vec2f {
    var r = steradian_gauss_legendre_node(1, j);
    for (var k: i32 = 2; k <= most; k++) {
        r = select(r, steradian_gauss_legendre_node(k, j), n > f32(k) - 0.5);
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
fn steradian_ggx_cubature_edge(c: SteradianGgxCubature, edge: SteradianConicArc, extra: i32) -> SteradianGgxCubature {
    var next = c;
    let total = edge.sweep.x + edge.sweep.y;
    let n = 1.0 + select(1.0, 0.0, total < 0.25) + select(1.0, 0.0, total < 0.8) + select(1.0, 0.0, total < 1.6) + f32(extra);
    var fine = total >= 0.5;
    if (extra > 0) {
        fine = total > -1.0;
    }
    let wide = c.extent > 0.3 && max(c.view.ax, c.view.ay) > 0.08;
    for (var j: i32 = 0; j < 4 + extra; j++) {
        let present = n > f32(j) + 0.5 && total > 0.0;
        let rule = steradian_ggx_rule(n, j, 4 + extra);
        let node = steradian_conic_node(edge, rule.x);
        let u = edge.u0 + (edge.u1 + edge.u2 * node.tau) * node.tau;
        let du = edge.u1 + edge.u2 * (2.0 * node.tau);
        let inverse2 = 1.0 / max(dot(u, u), steradian_smallest_divisor());
        let rim = u * sqrt(inverse2);
        let rim_cosine = dot(rim, c.centre);
        let out_of_centre = rim - c.centre * rim_cosine;
        let outward = out_of_centre * inverseSqrt(max(dot(out_of_centre, out_of_centre), steradian_smallest_divisor()));
        var om = dot(c.centre, cross(u, du)) * (c.facing * inverse2 * rule.y * total / node.density)
            / (1.0 + max(rim_cosine, -0.9));  // solid angle of the fan
        om = select(0.0, om, present);

        next.centre_weight = next.centre_weight + om * select(select(0.25, 0.111111111111111111, fine), 0.04, wide);
        var turns: i32 = 1;
        if (fine && present) {
            turns = 2;
        }
        if (wide && present) {
            turns = 4;
        }
        for (var k: i32 = 0; k < turns; k++) {
            var share = select(select(0.666666666666666667, 0.355051025721682190, fine), 0.139759864343780571, wide);
            var share_weight = select(select(0.75, 0.512485826188421615, fine), 0.223103901083570916, wide);
            if (k == 1) {
                share = select(0.844948974278317810, 0.416409567631083166, wide);
                share_weight = select(select(0.0, 0.376403062700467274, fine), 0.311826522975741250, wide);
            }
            if (k == 2) {
                share = 0.723156986361876117;
                share_weight = select(0.0, 0.281356015149461949, wide);
            }
            if (k == 3) {
                share = 0.942895803885482318;
                share_weight = select(0.0, 0.143713560791225886, wide);
            }
            next = steradian_ggx_cubature_add(next, steradian_fan_place(c.centre, outward, rim_cosine, share), om * share_weight);
            // At the end, here and below, as in steradian_conic_polish_poles.
            if (k + 1 == turns) {
                break;
            }
        }
        if (!(present && n > f32(j) + 1.5)) {
            break;
        }
    }
    return next;
}

// Limits what leaves: with shadowing no lobe sends more than it gets.
//
//   mean     means of (G2, G2 (1 - v.h)^5)
fn steradian_ggx_limited(amount: f32, mean: vec2f, smith: f32) -> vec2f {
    var whole = amount * mean.x;
    whole = select(whole, min(whole, 1.0), smith > 0.5);
    return vec2f(whole, clamp(amount * mean.y, 0.0, whole));
}

// Ends the second walk.
//
//   returns  radiance for radiance 1 as two numbers for steradian_ggx_radiance: with F = 1, and with F = (1 - v.h)^5
//
// Degenerate: weights that cancel leave the centre's value.
// Error: see docs/measured/accuracy.md, "GGX with shadowing and Fresnel".
fn steradian_ggx_cubature_finish(c: SteradianGgxCubature) -> vec2f {
    // The centre's values are known all along, its weight only now.
    let o = c.centre_weight * max(dot(c.view.w, c.centre), 0.0);
    let weight = c.weight + o;
    let usable = weight > 1.0e-9 * c.extent;
    let scale = 1.0 / select(1.0, weight, usable);
    var mean = (c.weighted + c.at_centre * o) * scale;
    mean = vec2f(clamp(mean.x, c.lowest.x, c.highest.x), clamp(mean.y, c.lowest.y, c.highest.y));
    mean = select(c.at_centre, mean, usable);
    return steradian_ggx_limited(c.amount, mean, c.smith);
}

// Shadowing and Fresnel at the centre only: one walk. Arguments as steradian_ggx_cubature_begin, result as steradian_ggx_cubature_finish.
fn steradian_ggx_draft(view: SteradianGgxView, e: vec3f, smith: f32, facing: f32) -> vec2f {
    let c = steradian_ggx_cubature_begin(view, e, smith, facing);
    return steradian_ggx_limited(c.amount, c.at_centre, smith);
}

// Radiance of one channel, for radiance 1.
//
//   r        of steradian_ggx_cubature_finish or steradian_ggx_draft
//   f0, f90  Schlick's reflectances
fn steradian_ggx_radiance(r: vec2f, f0: f32, f90: f32) -> f32 {
    return f0 * (r.x - r.y) + f90 * r.y;
}

// ==== half_vector ====

// Lobes of half vectors by edge splitting: a light's edge is split into arcs, each arc's image in half vector space is
// replaced by the great circle between its ends, along which the lobe's integral is closed, and what lies between the two
// is a sliver so thin that a few nodes along it serve.
//
// For lobes that have no closed form along the image itself (Blinn-Phong, Beckmann); GGX for comparison with
// ggx_closed_form.glsl. The arcs go where the edge passes the lobe: the poles of the GGX lobe of the same width say where.
//
//   SteradianConicArc edge = steradian_ggx_edge(view, a, b);
//   SteradianHalfVectorWalk walk = steradian_half_vector_begin(view, edge);
//   for j in 1 .. count:
//       walk = steradian_half_vector_next(walk, view, edge, steradian_half_vector_split_pole_mapped(edge, j / count))
//       sum of steradian_blinn_phong_arc or steradian_beckmann_arc from walk.a to walk.b, then steradian_half_vector_radiance; of steradian_ggx_arc, then steradian_ggx_draft
//       and of the lobe at each steradian_half_vector_node times its solid angle
//
// Frame and order: as ggx_closed_form.glsl.

// The GGX width whose lobe is as wide as Blinn-Phong's of exponent n: both have the mean squared slope 2 / (n + 2).
fn steradian_blinn_phong_alpha(n: f32) -> f32 {
    return sqrt(2.0 / (n + 2.0));
}

// Unit half vector at a place of an edge.
fn steradian_half_vector_at(view: SteradianGgxView, edge: SteradianConicArc, tau: f32) -> vec3f {
    let u = edge.u0 + (edge.u1 + edge.u2 * tau) * tau;
    let h = vec3f(view.ax * u.x, view.ay * u.y, u.z);
    return h * inverseSqrt(max(dot(h, h), steradian_smallest_divisor()));
}

// The place at a share of the edge's angle, seen from the surface: equal arcs on the light.
fn steradian_half_vector_split_uniform(edge: SteradianConicArc, share: f32) -> f32 {
    let first = steradian_trig_atan2(edge.scale * edge.begin, 1.0);
    let last = steradian_trig_atan2(edge.scale * edge.end, 1.0);
    let u = steradian_complex_unit(first + share * (last - first));
    return clamp(u.y / max(u.x * edge.scale, steradian_smallest_length()), edge.begin, edge.end);
}

// The place at a share of the angle C under which the poles see the edge, plus 0.3 for the edge's own length: arcs where
// the edge passes the lobe, and some for the rest.
//
// Newton's steps where they halve what is left, else the middle of a bracket: 5 or 6 as a rule, 24 at most; to the last
// digits, since a light that is thin, or seen edge-on, is what two edges leave of each other's errors: both must be split
// at the same places.
// Source: this project; the share 0.3 keeps arcs for where the lobe is dim (table in docs/theory/ggx.md).
fn steradian_half_vector_split_pole_mapped(edge: SteradianConicArc, share: f32) -> f32 {
    let first = steradian_trig_atan2(edge.scale * edge.begin, 1.0);
    let last = steradian_trig_atan2(edge.scale * edge.end, 1.0);
    let weight = 0.3 / max(last - first, 1.0e-12);
    let total = edge.sweep.x + edge.sweep.y + 0.3;
    let tolerance = 2.0e-6;
    let node = steradian_conic_node(edge, share);
    var tau = node.tau;
    var low = edge.begin;
    var high = edge.end;
    var left = total;
    var off = edge.end > edge.begin;
    for (var i: i32 = 0; i < 24; i++) {
        if (off) {
            let t = edge.scale * tau;
            let value = steradian_conic_sweep(edge.z1, edge.begin, tau) + steradian_conic_sweep(edge.z2, edge.begin, tau)
                + weight * (steradian_trig_atan2(t, 1.0) - first) - share * total;
            let x1 = tau - edge.z1.x;
            let x2 = tau - edge.z2.x;
            let slope = edge.z1.y / (x1 * x1 + edge.z1.y * edge.z1.y) + edge.z2.y / (x2 * x2 + edge.z2.y * edge.z2.y)
                + weight * edge.scale / (1.0 + t * t);
            low = select(low, tau, value < 0.0);
            high = select(tau, high, value < 0.0);
            let next = tau - value / slope;
            let fast = next > low && next < high && abs(value) < 0.5 * left;
            off = off && abs(value) > tolerance * total;
            left = abs(value);
            tau = select(tau, select(0.5 * (low + high), next, fast), off);
        }
    }
    return tau;
}

// Weight of the edge's own angle in steradian_half_vector_split_pole_mapped, per radian.
fn steradian_half_vector_split_weight(edge: SteradianConicArc) -> f32 {
    let first = steradian_trig_atan2(edge.scale * edge.begin, 1.0);
    let last = steradian_trig_atan2(edge.scale * edge.end, 1.0);
    return 0.3 / max(last - first, 1.0e-12);
}

// A place of an edge with how dense steradian_half_vector_split_pole_mapped lays its places there.
//
//   weight   steradian_half_vector_split_weight
fn steradian_half_vector_split_end(edge: SteradianConicArc, tau: f32, weight: f32) -> SteradianConicNode {
    let t = edge.scale * tau;
    let x1 = tau - edge.z1.x;
    let x2 = tau - edge.z2.x;
    var node: SteradianConicNode;
    node.tau = tau;
    node.density = edge.z1.y / (x1 * x1 + edge.z1.y * edge.z1.y) + edge.z2.y / (x2 * x2 + edge.z2.y * edge.z2.y)
        + weight * edge.scale / (1.0 + t * t);
    return node;
}

// A node in the sliver between a great circle and the image that it stands for.
//   h            unit half vector, half way between them
//   solid_angle  positive where the image lies outside the great circle, negative inside [sr]
struct SteradianHalfVectorNode {
    h: vec3f,
    solid_angle: f32,
}

// One node of the sliver between an arc's image and the great circle between its ends.
//
//   first, last steradian_half_vector_split_end of the arc's ends
//   a, b     steradian_half_vector_at of the same
//   rule     node and weight of a rule on [0, 1]: steradian_gauss_legendre_node
//
// The image's point x and its foot on the great circle of normal n are n g apart, g = n.x; swept along the arc, what lies
// between them has the solid angle -g n.(x dx) / |x|^3 at the middle. In tau the nodes lie by the map of ends to ends that is
// a quotient of lines and has the slopes of the splits: dense where the arc passes the lobe.
// Degenerate: an arc of no length has no sliver.
// Error: of the rule, with four nodes a tenth to a hundredth of what the great circle alone is off; docs/measured/accuracy.md, "Half vectors".
// Source: this project.
fn steradian_half_vector_between(view: SteradianGgxView, edge: SteradianConicArc, first: SteradianConicNode, last: SteradianConicNode, a: vec3f, b: vec3f, rule: vec2f) -> SteradianHalfVectorNode {
    let bend = sqrt(first.density / max(last.density, steradian_smallest_divisor()));
    let bottom = 1.0 / (rule.x + bend * (1.0 - rule.x));
    let length = last.tau - first.tau;
    let tau = first.tau + length * rule.x * bottom;
    let step = length * bend * bottom * bottom * rule.y;

    let u = edge.u0 + (edge.u1 + edge.u2 * tau) * tau;
    let du = edge.u1 + edge.u2 * (2.0 * tau);
    var x = vec3f(view.ax * u.x, view.ay * u.y, u.z);
    let dx = vec3f(view.ax * du.x, view.ay * du.y, du.z);
    let inverse = inverseSqrt(max(dot(x, x), steradian_smallest_divisor()));
    x = x * inverse;
    var n = cross(a, b - a);
    let n2 = dot(n, n);
    n = n * inverseSqrt(max(n2, steradian_smallest_square()));
    let apart = dot(n, x - a);
    let middle = x - n * (0.5 * apart);
    let shorter = inverseSqrt(max(dot(middle, middle), steradian_smallest_divisor()));
    let sweep = dot(n, cross(x, dx)) * inverse * step;
    var node: SteradianHalfVectorNode;
    node.h = middle * shorter;
    node.solid_angle = select(0.0, -apart * sweep * (shorter * shorter * shorter), n2 > steradian_smallest_square());
    return node;
}

// A walk over the arcs of an edge.
//   weight       steradian_half_vector_split_weight
//   first, last  steradian_half_vector_split_end of the last arc's ends
//   a, b         steradian_half_vector_at of the same
struct SteradianHalfVectorWalk {
    weight: f32,
    first: SteradianConicNode,
    last: SteradianConicNode,
    a: vec3f,
    b: vec3f,
}

// The walk before the first arc.
fn steradian_half_vector_begin(view: SteradianGgxView, edge: SteradianConicArc) -> SteradianHalfVectorWalk {
    var walk: SteradianHalfVectorWalk;
    walk.weight = steradian_half_vector_split_weight(edge);
    walk.last = steradian_half_vector_split_end(edge, edge.begin, walk.weight);
    walk.b = steradian_half_vector_at(view, edge, edge.begin);
    walk.first = walk.last;
    walk.a = walk.b;
    return walk;
}

// Goes on to the arc that ends at tau.
fn steradian_half_vector_next(walk: SteradianHalfVectorWalk, view: SteradianGgxView, edge: SteradianConicArc, tau: f32) -> SteradianHalfVectorWalk {
    var next = walk;
    next.first = walk.last;
    next.a = walk.b;
    next.last = steradian_half_vector_split_end(edge, tau, walk.weight);
    next.b = steradian_half_vector_at(view, edge, tau);
    return next;
}

// Number of nodes of an arc's sliver: three have four to ten times the error (docs/measured/accuracy.md, "Half vectors").
fn steradian_half_vector_nodes() -> i32 { return 4; }

// Node i of the last arc's sliver.
fn steradian_half_vector_node(walk: SteradianHalfVectorWalk, view: SteradianGgxView, edge: SteradianConicArc, i: i32) -> SteradianHalfVectorNode {
    let rule = steradian_gauss_legendre_node(steradian_half_vector_nodes(), i);
    return steradian_half_vector_between(view, edge, walk.first, walk.last, walk.a, walk.b, rule);
}

// Blinn-Phong's lobe at a half vector, in the unit of steradian_blinn_phong_arc for each steradian of half vectors.
//
//   h        unit
fn steradian_blinn_phong_at_half_vector(h: vec3f, v: vec3f, n: f32) -> f32 {
    return 2.0 * steradian_pi() * steradian_blinn_phong_distribution(h, n) * max(dot(h, v), 0.0);
}

// Beckmann's lobe at a half vector, in the unit of steradian_beckmann_arc for each steradian of half vectors.
fn steradian_beckmann_at_half_vector(view: SteradianGgxView, h: vec3f) -> f32 {
    return 2.0 * steradian_pi() * steradian_beckmann_distribution(h, view.ax, view.ay) * max(dot(h, view.v), 0.0);
}

// The measure of GGX at a half vector, in the unit of steradian_ggx_arc for each steradian of half vectors.
fn steradian_ggx_at_half_vector(view: SteradianGgxView, h: vec3f) -> vec3f {
    let u = vec3f(h.x / view.ax, h.y / view.ay, h.z);
    let inverse2 = 1.0 / dot(u, u);
    return u * ((inverse2 / view.ax) * (inverse2 / view.ay));
}

// One arc's share of Blinn-Phong: 2 pi v_z times the radiance, exact along the great circle.
//
//   a, b     unit half vectors of the arc's ends, in walk order
//   v        unit view
//   n        exponent, at least 0
//
// (n + 2) / (2 pi) h_z^n (v.h) is a double-axis moment, of axes z and v.
fn steradian_blinn_phong_arc(a: vec3f, b: vec3f, v: vec3f, n: f32) -> f32 {
    let z = vec3f(0.0, 0.0, 1.0);
    let edge = steradian_moment_edge(a, b, z);
    let front = steradian_moment_quadrature_front(edge, max(n, 1.0e-6) - 1.0);
    return steradian_moment_double_axis_share(a, b, z, v, steradian_moment_edge_share(edge, front.moment), front.power);
}

// One arc's share of Blinn-Phong as in steradian_blinn_phong_arc, by the cosine series and the error function instead of quadrature.
//
//   series   of exponent n - 1, or of n + 1 where n < 2
//   range    0 for n >= 8, 1 for 2 <= n < 8, 2 for n < 2; the same for every lane
//
// Error: of the series, see docs/measured/accuracy.md, "phong series".
fn steradian_blinn_phong_arc_approximate(a: vec3f, b: vec3f, v: vec3f, series: SteradianMomentSeries, n: f32, range: i32) -> f32 {
    let z = vec3f(0.0, 0.0, 1.0);
    let edge = steradian_moment_edge(a, b, z);
    var front = 0.0;
    if (range == 2) {
        front = steradian_moment_series_low_front(edge, series, n - 1.0);
    } else {
        front = steradian_moment_series_front(edge, series);
    }
    var low: i32 = 0;
    if (range > 0) {
        low = 1;
    }
    return steradian_moment_double_axis_share(a, b, z, v, steradian_moment_edge_share(edge, front), steradian_moment_cosine_front(edge, n, low));
}

// The error function. Error: 1.5e-7 absolute.
// Source: Abramowitz, Stegun, "Handbook of mathematical functions", 1964, 7.1.26.
fn steradian_beckmann_error_function_approximate(x: f32) -> f32 {
    let t = abs(x);
    let e = 1.0 / (1.0 + 0.3275911 * t);
    let p = ((((1.061405429 * e - 1.453152027) * e + 1.421413741) * e - 0.284496736) * e + 0.254829592) * e;
    let y = 1.0 - p * exp(-min(t * t, 80.0));
    return select(y, -y, x < 0.0);
}

// The series that steradian_beckmann_arc takes: that of an infinite exponent.
fn steradian_beckmann_series() -> SteradianMomentSeriesHigh {
    var series = steradian_moment_series_high_prepare(1.0e30);
    series.m = 2.0;  // log_c below is the square of the distance
    return series;
}

// One arc's share of Beckmann: 2 pi v_z times the radiance.
//
//   a, b     unit half vectors of the arc's ends, in walk order, above the surface
//   series   steradian_beckmann_series()
//
// In the plane of slopes, divided by the widths, a great circle is a straight line and the lobe exp(-p^2) / pi times
// w.(p, 1): the constant part is Phong's boundary integral at infinite exponent, the linear one an error function.
// Error: of the series; see docs/measured/accuracy.md, "half vector".
fn steradian_beckmann_arc(view: SteradianGgxView, a: vec3f, b: vec3f, series: SteradianMomentSeriesHigh) -> f32 {
    let za = 1.0 / max(a.z, 1.0e-6);
    let zb = 1.0 / max(b.z, 1.0e-6);
    let p = vec2f(a.x * za / view.ax, a.y * za / view.ay);
    let q = vec2f(b.x * zb / view.ax, b.y * zb / view.ay);
    var along = q - p;
    let length2 = dot(along, along);
    let usable = length2 > steradian_smallest_divisor();
    along = along * inverseSqrt(max(length2, steradian_smallest_divisor()));
    let d = p.x * along.y - p.y * along.x;
    let low = dot(p, along);
    let high = dot(q, along);

    var edge: SteradianMomentEdge;
    edge.side = select(1.0, -1.0, d < 0.0);
    edge.s = max(abs(d), 1.0e-6);
    edge.c = 1.0;
    edge.x0 = 1.0;
    edge.y0 = low;
    edge.x1 = 1.0;
    edge.y1 = high;
    edge.log_c = min(edge.s * edge.s, 80.0);
    edge.swept = 0.0;
    let around = steradian_moment_edge_share(edge, steradian_moment_series_high_front(edge, series));
    let across = exp(-edge.log_c) * 0.886226925452758014
        * (steradian_beckmann_error_function_approximate(high) - steradian_beckmann_error_function_approximate(low));
    let share = view.w.z * around + (view.w.y * along.x - view.w.x * along.y) * across;
    return select(0.0, share, usable);
}

// One arc's share of E (ggx_closed_form.glsl) for GGX, exact along the great circle.
fn steradian_ggx_arc(view: SteradianGgxView, a: vec3f, b: vec3f) -> vec3f {
    let p = steradian_polygon_direction(vec3f(a.x / view.ax, a.y / view.ay, a.z));
    let q = steradian_polygon_direction(vec3f(b.x / view.ax, b.y / view.ay, b.z));
    return steradian_polygon_edge(p, q);
}

// Radiance from the sum over the arcs, for radiance 1; not negative.
//
//   facing   1.0; -1.0 where the light is seen from behind
fn steradian_half_vector_radiance(view: SteradianGgxView, sum: f32, facing: f32) -> f32 {
    return max(sum * facing, 0.0) * steradian_inverse_two_pi() / view.v.z;
}

// ==== slopes ====

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
// Source: Reynolds' transport theorem, applied to the boundary integrals of polygon.glsl, ltc.glsl, moment.glsl and ggx_closed_form.glsl.

// Derivatives of one integral by an edge's ends.
//   normal    of the edge's part, start cross end: not unit
//   by_start, by_end  derivative by the end's unit direction, over the normal
struct SteradianEdgeSlopes {
    normal: vec3f,
    by_start: f32,
    by_end: f32,
}

// The same for two integrals: with F = 1, and with F = (1 - v.h)^5.
//   turn, turn_of_fresnel  INT f (2 (N.h) h - N) ds, N the plane's unit normal: the edge's part of the derivative by the view
struct SteradianEdgeSlopesOfBoth {
    normal: vec3f,
    by_start: vec2f,
    by_end: vec2f,
    turn: vec3f,
    turn_of_fresnel: vec3f,
}

// Irradiance of an edge's part by its own ends, which are not below the horizon.
//
// INT l_z s ds over the arc, l = s start + t end, has the closed form |n| (start_z P + end_z Q) / 2 with F the angle over the sine,
// Q its slope and P = F - c Q.
// Error: opposite ends, where the point lies on the edge, give finite numbers.
fn steradian_edge_irradiance_slopes(start: vec3f, end: vec3f) -> SteradianEdgeSlopes {
    var slopes: SteradianEdgeSlopes;
    slopes.normal = cross(start, end - start);
    let c = dot(start, end);
    let half_angle = steradian_trig_angle_over_sine_and_slope(c, dot(slopes.normal, slopes.normal)) * 0.5;
    let q = half_angle.y;
    let p = half_angle.x - c * q;
    slopes.by_start = -(start.z * p + end.z * q);
    slopes.by_end = -(end.z * p + start.z * q);
    return slopes;
}

// The derivatives by an edge's ends from those by the ends of its part.
fn steradian_edge_slopes_of_whole(part: SteradianEdgePart, of_part: SteradianEdgeSlopes) -> SteradianEdgeSlopes {
    var slopes = of_part;
    if (part.rises || part.sinks) {
        slopes.by_start = part.start_a * of_part.by_start + part.end_a * of_part.by_end;
        slopes.by_end = part.start_b * of_part.by_start + part.end_b * of_part.by_end;
    }
    return slopes;
}

// Derivatives of the irradiance for radiance 1 (steradian_polygon_irradiance) by the ends of one edge.
//
//   part     of steradian_edge_above_horizon: a walk that computes the value has it already (steradian_polygon_add_part)
//
// Degenerate: an edge of no length, or below the horizon, has a normal of 0. Opposite ends, where the point lies on the edge, give
// finite numbers.
// Error: see docs/measured/accuracy.md, "polygon, edge slopes".
fn steradian_polygon_part_slopes(part: SteradianEdgePart) -> SteradianEdgeSlopes {
    return steradian_edge_slopes_of_whole(part, steradian_edge_irradiance_slopes(part.start, part.end));
}

// The same from the ends.
//
//   a, b     unit directions of the ends (steradian_polygon_direction), in walk order
fn steradian_polygon_edge_slopes(a: vec3f, b: vec3f) -> SteradianEdgeSlopes {
    return steradian_polygon_part_slopes(steradian_edge_above_horizon(a, b));
}

// Derivatives of the integral of a linearly transformed cosine (steradian_ltc_integral) by the ends of one edge.
//
//   part       of steradian_ltc_part
//   lobe_part  steradian_edge_above_horizon(part.start, part.end): above the lobe's own horizon
//   returns    derivatives by steradian_ltc_direction(m, a) and steradian_ltc_direction(m, b): the derivative by a is steradian_ltc_edge_transform_back of it
//
// The edges that close the real horizon lie in its image and do not move.
// Degenerate: as steradian_polygon_part_slopes.
// Error: see docs/measured/accuracy.md, "LTC, edge slopes".
fn steradian_ltc_part_slopes(part: SteradianEdgePart, lobe_part: SteradianEdgePart) -> SteradianEdgeSlopes {
    var slopes = steradian_edge_slopes_of_whole(part, steradian_polygon_part_slopes(lobe_part));
    slopes.normal = slopes.normal * steradian_inverse_pi();
    return slopes;
}

// The same from the ends.
//
//   a, b     unit directions of the ends in the shading frame, in walk order
fn steradian_ltc_edge_slopes(m: SteradianLtcMatrix, a: vec3f, b: vec3f) -> SteradianEdgeSlopes {
    let part = steradian_ltc_part(m, a, b, steradian_ltc_direction(m, a), steradian_ltc_direction(m, b));
    return steradian_ltc_part_slopes(part, steradian_edge_above_horizon(part.start, part.end));
}

// The derivative by v from that by steradian_ltc_direction(m, v): M^-T over the length of M^-1 v.
fn steradian_ltc_edge_transform_back(m: SteradianLtcMatrix, v: vec3f, g: vec3f) -> vec3f {
    let under = steradian_ltc_transform(m, v);
    return steradian_ltc_transform_transposed(m, g * inverseSqrt(max(dot(under, under), steradian_smallest_square())));
}

// Derivatives of the Phong lobe's integral, (n + 1)/(2 pi) times the moment, by the ends of one edge.
//
//   part     of steradian_edge_above_horizon
//   r        unit axis of the lobe, the mirrored view
//   n        exponent, 0 or more
//   low      1 for n < 7, else 0; the same for every lane
//
// On the edge, x = l.r = c cos phi with phi from the foot. So INT x^n l dphi is that of x^(n + 1) towards the foot, and has the
// antiderivative -x^(n + 1)/(n + 1) across it. Edges shorter than two widths of the lobe, in front of its equator, take Gauss and Legendre's
// rule, since a difference of two antiderivatives would lose their digits: its error is 3e-5 at two widths.
// Degenerate: an edge of no length, or behind the lobe's equator, has derivatives of 0.
// Error: see docs/measured/accuracy.md, "Phong, edge slopes"; that of steradian_moment_cosine_front, 4e-5 of the full lobe for n >= 1.
fn steradian_phong_part_slopes(part: SteradianEdgePart, r: vec3f, n: f32, low: i32) -> SteradianEdgeSlopes {
    let sum = part.start + part.end;
    let chord = part.end - part.start;
    let chord2 = dot(chord, chord);
    let sum_inverse = inverseSqrt(max(dot(sum, sum), steradian_smallest_divisor()));
    let chord_inverse = inverseSqrt(max(chord2, steradian_smallest_divisor()));
    // The axis at the part's middle and along it there.
    let axis_middle = dot(r, sum) * sum_inverse;
    let axis_along = dot(r, chord) * chord_inverse;
    let m = n + 1.0;
    // INT f cos t dt and INT f sin t dt, with t from the middle.
    var even = 0.0;
    var odd = 0.0;
    let is_short = chord2 * m < 4.0 && chord2 < 1.0 && dot(r, part.start) > 0.0 && dot(r, part.end) > 0.0;
    if (is_short) {
        let half_tangent = sum_inverse * chord2 * chord_inverse;
        for (var i: i32 = 0; i < 4; i++) {
            let rule = steradian_gauss_legendre_node(4, i);
            let u = half_tangent * (2.0 * rule.x - 1.0);
            let cosine = inverseSqrt(1.0 + u * u);
            let x = (axis_middle + axis_along * u) * cosine;
            let w = 2.0 * half_tangent * rule.y * steradian_phong_power(x, n) * cosine * cosine * cosine;
            even = even + w;
            odd = odd + w * u;
        }
    }
    if (!is_short) {
        let edge = steradian_moment_edge(part.start, part.end, r);
        let towards = steradian_moment_cosine_front(edge, m, low);
        let across = (steradian_phong_power(edge.x0, m) - steradian_phong_power(edge.x1, m)) / m;
        let over_c2 = 1.0 / (edge.c * edge.c);
        even = select((towards * axis_middle - across * axis_along) * over_c2, even, is_short);
        odd = select((towards * axis_along + across * axis_middle) * over_c2, odd, is_short);
    }
    var of_part: SteradianEdgeSlopes;
    of_part.normal = cross(part.start, chord);
    let n2 = dot(of_part.normal, of_part.normal);
    let scale = select(0.0, -m * steradian_inverse_two_pi() * inverseSqrt(max(n2, steradian_smallest_divisor())), n2 > steradian_smallest_divisor());
    even = even * sum_inverse;
    odd = odd * chord_inverse;
    of_part.by_start = (even - odd) * scale;
    of_part.by_end = (even + odd) * scale;
    return steradian_edge_slopes_of_whole(part, of_part);
}

// The same from the ends.
//
//   a, b     unit directions of the ends (steradian_polygon_direction), in walk order
fn steradian_phong_edge_slopes(a: vec3f, b: vec3f, r: vec3f, n: f32, low: i32) -> SteradianEdgeSlopes {
    return steradian_phong_part_slopes(steradian_edge_above_horizon(a, b), r, n, low);
}

// Derivatives of the GGX lobe's integral, with shadowing and Fresnel, by the ends of one edge.
//
//   part     of steradian_edge_above_horizon
//   arc      steradian_ggx_edge(view, part.start, part.end): an edge whose value was computed has it already
//   smith    1 with shadowing, 0 without
//   nodes, pieces  Gauss and Legendre's nodes (1 to 6, or 8) in each of so many equal pieces of the poles' angle
//
// Only the lobe along the edge counts, so that shadowing and Fresnel are exact here but for the rule. 4 nodes serve packs, 6 single values.
// Degenerate: an edge of no length has derivatives of 0.
// Error: see docs/measured/accuracy.md, "GGX, edge slopes"; with 6 nodes 4.0e-3 of the light's largest derivative at the 99th percentile.
fn steradian_ggx_edge_slopes_of_part(view: SteradianGgxView, part: SteradianEdgePart, arc: SteradianConicArc, smith: f32, nodes: i32, pieces: i32) -> SteradianEdgeSlopesOfBoth {
    let sum = part.start + part.end;
    let chord = part.end - part.start;
    let sum_inverse = inverseSqrt(max(dot(sum, sum), steradian_smallest_divisor()));
    let chord_inverse = inverseSqrt(max(dot(chord, chord), steradian_smallest_divisor()));
    // (cosine, sine) of the angle from the part's middle to the place from which tau counts: one of the ends, or the middle.
    let half_cosine = 0.5 / sum_inverse;
    let half_sine = 0.5 / chord_inverse;
    let from_start = !(arc.begin < 0.0);
    let from_end = !(arc.end > 0.0);
    let base = vec2f(select(1.0, half_cosine, from_start || from_end), select(select(0.0, half_sine, from_end), -half_sine, from_start));
    let n = cross(part.start, chord);
    let across = n * inverseSqrt(max(dot(n, n), steradian_smallest_divisor()));
    var even = vec2f(0.0, 0.0);
    var odd = vec2f(0.0, 0.0);
    var turn = vec3f(0.0, 0.0, 0.0);
    var turn_of_fresnel = vec3f(0.0, 0.0, 0.0);
    let total = arc.sweep.x + arc.sweep.y;
    let share = 1.0 / f32(pieces);
    for (var i: i32 = 0; i < pieces; i++) {
        for (var j: i32 = 0; j < nodes; j++) {
            let rule = steradian_gauss_legendre_node(nodes, j);
            let node = steradian_conic_node(arc, (rule.x + f32(i)) * share);
            let u = arc.u0 + (arc.u1 + arc.u2 * node.tau) * node.tau;
            let p = vec3f(u.x * view.ax, u.y * view.ay, u.z);  // (l + v) times a positive factor
            let p2 = max(dot(p, p), steradian_smallest_divisor());
            let along = dot(p, view.v);
            let u2 = max(dot(u, u), steradian_smallest_divisor());
            let l = p * (2.0 * along / p2) - view.v;
            let g = 1.0 + smith * (steradian_ggx_shadowing(l, view.v, view.ax, view.ay) - 1.0);
            let w = (p2 / u2) * (along / u2) * g * rule.y * share * total / max(node.density, steradian_smallest_divisor());
            let p_inverse = inverseSqrt(p2);
            let both = vec2f(w, w * steradian_fresnel_schlick(0.0, 1.0, along * p_inverse));
            let h = p * p_inverse;
            let moved = h * (2.0 * dot(across, h)) - across;
            turn = turn + moved * both.x;
            turn_of_fresnel = turn_of_fresnel + moved * both.y;
            // l = even (start + end) + odd (end - start), by its angle from the middle: from l itself, a short edge in float would lose
            // the digits of `odd`.
            let t = node.tau * arc.scale;
            let d = 1.0 / (1.0 + t * t);
            let angle = steradian_complex_product(base, vec2f((1.0 - t * t) * d, 2.0 * t * d));
            even = even + both * (angle.x * sum_inverse);
            odd = odd + both * (angle.y * chord_inverse);
        }
    }
    var density = arc.scale * steradian_inverse_pi() / (view.ax * view.ay * view.v.z);
    density = select(0.0, density, arc.end > arc.begin);
    let scale = -density * inverseSqrt(max(dot(n, n), steradian_smallest_divisor()));
    let by_part_start = (even - odd) * scale;
    let by_part_end = (even + odd) * scale;
    var slopes: SteradianEdgeSlopesOfBoth;
    slopes.normal = n;
    slopes.by_start = by_part_start * part.start_a + by_part_end * part.end_a;
    slopes.by_end = by_part_start * part.start_b + by_part_end * part.end_b;
    slopes.turn = turn * density;
    slopes.turn_of_fresnel = turn_of_fresnel * density;
    return slopes;
}

// The same from the ends.
//
//   a, b     unit directions of the ends (steradian_polygon_direction), in walk order
fn steradian_ggx_edge_slopes(view: SteradianGgxView, a: vec3f, b: vec3f, smith: f32, nodes: i32, pieces: i32) -> SteradianEdgeSlopesOfBoth {
    let part = steradian_edge_above_horizon(a, b);
    return steradian_ggx_edge_slopes_of_part(view, part, steradian_ggx_edge(view, part.start, part.end), smith, nodes, pieces);
}
