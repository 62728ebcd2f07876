// Charlie's sheen under an area light: cubature over the light's outline, fanned about its mean direction.
//
// The lobe is smooth, with a hole where others have a peak; no transformed cosine is like it, but a few nodes are.
// Two walks along the outline, clipped to the horizon (horizon_clip.glsl): the first sums e = polygon_edge(start, end),
// the second the nodes.
//   CharlieCubature c = charlie_cubature_begin(charlie_prepare(v, alpha), e, facing);
//   for each edge: c = charlie_cubature_edge(c, start, end);
//   real radiance = charlie_cubature_finish(c);
// Needs: constants.glsl gauss_legendre.glsl charlie.glsl
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.

// The state of the second walk.
//   centre   where the light is on average: what its outline is fanned about
//   facing   1.0; -1.0 where the outline is walked the wrong way round
//   sum      over the nodes so far
//   at_centre  the centre's weight, which all edges share
struct CharlieCubature {
    CharlieLobe lobe;
    vec3 centre;
    real facing;
    real sum;
    real at_centre;
};

// Starts the second walk.
//
//   e        sum of the edge vectors of the first walk, in the order in which the edges were walked
//   facing   1.0; -1.0 where the light is seen from behind, so that the walk ran the wrong way round
CharlieCubature charlie_cubature_begin(CharlieLobe lobe, vec3 e, real facing) {
    vec3 inward = e * facing;
    real length2 = dot(inward, inward);
    CharlieCubature c;
    c.lobe = lobe;
    c.centre = select(length2 > smallest_square(), inward * inversesqrt(max(length2, smallest_square())), vec3(0.0, 0.0, 1.0));
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
CharlieCubature charlie_cubature_arc(CharlieCubature c, vec3 a, vec3 b) {
    CharlieCubature next = c;
    real cosine = dot(a, b);
    real n = 2.0 + select(cosine < 0.968912421710644784, 1.0, 0.0) + select(cosine < 0.696706709347165421, 1.0, 0.0);
    real fan = dot(c.centre, cross(a, b)) * c.facing;
    for (int j = 0; j < 4; j++) {
        mask present = n > real(j) + 0.5 && abs(fan) > 0.0;
        if (any_lane(present)) {
            vec2 rule = select(n > 3.5, gauss_legendre_node(4, j), select(n > 2.5, gauss_legendre_node(3, j), gauss_legendre_node(2, j)));
            vec3 u = a + (b - a) * rule.x;
            real inverse2 = 1.0 / max(dot(u, u), smallest_divisor());
            vec3 rim = u * sqrt(inverse2);
            real rim_cosine = dot(rim, c.centre);
            vec3 aside = rim - c.centre * rim_cosine;
            vec3 outward = aside * inversesqrt(max(dot(aside, aside), smallest_divisor()));
            real weight = select(present, fan * inverse2 * rule.y / (1.0 + max(rim_cosine, -0.9)), 0.0);
            next.at_centre = next.at_centre + 0.0625 * weight;
            real radial = 0.328844319980059696 * charlie_lobe(c.lobe, fan_place(c.centre, outward, rim_cosine, 0.212340538239152943));
            radial = radial + 0.388193468843171893 * charlie_lobe(c.lobe, fan_place(c.centre, outward, rim_cosine, 0.590533135559265283));
            radial = radial + 0.220462211176768373 * charlie_lobe(c.lobe, fan_place(c.centre, outward, rim_cosine, 0.911412040487296148));
            next.sum = next.sum + weight * radial;
        }
    }
    return next;
}

// Adds the nodes of one edge, or of an arc of the horizon; one longer than a quarter of a circle in two halves.
CharlieCubature charlie_cubature_edge(CharlieCubature c, vec3 a, vec3 b) {
    mask wide = dot(a, b) < 0.0;
    vec3 middle = a + b;
    middle = select(wide, middle * inversesqrt(max(dot(middle, middle), smallest_divisor())), b);
    CharlieCubature next = charlie_cubature_arc(c, a, middle);
    if (any_lane(wide)) {
        next = charlie_cubature_arc(next, middle, b);
    }
    return next;
}

// Radiance of colour 1 for radiance 1, at least 0.
//
// Error: see docs/measured/accuracy.md, "Sheen".
real charlie_cubature_finish(CharlieCubature c) {
    return max(c.sum + c.at_centre * charlie_lobe(c.lobe, c.centre), 0.0);
}
