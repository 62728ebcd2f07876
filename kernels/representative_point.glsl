// The representative point of a polygon light, for comparison: all of its light from the direction that is nearest to
// the mirror direction, on a lobe widened to make up for it.
// Needs: inverse_trig.glsl polygon.glsl microfacet.glsl
// Topics: representative
// Source: Karis, "Real shading in Unreal Engine 4", 2013, section "Area lights", its sphere taken to a polygon.
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.

// The state of a walk.
//   turn     how far the outline has turned about the mirror direction [rad]: two pi or zero at the end
//   nearest  direction on the outline nearest to it
//   cosine   between the two
struct RepresentativeWalk {
    real turn;
    vec3 nearest;
    real cosine;
};

// A walk with no edge yet.
RepresentativeWalk representative_begin() {
    RepresentativeWalk walk;
    walk.turn = 0.0;
    walk.nearest = vec3(0.0, 0.0, 1.0);
    walk.cosine = -2.0;
    return walk;
}

// Adds one edge.
//
//   mirror   unit: the view mirrored at the normal
//   a, b     unit directions of the edge's ends
RepresentativeWalk representative_add_edge(RepresentativeWalk walk, vec3 mirror, vec3 a, vec3 b) {
    RepresentativeWalk next = walk;
    real ca = dot(mirror, a);
    real cb = dot(mirror, b);
    next.turn = walk.turn + trig_atan2(dot(mirror, cross(a, b)), dot(a, b) - ca * cb);
    // The nearest of the great circle, if it lies between the ends.
    vec3 n = cross(a, b);
    real n2 = max(dot(n, n), 1.0e-30);
    vec3 p = mirror - n * (dot(mirror, n) / n2);
    vec3 on_circle = p * inversesqrt(max(dot(p, p), 1.0e-30));
    mask between = dot(cross(a, p), n) > 0.0 && dot(cross(p, b), n) > 0.0;
    vec3 nearest = select(between, on_circle, select(ca > cb, a, b));
    real cosine = dot(mirror, nearest);
    mask better = cosine > walk.cosine;
    next.nearest = select(better, nearest, walk.nearest);
    next.cosine = select(better, cosine, walk.cosine);
    return next;
}

// Radiance towards the view, per radiance of the light, without Fresnel.
//
//   view, mirror  unit, in the shading frame
//   solid_angle   of the light [sr]
//   alpha         of the GGX lobe
//
// Degenerate: 0 where the representative direction is below the horizon.
real representative_radiance(RepresentativeWalk walk, vec3 view, vec3 mirror, real solid_angle, real alpha) {
    mask inside = abs(walk.turn) > pi();
    vec3 l = select(inside, mirror, walk.nearest);
    // The radius of the disk of that solid angle widens the lobe; the lobe's peak falls by the square.
    real wider = clamp(alpha + sqrt(solid_angle * 0.318309886183790672) / 3.0, 0.0, 1.0);
    real fall = alpha / max(wider, 1.0e-4);
    return ggx_lobe(l, view, alpha, alpha) * fall * fall * solid_angle;
}

// The half vector's cosine for Fresnel. Arguments as above.
real representative_v_dot_h(RepresentativeWalk walk, vec3 view, vec3 mirror) {
    mask inside = abs(walk.turn) > pi();
    vec3 h = microfacet_half_vector(select(inside, mirror, walk.nearest), view);
    return dot(view, h);
}
