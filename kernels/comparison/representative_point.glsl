// The representative point of a polygon light, for comparison: all of its light from the direction that is nearest to
// the mirror direction, on a lobe widened to make up for it.
//
// Assumes that the light is small against the lobe, or the lobe against the light; between the two it is off by a third and more.
//   1. The light is a point light of the light's solid angle, in the direction nearest to the mirror's.
//   2. The lobe's peak falls by (alpha/alpha')^2, alpha' = alpha + radius/(2 distance). A sphere of that radius and distance
//      has the solid angle W = pi (radius/distance)^2; of half vectors it covers W/(4 v.h), a disk of radius sqrt(W/(4 pi v.h)),
//      which at the normal is radius/(2 distance). The factor 1/sqrt(v.h) is not in the source: without it a mirror that
//      sees the light sends 1/v.h times the light's radiance, 14 times at 86 degrees.
// Walk the outline clipped to the horizon (horizon_clip.glsl).
// Needs: constants.glsl inverse_trig.glsl polygon.glsl microfacet.glsl
// Topics: representative
// Source: Karis, "Real shading in Unreal Engine 4", 2013, section "Area lights", its sphere taken to a polygon. The half
// radius: its alpha' with the factor 2 at which a mirror (alpha = 0) sends the radiance of the light it sees.
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.

// The state of a walk.
//   turn     how far the outline has turned about the mirror direction [rad]: two pi at the end where that is inside,
//            minus two pi where its opposite is, else zero; the other sign where the light is seen from behind
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
    walk.cosine = -2.0;  // below any cosine, so that the first edge counts
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
    real n2 = max(dot(n, n), smallest_divisor());
    vec3 p = mirror - n * (dot(mirror, n) / n2);
    vec3 on_circle = p * inversesqrt(max(dot(p, p), smallest_divisor()));
    mask between = dot(cross(a, p), n) > 0.0 && dot(cross(p, b), n) > 0.0;
    vec3 nearest = select(between, on_circle, select(ca > cb, a, b));
    real cosine = dot(mirror, nearest);
    mask better = cosine > walk.cosine;
    next.nearest = select(better, nearest, walk.nearest);
    next.cosine = select(better, cosine, walk.cosine);
    return next;
}

// The direction that stands for the light: the mirror direction if the light holds it, else the nearest of the outline.
vec3 representative_direction(RepresentativeWalk walk, vec3 mirror, mask reversed) {
    real turn = select(reversed, -walk.turn, walk.turn);
    return select(turn > pi(), mirror, walk.nearest);
}

// Radiance towards the view, per radiance of the light, without Fresnel.
//
//   view, mirror  unit, in the shading frame
//   solid_angle   of the light's part above the horizon [sr]
//   alpha         of the GGX lobe
//   reversed      true where the light is seen from behind
//
// Degenerate: 0 where the representative direction is below the horizon. For a mirror inside the light: at most 1, and
// towards alpha = 0 it is 1.
// Error: see docs/measured/accuracy.md, "GGX with shadowing and Fresnel".
real representative_radiance(RepresentativeWalk walk, vec3 view, vec3 mirror, real solid_angle, real alpha, mask reversed) {
    vec3 l = representative_direction(walk, mirror, reversed);
    vec3 h = microfacet_half_vector(l, view);
    real wider = alpha + sqrt(solid_angle * 0.0795774715459476679 / max(dot(view, h), 1.0e-6));
    real fall = alpha / wider;
    return ggx_lobe(l, view, alpha, alpha) * (fall * fall) * solid_angle;
}

// The half vector's cosine for Fresnel. Arguments as for representative_radiance.
real representative_v_dot_h(RepresentativeWalk walk, vec3 view, vec3 mirror, mask reversed) {
    vec3 h = microfacet_half_vector(representative_direction(walk, mirror, reversed), view);
    return dot(view, h);
}
