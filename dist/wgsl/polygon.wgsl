// Steradian 0.1.0, polygon: polygons: irradiance, solid angle, clipping to the horizon; Lambert's lobe, for WGSL.
//
// Put it before your module's text; it has no bindings.
// It needs these files before it, in this order: math.wgsl.
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

// ==== polygon ====

// Irradiance and solid angle of polygonal lights: the boundary integrals of Lambert and Girard.
//
// A light is walked edge by edge, so that any number of vertices, non-convex outlines and holes (walked the other
// way round) cost no array. Frame: origin at the shading point, z the surface normal. Walk order: seen from the
// point, det(v_i, v_i+1, inside) > 0, the reverse of a stored polygon that is counter-clockwise from its lit side.

// The state of a walk.
//   edges    sum over the edges, each clipped to the horizon, of half its angle times its plane's unit normal [rad]
//   horizon  product of unit complex numbers: its angle is the arc of the horizon that closes the clipped outline
struct SteradianPolygonWalk {
    edges: vec3f,
    horizon: vec2f,
}

// Unit direction of a vertex.
//
//   v        vertex relative to the shading point, any unit of length
//
// Degenerate: a length below 1e-18 (the point lies on the vertex) gives a vector shorter than 1; one above 1e18, whose
// square leaves the range of float, the zero vector. Both are finite and add next to nothing to any sum.
fn steradian_polygon_direction(v: vec3f) -> vec3f {
    let d2 = dot(v, v);
    let scale = select(0.0, inverseSqrt(max(d2, steradian_smallest_square())), d2 < 1.0e36);
    return v * scale;
}

// Irradiance vector of one edge: half the edge's angle times its plane's unit normal [rad].
//
//   a, b     unit directions of the edge's ends, in walk order
//   returns  its z is what the edge sends to a surface with normal z; divided by pi: the form factor's share
//
// Degenerate: a = b gives 0; a = -b spans no plane and gives 0.
// Error: see docs/measured/accuracy.md, "polygon edge"; the normal is taken from the ends' difference, so that the rounding of the
// product is a share of the edge's length and not of 1.
// Source: Lambert 1760; Baum, Rushmeier, Winget, "Improving radiosity solutions through the use of analytically
// determined form-factors", 1989, eq. 6.
fn steradian_polygon_edge(a: vec3f, b: vec3f) -> vec3f {
    let n = cross(a, b - a);
    let f = steradian_trig_angle_over_sine(dot(a, b), dot(n, n));
    return n * (0.5 * f);
}

// A walk before its first edge: no edges, and a horizon of angle 0.
fn steradian_polygon_begin() -> SteradianPolygonWalk {
    var walk: SteradianPolygonWalk;
    walk.edges = vec3f(0.0, 0.0, 0.0);
    walk.horizon = vec2f(1.0, 0.0);
    return walk;
}

// The part of an edge above the horizon, by its ends: start = a start_a + b start_b, end = a end_a + b end_b.
//   start, end   unit directions; equal where nothing is above
//   rises, sinks whether the part begins, or ends, on the horizon
struct SteradianEdgePart {
    start: vec3f,
    end: vec3f,
    start_a: f32,
    start_b: f32,
    end_a: f32,
    end_b: f32,
    rises: bool,
    sinks: bool,
}

// An edge as a part of itself.
fn steradian_edge_whole(a: vec3f, b: vec3f) -> SteradianEdgePart {
    var part: SteradianEdgePart;
    part.start = a;
    part.end = b;
    part.start_a = 1.0;
    part.start_b = 0.0;
    part.end_a = 0.0;
    part.end_b = 1.0;
    part.rises = steradian_mask_none();
    part.sinks = steradian_mask_none();
    return part;
}

// Clips an edge to the horizon z = 0.
//
//   a, b     unit directions of the edge's ends (steradian_polygon_direction), in walk order
//
// Degenerate: an edge below the horizon has equal ends.
fn steradian_edge_above_horizon(a: vec3f, b: vec3f) -> SteradianEdgePart {
    let a_below = a.z < 0.0;
    let b_below = b.z < 0.0;
    var part = steradian_edge_whole(a, b);
    part.rises = a_below && !b_below;
    part.sinks = b_below && !a_below;
    if (a_below || b_below) {
        // The edge's crossing of the horizon: weights of one sign, so nothing cancels.
        let wa = abs(b.z);
        let wb = abs(a.z);
        let p = vec2f(a.x * wa + b.x * wb, a.y * wa + b.y * wb);
        let scale = inverseSqrt(max(dot(p, p), steradian_smallest_square()));
        let crossing = vec3f(p.x * scale, p.y * scale, 0.0);
        part.start = select(a, crossing, a_below);
        part.end = select(b, crossing, b_below);  // both below: start = end, an edge of no length
        part.start_a = select(1.0, wa * scale, a_below);
        part.start_b = select(0.0, wb * scale, a_below);
        part.end_a = select(0.0, wa * scale, b_below);
        part.end_b = select(1.0, wb * scale, b_below);
    }
    return part;
}

// Adds the part of an edge above the horizon (steradian_edge_above_horizon).
//
// What lies below is replaced by an arc of the horizon from where the outline leaves to where it comes back. All
// these arcs of a plane light lie within one half circle and run the same way, so that only the sum of their angles
// counts: each crossing multiplies its azimuth into a complex number, in whatever order the crossings come.
fn steradian_polygon_add_part(walk: SteradianPolygonWalk, part: SteradianEdgePart) -> SteradianPolygonWalk {
    var next = walk;
    let crosses = part.rises || part.sinks;
    if (crosses) {
        let crossing = select(part.end, part.start, part.rises);
        let y = select(-crossing.y, crossing.y, part.rises);  // coming up: the azimuth; going down: its conjugate
        let h = walk.horizon;
        next.horizon = select(h, vec2f(h.x * crossing.x - h.y * y, h.x * y + h.y * crossing.x), crosses);
    }
    next.edges = walk.edges + steradian_polygon_edge(part.start, part.end);
    return next;
}

// Adds one edge, clipped to the horizon z = 0.
//
//   a, b     unit directions of the edge's ends (steradian_polygon_direction), in walk order
fn steradian_polygon_add_edge(walk: SteradianPolygonWalk, a: vec3f, b: vec3f) -> SteradianPolygonWalk {
    var next = walk;
    if (!(a.z < 0.0) || !(b.z < 0.0)) {
        next = steradian_polygon_add_part(walk, steradian_edge_above_horizon(a, b));
    }
    return next;
}

// Irradiance vector of the part of the light above the horizon [sr times radiance 1].
//
//   reversed true where the light is seen from behind, so that the walk ran the wrong way round
//   returns  in the shading frame; z is the irradiance, the direction is where the light is, seen on average
//
// Degenerate: a point in the light's plane gives 0 up to rounding.
fn steradian_polygon_irradiance_vector(walk: SteradianPolygonWalk, reversed: bool) -> vec3f {
    let facing = select(1.0, -1.0, reversed);
    var arc = 0.0;
    if (abs(walk.horizon.y) > 0.0 || walk.horizon.x < 0.0) {
        arc = steradian_trig_atan2_unwrapped(facing * walk.horizon.y, walk.horizon.x);
    }
    let e = walk.edges * facing;
    return vec3f(e.x, e.y, clamp(e.z + 0.5 * arc, 0.0, steradian_pi()));
}

// Irradiance of radiance 1 from the part of the light above the horizon, in [0, pi]. See steradian_polygon_irradiance_vector.
//
// Error: see docs/measured/accuracy.md, "polygon irradiance".
fn steradian_polygon_irradiance(walk: SteradianPolygonWalk, reversed: bool) -> f32 {
    let e = steradian_polygon_irradiance_vector(walk, reversed);
    return e.z;
}

// The state of a solid angle's walk: a product of complex numbers, each with half a triangle's solid angle.
struct SteradianSolidAngleWalk {
    first: vec3f,
    product: vec2f,
}

// A solid angle's walk before its first triangle.
//
//   first    unit direction of any vertex of the light
fn steradian_solid_angle_begin(first: vec3f) -> SteradianSolidAngleWalk {
    var walk: SteradianSolidAngleWalk;
    walk.first = first;
    walk.product = vec2f(1.0, 0.0);
    return walk;
}

// Adds the triangle of the first vertex and one edge. Directions as for steradian_polygon_add_edge; no horizon here.
//
// Degenerate: a triangle without area has a real factor and adds nothing.
// Source: Van Oosterom, Strackee, "The solid angle of a plane triangle", 1983, eq. 8.
fn steradian_solid_angle_add_edge(walk: SteradianSolidAngleWalk, a: vec3f, b: vec3f) -> SteradianSolidAngleWalk {
    var next = walk;
    var re = 1.0 + dot(walk.first, a) + dot(a, b) + dot(b, walk.first);
    var im = dot(walk.first, cross(a - walk.first, b - a));  // the determinant, from differences: it is small where they are
    let scale = inverseSqrt(max(re * re + im * im, steradian_smallest_square()));
    re = re * scale;
    im = im * scale;
    let p = walk.product;
    next.product = vec2f(p.x * re - p.y * im, p.x * im + p.y * re);
    return next;
}

// Solid angle of a plane light, in [0, 2 pi] [sr].
//
//   reversed true where the light is seen from behind, so that the walk ran the wrong way round
//
// Error: see docs/measured/accuracy.md, "polygon solid angle".
fn steradian_solid_angle_finish(walk: SteradianSolidAngleWalk, reversed: bool) -> f32 {
    let y = select(walk.product.y, -walk.product.y, reversed);
    return max(2.0 * steradian_trig_atan2_unwrapped(y, walk.product.x), 0.0);
}

// ==== horizon_clip ====

// Clipping a walked outline to the horizon, for integrals along its edges.
//
// Lambert's integral needs only the length of the arcs of the horizon that close a clipped outline
// (steradian_polygon_add_edge); every other boundary integral has to be taken along them. The clip hands them out as ordinary
// edges: where the outline comes back up, the arc from where it last went down. An outline that begins below the
// horizon comes up before it was seen to go down: this first entry is kept, and the last arc ends there.
// The arcs of a plane light lie on one half circle, and what counts is the signed sum over them; so arcs may join
// different contours, and one clip serves a whole light with its holes:
//
//   SteradianHorizonClip clip = steradian_horizon_clip_begin();
//   for each edge a, b of each contour:
//       clip = steradian_horizon_clip_edge(clip, a, b);
//       integrate clip.start, clip.end
//       if (any_lane(clip.closes)) integrate clip.arc_start, clip.arc_end
//   clip = steradian_horizon_clip_finish(clip);
//   if (any_lane(clip.closes)) integrate clip.arc_start, clip.arc_end
// each arc in two where it is wide (steradian_horizon_arc_wide, steradian_horizon_arc_middle)
//
// Frame: z the surface normal; unit directions (steradian_polygon_direction) in walk order.

// The state of a clip and what it last handed out.
//   start, end          the edge's part above the horizon; equal where there is none
//   arc_start, arc_end  an arc of the horizon that belongs to the outline; equal where there is none
//   closes              whether there is an arc
//   leave               where the outline last went down and did not come back yet; zero: nowhere
//   entry               where it came up without having been seen to go down; zero: nowhere
struct SteradianHorizonClip {
    start: vec3f,
    end: vec3f,
    arc_start: vec3f,
    arc_end: vec3f,
    closes: bool,
    leave: vec3f,
    entry: vec3f,
}

// The state before the first edge.
fn steradian_horizon_clip_begin() -> SteradianHorizonClip {
    let nowhere = vec3f(0.0, 0.0, 0.0);
    var clip: SteradianHorizonClip;
    clip.start = nowhere;
    clip.end = nowhere;
    clip.arc_start = nowhere;
    clip.arc_end = nowhere;
    clip.closes = steradian_mask_none();
    clip.leave = nowhere;
    clip.entry = nowhere;
    return clip;
}

// The direction in which the edge from a to b crosses the plane z = 0; their z must differ in sign.
//
// Degenerate: an edge through the zenith's axis, or an end that is the zero vector, has no azimuth and gives zero.
// Error: weights of one sign, so nothing cancels unless a and b are nearly opposite.
fn steradian_horizon_crossing(a: vec3f, b: vec3f) -> vec3f {
    let wa = abs(b.z);
    let wb = abs(a.z);
    var p = vec2f(a.x * wa + b.x * wb, a.y * wa + b.y * wb);
    p = p * inverseSqrt(max(dot(p, p), steradian_smallest_square()));
    return vec3f(p.x, p.y, 0.0);
}

// True where an arc from a to b may be nearly half the horizon: integrals take it in two.
fn steradian_horizon_arc_wide(a: vec3f, b: vec3f) -> bool { return dot(a, b) < -0.9999; }

// A direction between the ends of an arc of the horizon that is wider than a right angle.
//
//   a, b     unit directions of its ends, z = 0
//   facing   1.0; -1.0 where the light is seen from behind, so that the walk ran the wrong way round
//
// Two ends that are opposite to rounding say no more which half of the horizon is meant: it is the one that the walk goes round the
// zenith, as the arcs that close an outline do.
// Degenerate: equal ends give a zero vector.
fn steradian_horizon_arc_middle(a: vec3f, b: vec3f, facing: f32) -> vec3f {
    let unsure = 1.0e-6;
    var across = vec2f(b.y - a.y, a.x - b.x) * facing;
    let turn = (a.x * b.y - a.y * b.x) * facing;
    across = across * (inverseSqrt(max(dot(across, across), steradian_smallest_square())) * select(1.0, -1.0, turn < -unsure));
    return vec3f(across.x, across.y, 0.0);
}

// Clips one edge.
//
//   a, b     unit directions of the edge's ends; z < 0 is below
//   returns  the state with start, end and, where the edge crosses and an arc is due, the arc
fn steradian_horizon_clip_edge(clip: SteradianHorizonClip, a: vec3f, b: vec3f) -> SteradianHorizonClip {
    var next = clip;
    let a_below = a.z < 0.0;
    let b_below = b.z < 0.0;
    next.start = a;
    next.end = b;
    next.closes = steradian_mask_none();
    if (a_below || b_below) {
        let nowhere = vec3f(0.0, 0.0, 0.0);
        let crossing = steradian_horizon_crossing(a, b);
        next.start = select(a, crossing, a_below);
        next.end = select(b, crossing, b_below);  // both below: start = end
        let comes_up = a_below && !b_below;
        let goes_down = b_below && !a_below;
        let was_left = dot(clip.leave, clip.leave) > 0.5;
        // Going down twice: a contour ended below and the next began above. The first one's last arc is due.
        let due = goes_down && was_left;
        next.closes = (comes_up && was_left) || due;
        next.arc_end = select(crossing, clip.entry, due);
        next.arc_start = select(next.arc_end, clip.leave, next.closes);
        next.leave = select(select(clip.leave, nowhere, comes_up), crossing, goes_down);
        next.entry = select(select(clip.entry, nowhere, due), crossing, comes_up && !was_left);
    }
    return next;
}

// Ends the walk: the last arc, from where the outline went down to where it had first come up.
fn steradian_horizon_clip_finish(clip: SteradianHorizonClip) -> SteradianHorizonClip {
    var next = clip;
    next.closes = dot(clip.leave, clip.leave) > 0.5 && dot(clip.entry, clip.entry) > 0.5;
    next.start = clip.end;
    next.arc_start = select(clip.entry, clip.leave, next.closes);
    next.arc_end = clip.entry;
    return next;
}

// ==== lambert ====

// The diffuse surface: the same radiance to every side.

// Radiance that a Lambert surface of albedo 1 sends out, per radiance of the light.
//
//   irradiance  steradian_polygon_irradiance, in [0, pi]
fn steradian_lambert_radiance(irradiance: f32) -> f32 {
    return irradiance * steradian_inverse_pi();
}

// The lobe itself: BRDF of albedo 1 times the cosine of the light's direction l (unit, shading frame).
fn steradian_lambert_lobe(l: vec3f) -> f32 {
    return max(l.z, 0.0) * steradian_inverse_pi();
}

// Schlick's (1 - v.h)^5 in one direction of the light. Unit vectors; 0 where l = v, 1 where l = -v.
fn steradian_lambert_grazing(l: vec3f, v: vec3f) -> f32 {
    let x = 1.0 - sqrt(clamp(0.5 + 0.5 * dot(l, v), 0.0, 1.0));
    let x2 = x * x;
    return x2 * x2 * x;
}

// The same averaged over an even sky, each direction by its cosine.
//
//   v_z      cosine of the view, in [0, 1]
//
// Error: 9.0e-6. The test LambertUnderFresnel.MeanOverTheSkyIsThatOfQuadrature finds the polynomial again.
fn steradian_lambert_grazing_of_sky(v_z: f32) -> f32 {
    let t = 1.0 - clamp(v_z, 0.0, 1.0);
    return 8.2571e-5 + t * (2.01647e-3 + t * (9.33829e-3 + t * (7.74731e-3 + t * 8.97984e-3)));
}

// The same averaged over a light, each direction by its cosine. Approximate: in the light's mean direction, blended with
// the sky's mean by the share of the sky that the light is.
//
//   e        irradiance vector of the light above the horizon; e.z its irradiance, in [0, pi]
//   v        unit view
//
// Exact for small lights and for the whole sky. Error: see docs/measured/accuracy.md, "Diffuse under Fresnel".
// Degenerate: no light gives a number in [0, 1].
fn steradian_lambert_grazing_of_light(e: vec3f, v: vec3f) -> f32 {
    let mean = e * inverseSqrt(max(dot(e, e), steradian_smallest_square()));
    let in_mean = steradian_lambert_grazing(mean, v);
    let share = clamp(e.z * steradian_inverse_pi(), 0.0, 1.0);
    return in_mean + (steradian_lambert_grazing_of_sky(v.z) - in_mean) * share;
}

// Irradiance that reaches a diffuse lobe below a dielectric's boundary, of what it would get at F = F0.
//
//   loss     (F90 - F0) / (1 - F0) of the boundary; 0: what the lobe gets does not depend on the light's direction
//   e, v     as for steradian_lambert_grazing_of_light
//
// Source: glTF 2.0, appendix B: diffuse light weighs 1 - F(v.h).
fn steradian_lambert_irradiance_below(e: vec3f, v: vec3f, loss: f32) -> f32 {
    return e.z * (1.0 - loss * steradian_lambert_grazing_of_light(e, v));
}
