// Steradian 0.1.0, indirect: one bounce from virtual lights, for GLSL ES 3.00 (WebGL2).
//
// Paste after #version 300 es and `precision highp float;`.
// It needs these files before it, in this order: math.es.glsl, polygon.es.glsl, lobe.es.glsl, ltc.es.glsl.
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

// ==== indirect ====

// One glossy bounce: virtual point lights and receivers whose lobes are linearly transformed cosines.
//
// A virtual light stands where light first meets a surface, and sends out what that surface reflects. v is its position
// minus the receiver's, in world space and of any length; D = v.v. A lobe at either end is a matrix that takes v to
// w: the lobe is proportional to max(w_z, 0) / |w|^4 for a unit v. What each end contributes is called its half:
//
//   half = lobe(v / |v|) / |v| = scale w_z D / |w|^4        diffuse: cosine / |v| = (n.v) / D
//
// and light that reaches the eye by a pair is flux times the product of both halves: no square root. See docs/indirect.md.
// Source: Xia, Liu, Zeng, Pu, Zhang, "Real-time indirect glossy reflection based on linearly transformed spherical
// distributions", 2023; Tokuyoshi, Harada, "Stochastic light culling", 2016.

// A lobe in world space: rows of M^-1 times the shading frame, and |M^-1| / pi.
//
// At a virtual light v comes in from the front's other side: there the rows are negated (steradian_indirect_turned).
struct SteradianIndirectLobe {
    vec3 x;
    vec3 y;
    vec3 z;
    float scale;
};

// The lobe of a table's matrix and the frame it belongs to (x along the view, z the normal). The matrix' factor cancels in a half.
SteradianIndirectLobe steradian_indirect_lobe(SteradianLtcMatrix m, mat3 frame) {
    SteradianIndirectLobe lobe;
    lobe.x = steradian_transform(frame, vec3(m.xx, 0.0, m.xz));
    lobe.y = steradian_transform(frame, vec3(0.0, m.yy, 0.0));
    lobe.z = steradian_transform(frame, vec3(m.zx, 0.0, m.zz));
    lobe.scale = m.yy * (m.xx * m.zz - m.xz * m.zx) * steradian_inverse_pi();
    return lobe;
}

// The lobe for vectors that point at the surface instead of away from it: what a virtual light needs.
SteradianIndirectLobe steradian_indirect_turned(SteradianIndirectLobe lobe) {
    SteradianIndirectLobe turned;
    turned.x = -lobe.x;
    turned.y = -lobe.y;
    turned.z = -lobe.z;
    turned.scale = lobe.scale;
    return turned;
}

// The vector v under the lobe's M^-1; v is any vector in world space.
vec3 steradian_indirect_under(SteradianIndirectLobe lobe, vec3 v) {
    return vec3(dot(lobe.x, v), dot(lobe.y, v), dot(lobe.z, v));
}

// The contribution of a glossy end to a pair, its half, for scale 1: w_z D / |w|^4. One division.
//
//   v        as the lobe's rows take it
//   d2       dot(v, v)
//   wide2    0, or an area over pi that softens the nearness of a virtual light: D becomes D + wide2 in 1 / D
//
// Degenerate: v = 0 gives 0. In float |v| and the lobe's width want |v|^6 width^4 in the range of numbers.
float steradian_indirect_glossy_half(SteradianIndirectLobe lobe, vec3 v, float d2, float wide2) {
    vec3 w = steradian_indirect_under(lobe, v);
    float w2 = dot(w, w);
    return max(w.z, 0.0) * d2 * d2 / max(w2 * w2 * (d2 + wide2), steradian_smallest_square());
}

// The contribution of a diffuse end of albedo pi to a pair, its half: cosine over distance.
float steradian_indirect_diffuse_half(vec3 n, vec3 v, float d2, float wide2) {
    return max(dot(n, v), 0.0) / max(d2 + wide2, steradian_smallest_square());
}

// Radiance towards the eye from a point light of intensity 1: the lobe over the squared distance.
//
//   v        light's position minus the surface's
//   lobe     of the surface and its view; times rho_f: with Fresnel
//
// Degenerate: v = 0 gives 0.
// Source: Xia et al. 2023, eq. 9; the sum over lights with lobe.scale taken out is eq. 11.
float steradian_indirect_point_light(SteradianIndirectLobe lobe, vec3 v) {
    float d2 = dot(v, v);
    return lobe.scale * steradian_indirect_glossy_half(lobe, v, d2, 0.0) * inversesqrt(max(d2, steradian_smallest_square()));
}

// The four halves of a pair. Light through a pair: flux (diffuse' from_diffuse + glossy' from_glossy) (diffuse
// to_diffuse + glossy to_glossy), with diffuse = albedo / pi and glossy = rho_f times the lobe's scale at each end.
struct SteradianIndirectPair {
    float from_diffuse;
    float from_glossy;
    float to_diffuse;
    float to_glossy;
};

// The halves of both ends at once, with no square root and one division.
//
//   receiver, n          the receiver's lobe and normal
//   light, light_n       the virtual light's, turned
//
// What lies below either horizon gives 0: a lobe leaks there.
// Degenerate: v = 0 gives 0. In float |v|^10 times both widths to the fourth must stay in the range of numbers; where it
// falls below 1.0e-36 the peak is cut.
SteradianIndirectPair steradian_indirect_pair(vec3 v, vec3 n, SteradianIndirectLobe receiver, vec3 light_n, SteradianIndirectLobe light) {
    float d2 = dot(v, v);
    vec3 w = steradian_indirect_under(receiver, v);
    vec3 o = steradian_indirect_under(light, v);
    float w2 = dot(w, w);
    float o2 = dot(o, o);
    float w4 = w2 * w2;
    float o4 = o2 * o2;
    float both = w4 * o4;
    float inverse = 1.0 / max(d2 * both, steradian_smallest_square());
    float peak = inverse * d2 * d2;
    float n_v = max(dot(n, v), 0.0);
    float light_n_v = max(dot(light_n, v), 0.0);
    SteradianIndirectPair pair;
    pair.to_diffuse = n_v * (inverse * both);
    pair.from_diffuse = light_n_v * (inverse * both);
    pair.to_glossy = steradian_select(n_v > 0.0, max(w.z, 0.0) * (peak * o4), 0.0);
    pair.from_glossy = steradian_select(light_n_v > 0.0, max(o.z, 0.0) * (peak * w4), 0.0);
    return pair;
}

// Schlick's weight (1 - v.h)^5 at a virtual light, whose half vector lies between where its light came from and v.
//
//   incoming unit, from the virtual light to the light that feeds it
//   v        to the virtual light
float steradian_indirect_grazing(vec3 incoming, vec3 v, float d2) {
    float cosine = -dot(incoming, v) * inversesqrt(max(d2, steradian_smallest_square()));
    float half_angle = max(0.5 + 0.5 * cosine, 1.0e-12);
    return steradian_fresnel_schlick(0.0, 1.0, half_angle * inversesqrt(half_angle));
}

// One end on GGX microsurfaces, without Fresnel, and Schlick's weight: the ground truth, and the baseline.
struct SteradianIndirectGgx {
    float lobe;
    float grazing;
};

// GGX for the unit direction l away from the surface: BRDF times the cosine of l.
//
//   frame    x along the view, z the normal
//   view     unit, in the frame
SteradianIndirectGgx steradian_indirect_ggx(mat3 frame, vec3 view, float alpha, vec3 l) {
    vec3 local = steradian_transform_transposed(frame, l);
    vec3 h = steradian_microfacet_half_vector(local, view);
    SteradianIndirectGgx end;
    end.lobe = steradian_microfacet_lobe_unshadowed(steradian_ggx_distribution(h, alpha, alpha) * steradian_ggx_shadowing(local, view, alpha, alpha), local, view);
    end.grazing = steradian_fresnel_schlick(0.0, 1.0, dot(h, view));
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
float steradian_indirect_kept(float value, float reach, float xi) {
    return steradian_select(value > xi * reach, max(value, reach), 0.0);
}

// The way from a receiver to a virtual light: the vector v, D, and 1 / |v|.
struct SteradianIndirectWay {
    vec3 v;
    float d2;
    float inverse;
};

// The way from the point p; a light at the point is 1.0e-10 away.
SteradianIndirectWay steradian_indirect_way(vec3 light, vec3 p) {
    SteradianIndirectWay way;
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
struct SteradianIndirectQuad {
    vec3 normal;
    vec3 edge_x;
    vec3 edge_y;
    float inverse_area;
    float size2;
};

// Lobes of a smaller alpha see virtual lights as quads.
float steradian_indirect_sharp() { return 0.1; }

// True where the quad is larger than a speck in the lobe's own space, |edge|^2 > 0.02 |w|^2: over a speck the lobe is nearly
// constant. Also false where the quad is seen edge-on, to a thousandth: steradian_indirect_quad_half divides by that sine, and is off by 1.0e-7 of
// the hemisphere.
//
//   kept, value  the light's half after culling and before
bool steradian_indirect_quad_matters(SteradianIndirectLobe lobe, SteradianIndirectQuad quad, SteradianIndirectWay way, float kept, float value) {
    vec3 w = steradian_indirect_under(lobe, way.v);
    float facing = dot(quad.normal, way.v);
    return kept > 0.0 && quad.size2 * kept > dot(w, w) * value * 0.02 && facing > 0.0 && facing * facing > way.d2 * 1.0e-6;
}

// A walk around the quad in the lobe's own space.
SteradianPolygonWalk steradian_indirect_quad_walk(SteradianIndirectLobe lobe, vec3 v, vec3 ex, vec3 ey) {
    vec3 a = steradian_polygon_direction(steradian_indirect_under(lobe, v + (-ex - ey)));
    vec3 b = steradian_polygon_direction(steradian_indirect_under(lobe, v + (ex - ey)));
    vec3 c = steradian_polygon_direction(steradian_indirect_under(lobe, v + (ex + ey)));
    vec3 d = steradian_polygon_direction(steradian_indirect_under(lobe, v + (ey - ex)));
    SteradianPolygonWalk walk = steradian_polygon_begin();
    walk = steradian_polygon_add_edge(walk, a, b);
    walk = steradian_polygon_add_edge(walk, b, c);
    walk = steradian_polygon_add_edge(walk, c, d);
    return steradian_polygon_add_edge(walk, d, a);
}

// The half of a glossy end, for scale 1, over the quad in place of its value at the middle.
//
//   rarity   by which the light stands for more: kept over value
float steradian_indirect_quad_half(SteradianIndirectLobe lobe, SteradianIndirectQuad quad, SteradianIndirectWay way, float wide2, float rarity) {
    float grow = sqrt(rarity);
    vec3 ex = quad.edge_x * grow;
    vec3 ey = quad.edge_y * grow;
    bool reversed = dot(cross(ex, ey), way.v) < 0.0;
    float integral = steradian_polygon_irradiance(steradian_indirect_quad_walk(lobe, way.v, ex, ey), reversed) * steradian_inverse_pi();
    float facing = max(dot(quad.normal, way.v), 1.0e-12);
    return integral * (way.d2 + wide2) * quad.inverse_area / (facing * lobe.scale * rarity);
}

// Conditions under which the filter takes two points for one surface.
//   least_cosine  between the normals
//   slope2        squared distance from the plane over squared distance
//   widths        lobes whose alphas differ by more than this fraction have different glossy light
struct SteradianIndirectLikeness {
    float least_cosine;
    float slope2;
    float widths;
};

// The usual conditions: 26 degrees and a twentieth.
SteradianIndirectLikeness steradian_indirect_alike() {
    SteradianIndirectLikeness like;
    like.least_cosine = 0.9;
    like.slope2 = 0.0025;
    like.widths = 0.2;
    return like;
}

// Loose conditions, for places that find so little that the pattern would be visible, at edges.
SteradianIndirectLikeness steradian_indirect_alike_loosely() {
    SteradianIndirectLikeness like;
    like.least_cosine = 0.3;
    like.slope2 = 0.49;
    like.widths = 0.5;
    return like;
}

// True if a point is on the same surface as another, to a hundredth of a millimetre.
//
//   n, m     unit normals
//   d        vector between the points [m]
bool steradian_indirect_same_surface(SteradianIndirectLikeness like, vec3 n, vec3 m, vec3 d) {
    float off = dot(n, d);
    return dot(n, m) > like.least_cosine && off * off < dot(d, d) * like.slope2 + 1.0e-10;
}

// Fraction of the filter's weights that is enough.
float steradian_indirect_enough() { return 0.6; }

// The filter's mean of a weighted sum; zero weights give zero.
vec3 steradian_indirect_over(vec3 sum, float weight) { return sum * (1.0 / max(weight, 1.0e-12)); }

// The same; where the weight is less than enough, others supply the rest.
vec3 steradian_indirect_filtered(vec3 sum, float weight, vec3 others, float others_weight) {
    float lack = max(steradian_indirect_enough() - weight, 0.0);
    return steradian_indirect_over(sum + steradian_indirect_over(others, others_weight) * lack, weight + lack);
}

// The largest factor by which M stretches a vector: one over the least by which M^-1 does.
float steradian_indirect_largest_stretch(SteradianLtcMatrix m) {
    // The 2 x 2 block's smaller singular value, from its trace and determinant; the larger divides, nothing cancels.
    float determinant = m.xx * m.zz - m.xz * m.zx;
    float square = m.xx * m.xx + m.xz * m.xz + m.zx * m.zx + m.zz * m.zz;
    float gap2 = max(square * square - 4.0 * determinant * determinant, 0.0);
    float larger2 = 0.5 * (square + gap2 * inversesqrt(max(gap2, steradian_smallest_square())));
    float least2 = determinant * determinant / max(larger2, steradian_smallest_square());
    return inversesqrt(max(min(least2, m.yy * m.yy), steradian_smallest_square()));
}

// The spheroid that holds the egg of range 1 (steradian_indirect_spheroid): the distance of its centre in front of the light, and its half axes
// along that direction and across. A ball of the last holds it too.
vec3 steradian_indirect_ball() { return vec3(0.46, 0.54, 0.628); }

// The region in which the irradiance of a virtual light can exceed a threshold: a ball of radius 1 about the origin of the result.
//
//   lobe     turned; a diffuse light's: its frame
//   v        virtual light's position minus the point's
//   range    square root of bright scale stretch / threshold, stretch of steradian_indirect_largest_stretch
//
// Irradiance is bright scale (w_z |v|) / |w|^4 <= bright scale stretch cos / |w|^2 with cos = w_z / |w|, so that the region lies
// inside |w|^2 <= range^2 cos: an egg, which the spheroid about 0.46 range on the axis, half axes 0.54 range along it
// and 0.628 range across, contains. Both numbers: tests Indirect.SpheroidHoldsTheEgg.
vec3 steradian_indirect_spheroid(SteradianIndirectLobe lobe, vec3 v, float range) {
    vec3 w = steradian_indirect_under(lobe, v);
    float inverse = 1.0 / range;
    vec3 ball = steradian_indirect_ball();
    return vec3(w.x * (inverse / ball.z), w.y * (inverse / ball.z), (w.z * inverse - ball.x) / ball.y);
}

// Bounds of receivers: a box of their places, and of their normals.
//   center, extent  the box' middle and half its sides
//   normal, turn    the same of the normals
struct SteradianIndirectBox {
    vec3 center;
    vec3 extent;
    vec3 normal;
    vec3 turn;
};

// Half the box' extent along a vector, times its length.
float steradian_indirect_box_reach(SteradianIndirectBox box, vec3 along) {
    return abs(along.x) * box.extent.x + abs(along.y) * box.extent.y + abs(along.z) * box.extent.z;
}

// Squared distance of a point from the box.
float steradian_indirect_box_distance2(SteradianIndirectBox box, vec3 p) {
    vec3 d = vec3(max(abs(box.center.x - p.x) - box.extent.x, 0.0), max(abs(box.center.y - p.y) - box.extent.y, 0.0),
                  max(abs(box.center.z - p.z) - box.extent.z, 0.0));
    return dot(d, d);
}

// The largest product of a coordinate of a normal and of a way, each within its bounds.
float steradian_indirect_most(float normal, float turn, float way, float extent) {
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
bool steradian_indirect_egg_reaches(SteradianIndirectBox box, vec3 at, vec3 n, float range, float offset) {
    float height = dot(n, box.center) + abs(n.x) * box.extent.x + abs(n.y) * box.extent.y + abs(n.z) * box.extent.z - offset;
    vec3 v = at - box.center;
    float above = steradian_indirect_most(box.normal.x, box.turn.x, v.x, box.extent.x) + steradian_indirect_most(box.normal.y, box.turn.y, v.y, box.extent.y)
        + steradian_indirect_most(box.normal.z, box.turn.z, v.z, box.extent.z);
    bool reaches = height > 0.0 && above > 0.0;
    if (reaches) {  // neighbours in the light's grid mostly agree
        vec3 ball = steradian_indirect_ball();
        float range2 = range * range;
        float d2 = steradian_indirect_box_distance2(box, at);
        float reach = range2 * height;
        float ball2 = steradian_indirect_box_distance2(box, at + n * (range * ball.x));
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
bool steradian_indirect_spheroid_reaches(SteradianIndirectBox box, vec3 x, vec3 y, vec3 z, vec3 g, vec3 n, float offset) {
    vec3 ball = steradian_indirect_ball();
    float qz = g.z - dot(z, box.center);
    float wz = ball.y * qz + ball.x;
    float deep = ball.y * steradian_indirect_box_reach(box, z);
    float highest = wz + deep + 1.0e-6 * (abs(g.z) + 1.0);  // plus the rounding of a difference in float
    bool reaches = highest > 0.0 && dot(n, box.center) + steradian_indirect_box_reach(box, n) > offset;
    if (reaches) {
        vec3 q = vec3(g.x - dot(x, box.center), g.y - dot(y, box.center), qz);
        float q2 = dot(q, q);
        float gap = q2 - steradian_indirect_box_reach(box, x * q.x + y * q.y + z * q.z);  // T transposed times q
        vec3 least = vec3(ball.z * max(abs(q.x) - steradian_indirect_box_reach(box, x), 0.0), ball.z * max(abs(q.y) - steradian_indirect_box_reach(box, y), 0.0),
                          max(abs(wz) - deep, 0.0));
        float w2 = dot(least, least);
        reaches = reaches && !(gap > 0.0 && gap * gap > q2) && w2 * w2 * w2 <= highest * highest;
    }
    return reaches;
}
