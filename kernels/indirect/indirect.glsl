// One glossy bounce: virtual point lights and receivers whose lobes are linearly transformed cosines.
//
// A virtual light stands where light first meets a surface, and sends out what that surface reflects. v is its position
// minus the receiver's, in world space and of any length; D = v.v. A lobe at either end is a matrix that takes v to
// w: the lobe is proportional to max(w_z, 0) / |w|^4 for a unit v. What each end contributes is called its half:
//
//   half = lobe(v / |v|) / |v| = scale w_z D / |w|^4        diffuse: cosine / |v| = (n.v) / D
//
// and light that reaches the eye by a pair is flux times the product of both halves: no square root. See docs/indirect.md.
// Needs: constants.glsl polygon.glsl ltc.glsl microfacet.glsl
// Source: Xia, Liu, Zeng, Pu, Zhang, "Real-time indirect glossy reflection based on linearly transformed spherical
// distributions", 2023; Tokuyoshi, Harada, "Stochastic light culling", 2016.
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.

// A lobe in world space: rows of M^-1 times the shading frame, and |M^-1| / pi.
//
// At a virtual light v comes in from the front's other side: there the rows are negated (indirect_turned).
struct IndirectLobe {
    vec3 x;
    vec3 y;
    vec3 z;
    real scale;
};

// The lobe of a table's matrix and the frame it belongs to (x along the view, z the normal). The matrix' factor cancels in a half.
IndirectLobe indirect_lobe(LtcMatrix m, mat3 frame) {
    IndirectLobe lobe;
    lobe.x = transform(frame, vec3(m.xx, 0.0, m.xz));
    lobe.y = transform(frame, vec3(0.0, m.yy, 0.0));
    lobe.z = transform(frame, vec3(m.zx, 0.0, m.zz));
    lobe.scale = m.yy * (m.xx * m.zz - m.xz * m.zx) * inverse_pi();
    return lobe;
}

// The lobe for vectors that point at the surface instead of away from it: what a virtual light needs.
IndirectLobe indirect_turned(IndirectLobe lobe) {
    IndirectLobe turned;
    turned.x = -lobe.x;
    turned.y = -lobe.y;
    turned.z = -lobe.z;
    turned.scale = lobe.scale;
    return turned;
}

// The vector v under the lobe's M^-1; v is any vector in world space.
vec3 indirect_under(IndirectLobe lobe, vec3 v) {
    return vec3(dot(lobe.x, v), dot(lobe.y, v), dot(lobe.z, v));
}

// The contribution of a glossy end to a pair, its half, for scale 1: w_z D / |w|^4. One division.
//
//   v        as the lobe's rows take it
//   d2       dot(v, v)
//   wide2    0, or an area over pi that softens the nearness of a virtual light: D becomes D + wide2 in 1 / D
//
// Degenerate: v = 0 gives 0. In float |v| and the lobe's width want |v|^6 width^4 in the range of numbers.
real indirect_glossy_half(IndirectLobe lobe, vec3 v, real d2, real wide2) {
    vec3 w = indirect_under(lobe, v);
    real w2 = dot(w, w);
    return max(w.z, 0.0) * d2 * d2 / max(w2 * w2 * (d2 + wide2), smallest_square());
}

// The contribution of a diffuse end of albedo pi to a pair, its half: cosine over distance.
real indirect_diffuse_half(vec3 n, vec3 v, real d2, real wide2) {
    return max(dot(n, v), 0.0) / max(d2 + wide2, smallest_square());
}

// Radiance towards the eye from a point light of intensity 1: the lobe over the squared distance.
//
//   v        light's position minus the surface's
//   lobe     of the surface and its view; times rho_f: with Fresnel
//
// Degenerate: v = 0 gives 0.
// Source: Xia et al. 2023, eq. 9; the sum over lights with lobe.scale taken out is eq. 11.
real indirect_point_light(IndirectLobe lobe, vec3 v) {
    real d2 = dot(v, v);
    return lobe.scale * indirect_glossy_half(lobe, v, d2, 0.0) * inversesqrt(max(d2, smallest_square()));
}

// The four halves of a pair. Light through a pair: flux (diffuse' from_diffuse + glossy' from_glossy) (diffuse
// to_diffuse + glossy to_glossy), with diffuse = albedo / pi and glossy = rho_f times the lobe's scale at each end.
struct IndirectPair {
    real from_diffuse;
    real from_glossy;
    real to_diffuse;
    real to_glossy;
};

// The halves of both ends at once, with no square root and one division.
//
//   receiver, n          the receiver's lobe and normal
//   light, light_n       the virtual light's, turned
//
// What lies below either horizon gives 0: a lobe leaks there.
// Degenerate: v = 0 gives 0. In float |v|^10 times both widths to the fourth must stay in the range of numbers; where it
// falls below 1.0e-36 the peak is cut.
IndirectPair indirect_pair(vec3 v, vec3 n, IndirectLobe receiver, vec3 light_n, IndirectLobe light) {
    real d2 = dot(v, v);
    vec3 w = indirect_under(receiver, v);
    vec3 o = indirect_under(light, v);
    real w2 = dot(w, w);
    real o2 = dot(o, o);
    real w4 = w2 * w2;
    real o4 = o2 * o2;
    real both = w4 * o4;
    real inverse = 1.0 / max(d2 * both, smallest_square());
    real peak = inverse * d2 * d2;
    real n_v = max(dot(n, v), 0.0);
    real light_n_v = max(dot(light_n, v), 0.0);
    IndirectPair pair;
    pair.to_diffuse = n_v * (inverse * both);
    pair.from_diffuse = light_n_v * (inverse * both);
    pair.to_glossy = select(n_v > 0.0, max(w.z, 0.0) * (peak * o4), 0.0);
    pair.from_glossy = select(light_n_v > 0.0, max(o.z, 0.0) * (peak * w4), 0.0);
    return pair;
}

// Schlick's weight (1 - v.h)^5 at a virtual light, whose half vector lies between where its light came from and v.
//
//   incoming unit, from the virtual light to the light that feeds it
//   v        to the virtual light
real indirect_grazing(vec3 incoming, vec3 v, real d2) {
    real cosine = -dot(incoming, v) * inversesqrt(max(d2, smallest_square()));
    real half_angle = max(0.5 + 0.5 * cosine, 1.0e-12);
    return fresnel_schlick(0.0, 1.0, half_angle * inversesqrt(half_angle));
}

// One end on GGX microsurfaces, without Fresnel, and Schlick's weight: the ground truth, and the baseline.
struct IndirectGgx {
    real lobe;
    real grazing;
};

// GGX for the unit direction l away from the surface: BRDF times the cosine of l.
//
//   frame    x along the view, z the normal
//   view     unit, in the frame
IndirectGgx indirect_ggx(mat3 frame, vec3 view, real alpha, vec3 l) {
    vec3 local = transform_transposed(frame, l);
    vec3 h = microfacet_half_vector(local, view);
    IndirectGgx end;
    end.lobe = microfacet_lobe_unshadowed(ggx_distribution(h, alpha, alpha) * ggx_shadowing(local, view, alpha, alpha), local, view);
    end.grazing = fresnel_schlick(0.0, 1.0, dot(h, view));
    return end;
}

// The half that stochastic culling leaves of a virtual light's half: on average what comes in.
//
//   value      the half; its irradiance at the receiver is bright times value over distance
//   reach      threshold over bright, times distance: the half whose irradiance is the threshold
//   xi         of the virtual light, in (0, 1)
//
// A pair is kept where value > xi reach, with probability min(1, value / reach), and then weighs its inverse.
// Source: Tokuyoshi, Harada 2016.
real indirect_kept(real value, real reach, real xi) {
    return select(value > xi * reach, max(value, reach), 0.0);
}

// The way from a receiver to a virtual light: the vector v, D, and 1 / |v|.
struct IndirectWay {
    vec3 v;
    real d2;
    real inverse;
};

// The way from the point p; a light at the point is 1.0e-10 away.
IndirectWay indirect_way(vec3 light, vec3 p) {
    IndirectWay way;
    way.v = light - p;
    way.d2 = max(dot(way.v, way.v), 1.0e-20);
    way.inverse = inversesqrt(way.d2);
    return way;
}

// A virtual light as a quad, for lobes so sharp that its middle does not stand for it.
//   normal          unit, on the side away from the receiver
//   edge_x, edge_y  half its sides
//   inverse_area    one over its area
//   size2           squared length of its longer edge
struct IndirectQuad {
    vec3 normal;
    vec3 edge_x;
    vec3 edge_y;
    real inverse_area;
    real size2;
};

// Lobes of a smaller alpha see virtual lights as quads.
real indirect_sharp() { return 0.1; }

// True where the quad is larger than a speck in the lobe's own space, |edge|^2 > 0.02 |w|^2: over a speck the lobe is nearly
// constant. Also false where the quad is seen edge-on, to a thousandth: indirect_quad_half divides by that sine, and is off by 1.0e-7 of
// the hemisphere.
//
//   kept, value  the light's half after culling and before
mask indirect_quad_matters(IndirectLobe lobe, IndirectQuad quad, IndirectWay way, real kept, real value) {
    vec3 w = indirect_under(lobe, way.v);
    real facing = dot(quad.normal, way.v);
    return kept > 0.0 && quad.size2 * kept > dot(w, w) * value * 0.02 && facing > 0.0 && facing * facing > way.d2 * 1.0e-6;
}

// A walk around the quad in the lobe's own space.
PolygonWalk indirect_quad_walk(IndirectLobe lobe, vec3 v, vec3 ex, vec3 ey) {
    vec3 a = polygon_direction(indirect_under(lobe, v + (-ex - ey)));
    vec3 b = polygon_direction(indirect_under(lobe, v + (ex - ey)));
    vec3 c = polygon_direction(indirect_under(lobe, v + (ex + ey)));
    vec3 d = polygon_direction(indirect_under(lobe, v + (ey - ex)));
    PolygonWalk walk = polygon_begin();
    walk = polygon_add_edge(walk, a, b);
    walk = polygon_add_edge(walk, b, c);
    walk = polygon_add_edge(walk, c, d);
    return polygon_add_edge(walk, d, a);
}

// The half of a glossy end, for scale 1, over the quad in place of its value at the middle.
//
//   rarity   by which the light stands for more: kept over value
real indirect_quad_half(IndirectLobe lobe, IndirectQuad quad, IndirectWay way, real wide2, real rarity) {
    real grow = sqrt(rarity);
    vec3 ex = quad.edge_x * grow;
    vec3 ey = quad.edge_y * grow;
    mask reversed = dot(cross(ex, ey), way.v) < 0.0;
    real integral = polygon_irradiance(indirect_quad_walk(lobe, way.v, ex, ey), reversed) * inverse_pi();
    real facing = max(dot(quad.normal, way.v), 1.0e-12);
    return integral * (way.d2 + wide2) * quad.inverse_area / (facing * lobe.scale * rarity);
}

// Conditions under which the filter takes two points for one surface.
//   least_cosine  between the normals
//   slope2        squared distance from the plane over squared distance
//   widths        lobes whose alphas differ by more than this fraction have different glossy light
struct IndirectLikeness {
    real least_cosine;
    real slope2;
    real widths;
};

// The usual conditions: 26 degrees and a twentieth.
IndirectLikeness indirect_alike() {
    IndirectLikeness like;
    like.least_cosine = 0.9;
    like.slope2 = 0.0025;
    like.widths = 0.2;
    return like;
}

// Loose conditions, for places that find so little that the pattern would be visible, at edges.
IndirectLikeness indirect_alike_loosely() {
    IndirectLikeness like;
    like.least_cosine = 0.3;
    like.slope2 = 0.49;
    like.widths = 0.5;
    return like;
}

// True if a point is on the same surface as another, to a hundredth of a millimetre.
//
//   n, m     unit normals
//   d        vector between the points [m]
mask indirect_same_surface(IndirectLikeness like, vec3 n, vec3 m, vec3 d) {
    real off = dot(n, d);
    return dot(n, m) > like.least_cosine && off * off < dot(d, d) * like.slope2 + 1.0e-10;
}

// Fraction of the filter's weights that is enough.
real indirect_enough() { return 0.6; }

// The filter's mean of a weighted sum; zero weights give zero.
vec3 indirect_over(vec3 sum, real weight) { return sum * (1.0 / max(weight, 1.0e-12)); }

// The same; where the weight is less than enough, others supply the rest.
vec3 indirect_filtered(vec3 sum, real weight, vec3 others, real others_weight) {
    real lack = max(indirect_enough() - weight, 0.0);
    return indirect_over(sum + indirect_over(others, others_weight) * lack, weight + lack);
}

// The largest factor by which M stretches a vector: one over the least by which M^-1 does.
real indirect_largest_stretch(LtcMatrix m) {
    // The 2 x 2 block's smaller singular value, from its trace and determinant; the larger divides, nothing cancels.
    real determinant = m.xx * m.zz - m.xz * m.zx;
    real square = m.xx * m.xx + m.xz * m.xz + m.zx * m.zx + m.zz * m.zz;
    real gap2 = max(square * square - 4.0 * determinant * determinant, 0.0);
    real larger2 = 0.5 * (square + gap2 * inversesqrt(max(gap2, smallest_square())));
    real least2 = determinant * determinant / max(larger2, smallest_square());
    return inversesqrt(max(min(least2, m.yy * m.yy), smallest_square()));
}

// The spheroid that holds the egg of range 1 (indirect_spheroid): the distance of its centre in front of the light, and its half axes
// along that direction and across. A ball of the last holds it too.
vec3 indirect_ball() { return vec3(0.46, 0.54, 0.628); }

// The region in which the irradiance of a virtual light can exceed a threshold: a ball of radius 1 about the origin of the result.
//
//   lobe     turned; a diffuse light's: its frame
//   v        virtual light's position minus the point's
//   range    square root of bright scale stretch / threshold, stretch of indirect_largest_stretch
//
// Irradiance is bright scale (w_z |v|) / |w|^4 <= bright scale stretch cos / |w|^2 with cos = w_z / |w|, so that the region lies
// inside |w|^2 <= range^2 cos: an egg, which the spheroid about 0.46 range on the axis, half axes 0.54 range along it
// and 0.628 range across, contains. Both numbers: tests Indirect.SpheroidHoldsTheEgg.
vec3 indirect_spheroid(IndirectLobe lobe, vec3 v, real range) {
    vec3 w = indirect_under(lobe, v);
    real inverse = 1.0 / range;
    vec3 ball = indirect_ball();
    return vec3(w.x * (inverse / ball.z), w.y * (inverse / ball.z), (w.z * inverse - ball.x) / ball.y);
}

// Bounds of receivers: a box of their places, and of their normals.
//   center, extent  the box' middle and half its sides
//   normal, turn    the same of the normals
struct IndirectBox {
    vec3 center;
    vec3 extent;
    vec3 normal;
    vec3 turn;
};

// Half the box' extent along a vector, times its length.
real indirect_box_reach(IndirectBox box, vec3 along) {
    return abs(along.x) * box.extent.x + abs(along.y) * box.extent.y + abs(along.z) * box.extent.z;
}

// Squared distance of a point from the box.
real indirect_box_distance2(IndirectBox box, vec3 p) {
    vec3 d = vec3(max(abs(box.center.x - p.x) - box.extent.x, 0.0), max(abs(box.center.y - p.y) - box.extent.y, 0.0),
                  max(abs(box.center.z - p.z) - box.extent.z, 0.0));
    return dot(d, d);
}

// The largest product of a coordinate of a normal and of a way, each within its bounds.
real indirect_most(real normal, real turn, real way, real extent) {
    return normal * way + abs(normal) * extent + turn * (abs(way) + extent);
}

// True if the egg of a diffuse virtual light may reach the box.
//
//   at, n    place and normal
//   range    square root of bright / threshold
//   offset   dot(n, p) of the light's plane
//
// Two bounds: d^3 <= range^2 h, with the least distance d and the greatest height h above the light's plane, culls boxes in the plane
// itself; the ball that holds the egg is for large boxes. No light comes from below the horizons of all receivers: n.v is largest where
// each of its three products is.
mask indirect_egg_reaches(IndirectBox box, vec3 at, vec3 n, real range, real offset) {
    real height = dot(n, box.center) + abs(n.x) * box.extent.x + abs(n.y) * box.extent.y + abs(n.z) * box.extent.z - offset;
    vec3 v = at - box.center;
    real above = indirect_most(box.normal.x, box.turn.x, v.x, box.extent.x) + indirect_most(box.normal.y, box.turn.y, v.y, box.extent.y)
        + indirect_most(box.normal.z, box.turn.z, v.z, box.extent.z);
    mask reaches = height > 0.0 && above > 0.0;
    if (any_lane(reaches)) {  // neighbours in the light's grid mostly agree
        vec3 ball = indirect_ball();
        real range2 = range * range;
        real d2 = indirect_box_distance2(box, at);
        real reach = range2 * height;
        real ball2 = indirect_box_distance2(box, at + n * (range * ball.x));
        reaches = reaches && d2 * d2 * d2 <= reach * reach && ball2 <= range2 * (ball.z * ball.z);
    }
    return reaches;
}

// True if the spheroid of a glossy virtual light may reach the box.
//
//   x, y, z  rows of T
//   g        the unit ball is that of q = g - T p
//   n        the light's normal
//   offset   dot(n, p) of the light's plane
//
// The ball is tested against the box under T, a parallelepiped. They are apart if the plane that touches the ball below the box' centre
// separates them. They are also apart if the box' bounds along the lobe's axes miss the egg in the ball: |w|^3 <= w_z, w in units of the
// range. A sharp and bright lobe's ball is so large that it contains everything near its light. The egg begins at the light, and extends
// one way.
mask indirect_spheroid_reaches(IndirectBox box, vec3 x, vec3 y, vec3 z, vec3 g, vec3 n, real offset) {
    vec3 ball = indirect_ball();
    real qz = g.z - dot(z, box.center);
    real wz = ball.y * qz + ball.x;
    real deep = ball.y * indirect_box_reach(box, z);
    real highest = wz + deep + 1.0e-6 * (abs(g.z) + 1.0);  // plus the rounding of a difference in float
    mask reaches = highest > 0.0 && dot(n, box.center) + indirect_box_reach(box, n) > offset;
    if (any_lane(reaches)) {
        vec3 q = vec3(g.x - dot(x, box.center), g.y - dot(y, box.center), qz);
        real q2 = dot(q, q);
        real gap = q2 - indirect_box_reach(box, x * q.x + y * q.y + z * q.z);  // T transposed times q
        vec3 least = vec3(ball.z * max(abs(q.x) - indirect_box_reach(box, x), 0.0), ball.z * max(abs(q.y) - indirect_box_reach(box, y), 0.0),
                          max(abs(wz) - deep, 0.0));
        real w2 = dot(least, least);
        reaches = reaches && !(gap > 0.0 && gap * gap > q2) && w2 * w2 * w2 <= highest * highest;
    }
    return reaches;
}
