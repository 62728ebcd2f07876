// Irradiance and solid angle of polygonal lights: the boundary integrals of Lambert and Girard.
//
// A light is walked edge by edge, so that any number of vertices, non-convex outlines and holes (walked the other
// way round) cost no array. Frame: origin at the shading point, z the surface normal. Walk order: seen from the
// point, det(v_i, v_i+1, inside) > 0, the reverse of a stored polygon that is counter-clockwise from its lit side.
// Needs: constants.glsl inverse_trig.glsl
// Topics: polygon, solid_angle, edge
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.

// The state of a walk.
//   edges    sum over the edges, each clipped to the horizon, of half its angle times its plane's unit normal [rad]
//   horizon  product of unit complex numbers: its angle is the arc of the horizon that closes the clipped outline
struct PolygonWalk {
    vec3 edges;
    vec2 horizon;
};

// Unit direction of a vertex.
//
//   v        vertex relative to the shading point, any unit of length
//
// Degenerate: a length below 1e-18 (the point lies on the vertex) gives a vector shorter than 1; one above 1e18, whose
// square leaves the range of float, the zero vector. Both are finite and add next to nothing to any sum.
vec3 polygon_direction(vec3 v) {
    real d2 = dot(v, v);
    real scale = select(d2 < 1.0e36, inversesqrt(max(d2, smallest_square())), 0.0);
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
vec3 polygon_edge(vec3 a, vec3 b) {
    vec3 n = cross(a, b - a);
    real f = trig_angle_over_sine(dot(a, b), dot(n, n));
    return n * (0.5 * f);
}

// A walk before its first edge: no edges, and a horizon of angle 0.
PolygonWalk polygon_begin() {
    PolygonWalk walk;
    walk.edges = vec3(0.0, 0.0, 0.0);
    walk.horizon = vec2(1.0, 0.0);
    return walk;
}

// The part of an edge above the horizon, by its ends: start = a start_a + b start_b, end = a end_a + b end_b.
//   start, end   unit directions; equal where nothing is above
//   rises, sinks whether the part begins, or ends, on the horizon
struct EdgePart {
    vec3 start;
    vec3 end;
    real start_a;
    real start_b;
    real end_a;
    real end_b;
    mask rises;
    mask sinks;
};

// An edge as a part of itself.
EdgePart edge_whole(vec3 a, vec3 b) {
    EdgePart part;
    part.start = a;
    part.end = b;
    part.start_a = 1.0;
    part.start_b = 0.0;
    part.end_a = 0.0;
    part.end_b = 1.0;
    part.rises = mask_none();
    part.sinks = mask_none();
    return part;
}

// Clips an edge to the horizon z = 0.
//
//   a, b     unit directions of the edge's ends (polygon_direction), in walk order
//
// Degenerate: an edge below the horizon has equal ends.
EdgePart edge_above_horizon(vec3 a, vec3 b) {
    mask a_below = a.z < 0.0;
    mask b_below = b.z < 0.0;
    EdgePart part = edge_whole(a, b);
    part.rises = a_below && !b_below;
    part.sinks = b_below && !a_below;
    if (any_lane(a_below || b_below)) {
        // The edge's crossing of the horizon: weights of one sign, so nothing cancels.
        real wa = abs(b.z);
        real wb = abs(a.z);
        vec2 p = vec2(a.x * wa + b.x * wb, a.y * wa + b.y * wb);
        real scale = inversesqrt(max(dot(p, p), smallest_square()));
        vec3 crossing = vec3(p.x * scale, p.y * scale, 0.0);
        part.start = select(a_below, crossing, a);
        part.end = select(b_below, crossing, b);  // both below: start = end, an edge of no length
        part.start_a = select(a_below, wa * scale, 1.0);
        part.start_b = select(a_below, wb * scale, 0.0);
        part.end_a = select(b_below, wa * scale, 0.0);
        part.end_b = select(b_below, wb * scale, 1.0);
    }
    return part;
}

// Adds the part of an edge above the horizon (edge_above_horizon).
//
// What lies below is replaced by an arc of the horizon from where the outline leaves to where it comes back. All
// these arcs of a plane light lie within one half circle and run the same way, so that only the sum of their angles
// counts: each crossing multiplies its azimuth into a complex number, in whatever order the crossings come.
PolygonWalk polygon_add_part(PolygonWalk walk, EdgePart part) {
    PolygonWalk next = walk;
    mask crosses = part.rises || part.sinks;
    if (any_lane(crosses)) {
        vec3 crossing = select(part.rises, part.start, part.end);
        real y = select(part.rises, crossing.y, -crossing.y);  // coming up: the azimuth; going down: its conjugate
        vec2 h = walk.horizon;
        next.horizon = select(crosses, vec2(h.x * crossing.x - h.y * y, h.x * y + h.y * crossing.x), h);
    }
    next.edges = walk.edges + polygon_edge(part.start, part.end);
    return next;
}

// Adds one edge, clipped to the horizon z = 0.
//
//   a, b     unit directions of the edge's ends (polygon_direction), in walk order
PolygonWalk polygon_add_edge(PolygonWalk walk, vec3 a, vec3 b) {
    PolygonWalk next = walk;
    if (any_lane(!(a.z < 0.0) || !(b.z < 0.0))) {
        next = polygon_add_part(walk, edge_above_horizon(a, b));
    }
    return next;
}

// Irradiance vector of the part of the light above the horizon [sr times radiance 1].
//
//   reversed true where the light is seen from behind, so that the walk ran the wrong way round
//   returns  in the shading frame; z is the irradiance, the direction is where the light is, seen on average
//
// Degenerate: a point in the light's plane gives 0 up to rounding.
vec3 polygon_irradiance_vector(PolygonWalk walk, mask reversed) {
    real facing = select(reversed, -1.0, 1.0);
    real arc = 0.0;
    if (any_lane(abs(walk.horizon.y) > 0.0 || walk.horizon.x < 0.0)) {
        arc = trig_atan2_unwrapped(facing * walk.horizon.y, walk.horizon.x);
    }
    vec3 e = walk.edges * facing;
    return vec3(e.x, e.y, clamp(e.z + 0.5 * arc, 0.0, pi()));
}

// Irradiance of radiance 1 from the part of the light above the horizon, in [0, pi]. See polygon_irradiance_vector.
//
// Error: see docs/measured/accuracy.md, "polygon irradiance".
real polygon_irradiance(PolygonWalk walk, mask reversed) {
    vec3 e = polygon_irradiance_vector(walk, reversed);
    return e.z;
}

// The state of a solid angle's walk: a product of complex numbers, each with half a triangle's solid angle.
struct SolidAngleWalk {
    vec3 first;
    vec2 product;
};

// A solid angle's walk before its first triangle.
//
//   first    unit direction of any vertex of the light
SolidAngleWalk solid_angle_begin(vec3 first) {
    SolidAngleWalk walk;
    walk.first = first;
    walk.product = vec2(1.0, 0.0);
    return walk;
}

// Adds the triangle of the first vertex and one edge. Directions as for polygon_add_edge; no horizon here.
//
// Degenerate: a triangle without area has a real factor and adds nothing.
// Source: Van Oosterom, Strackee, "The solid angle of a plane triangle", 1983, eq. 8.
SolidAngleWalk solid_angle_add_edge(SolidAngleWalk walk, vec3 a, vec3 b) {
    SolidAngleWalk next = walk;
    real re = 1.0 + dot(walk.first, a) + dot(a, b) + dot(b, walk.first);
    real im = dot(walk.first, cross(a - walk.first, b - a));  // the determinant, from differences: it is small where they are
    real scale = inversesqrt(max(re * re + im * im, smallest_square()));
    re = re * scale;
    im = im * scale;
    vec2 p = walk.product;
    next.product = vec2(p.x * re - p.y * im, p.x * im + p.y * re);
    return next;
}

// Solid angle of a plane light, in [0, 2 pi] [sr].
//
//   reversed true where the light is seen from behind, so that the walk ran the wrong way round
//
// Error: see docs/measured/accuracy.md, "polygon solid angle".
real solid_angle_finish(SolidAngleWalk walk, mask reversed) {
    real y = select(reversed, -walk.product.y, walk.product.y);
    return max(2.0 * trig_atan2_unwrapped(y, walk.product.x), 0.0);
}
