// Textured lights: where on a light a lobe looks, and how widely.
//
// The mean of a texture over a light, weighted with the lobe, is read from blurred copies of the texture: around the
// point where the irradiance vector of the light under M^-1, brought back by M, meets the light's plane. The footprint is a
// cone of directions about that vector in the cosine's space, cut by the plane: an ellipse. Its radii are those of a thin
// cone, per radian; the caller multiplies them by the widths of docs/theory/ltc.md, "Textured lights":
//
//   LtcTextureFootprint f = ltc_texture_footprint(m, phi, normal, height);            // once
//   LtcTextureEllipse e = ltc_texture_axes(...f.axis_a..., ...f.axis_b...);       // in the plane's coordinates
//   LtcTextureEllipse g = ltc_texture_gaussian(e, width, widest);                 // for each Gaussian of the lobe's mixture
//   vec2 at = centroid + ltc_texture_place(g, hit - centroid, slope, light);   // where to read the copy blurred by g
//
// A diffuse surface passes the identity for M^-1 (ltc_texture_diffuse).
// Needs: constants.glsl frame.glsl polygon.glsl ltc.glsl
// Source of the idea: Heitz, Hill, "Real-time polygonal-light shading with linearly transformed cosines", 2016.
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.

// An ellipse on the light's plane, in the shading frame.
//   center   relative to the shading point
//   axis_a, axis_b  conjugate radii, per radian of the cone's half angle
//   valid    false where the light sends nothing
struct LtcTextureFootprint {
    vec3 center;
    vec3 axis_a;
    vec3 axis_b;
    mask valid;
};

// The vector M w, up to a positive factor: the inverse of ltc_transform.
vec3 ltc_texture_transform_back(LtcMatrix m, vec3 w) {
    real determinant = m.xx * m.zz - m.xz * m.zx;
    return vec3(m.zz * w.x - m.xz * w.z, w.y * (determinant / m.yy), m.xx * w.z - m.zx * w.x);
}

// The matrix of a diffuse lobe: none.
LtcMatrix ltc_texture_diffuse() {
    LtcMatrix m;
    m.xx = 1.0;
    m.xz = 0.0;
    m.yy = 1.0;
    m.zx = 0.0;
    m.zz = 1.0;
    return m;
}

// Irradiance vector, under M^-1, of the part of the light above both horizons.
//
//   reversed true where the light is seen from behind
vec3 ltc_texture_irradiance_vector(LtcWalk walk, mask reversed) {
    return polygon_irradiance_vector(walk.lobe, reversed);
}

// The footprint of a lobe on a light's plane.
//
//   m        M^-1
//   phi      irradiance vector of the light under M^-1 (ltc_texture_irradiance_vector)
//   normal   unit normal of the light's plane, in the shading frame, either sign
//   height   dot(normal, any point of the plane relative to the shading point)
//
// A direction w turned by a small angle e across itself meets the plane at M w t + e (M c - M w (n.Mc)/(n.Mw)) t.
//
// Degenerate: a light that sends nothing, or a vector along the plane, has a footprint of size 0 that is not valid.
// Error: docs/theory/ltc.md, "Textured lights".
LtcTextureFootprint ltc_texture_footprint(LtcMatrix m, vec3 phi, vec3 normal, real height) {
    real p2 = dot(phi, phi);
    mask lit = p2 > smallest_divisor();
    vec3 w = select(lit, phi * inversesqrt(max(p2, smallest_divisor())), vec3(0.0, 0.0, 1.0));
    mat3 across = frame_from_normal(w);
    vec3 l = ltc_texture_transform_back(m, w);
    real along = dot(normal, l);
    mask meets = lit && along * height > 0.0;
    real inverse = select(meets, 1.0 / select(meets, along, 1.0), 0.0);
    real t = height * inverse;
    vec3 a = ltc_texture_transform_back(m, transform(across, vec3(1.0, 0.0, 0.0)));
    vec3 b = ltc_texture_transform_back(m, transform(across, vec3(0.0, 1.0, 0.0)));
    LtcTextureFootprint f;
    f.center = l * t;
    f.axis_a = (a - l * (dot(normal, a) * inverse)) * t;
    f.axis_b = (b - l * (dot(normal, b) * inverse)) * t;
    f.valid = meets;
    return f;
}

// An ellipse on the light's plane: its long half axis, and the length of the short one.
struct LtcTextureEllipse {
    vec2 major;
    real minor;
};

// Principal axes of the ellipse of two conjugate radii.
//
//   a, b     in the plane's own coordinates [m]
//
// Degenerate: a circle has any major axis.
LtcTextureEllipse ltc_texture_axes(vec2 a, vec2 b) {
    real xx = a.x * a.x + b.x * b.x;
    real yy = a.y * a.y + b.y * b.y;
    real xy2 = a.x * a.y + b.x * b.y;
    real half_difference = 0.5 * (xx - yy);
    real spread = sqrt(half_difference * half_difference + xy2 * xy2);
    // An eigenvector of the larger eigenvalue, from the row that does not cancel.
    vec2 v = select(half_difference > 0.0, vec2(half_difference + spread, xy2), vec2(xy2, spread - half_difference));
    real v2 = dot(v, v);
    vec2 direction = select(v2 > smallest_square(), v * inversesqrt(max(v2, smallest_square())), vec2(1.0, 0.0));
    real longest = sqrt(0.5 * (xx + yy) + spread);
    LtcTextureEllipse e;
    e.major = direction * longest;
    e.minor = abs(a.x * b.y - a.y * b.x) / max(longest, smallest_length());
    return e;
}

// A Gaussian's standard deviations: the ellipse times a width, neither above `widest`.
LtcTextureEllipse ltc_texture_gaussian(LtcTextureEllipse e, real width, real widest) {
    real longest = width * sqrt(dot(e.major, e.major));
    LtcTextureEllipse g;
    g.major = e.major * (width * (widest / max(longest, widest)));
    g.minor = min(width * e.minor, widest);
    return g;
}

// The place at which a Gaussian must stand for the light under it to have the centroid that it has under the lobe.
//
// A wide Gaussian over a small light hardly knows where it stands, and its mean is the light's own. If the light were a
// Gaussian of covariance V, the centroid under a Gaussian of covariance S at distance x would be at V (V + S)^-1 x; this
// inverts that. The irradiance vector also lacks the lobe's cosine; it moves the centroid to the largest value of the
// product of (V^-1 + S^-1)^-1's Gaussian and the cosine, along the cosine's slope.
//
//   g        the Gaussian: its standard deviations
//   aside    where the irradiance vector meets the plane, from the light's centroid
//   slope    of the logarithm of z under M^-1 along the plane, there
//   light    covariance of the light's area: xx, xy, yy
//   returns  from the light's centroid
//
// It stands at most 2.5 of its standard deviations away from there: further out, next to nothing of the light is under it.
//
// Degenerate: a light without width counts as a thousandth as wide as long.
vec2 ltc_texture_place(LtcTextureEllipse g, vec2 aside, vec2 slope, vec3 light) {
    real major2 = dot(g.major, g.major);
    real minor2 = g.minor * g.minor;
    vec2 u = g.major * inversesqrt(max(major2, smallest_square()));
    real along = major2 - minor2;
    real sxx = minor2 + along * u.x * u.x;
    real sxy = along * u.x * u.y;
    real syy = minor2 + along * u.y * u.y;
    real least = 1.0e-6 * (light.x + light.z) + smallest_divisor();
    real vxx = light.x + least;
    real vyy = light.z + least;
    // (V^-1 + S^-1)^-1 slope = S (V + S)^-1 V slope
    real txx = vxx + sxx;
    real txy = light.y + sxy;
    real tyy = vyy + syy;
    real t_inverse = 1.0 / max(txx * tyy - txy * txy, smallest_square());
    vec2 p = vec2(vxx * slope.x + light.y * slope.y, light.y * slope.x + vyy * slope.y);
    p = vec2(tyy * p.x - txy * p.y, txx * p.y - txy * p.x) * t_inverse;
    p = vec2(sxx * p.x + sxy * p.y, sxy * p.x + syy * p.y);
    // The maximum of exp(-x^2 / 2) (1 + q^(1/2) x), over its first order.
    real q = max(dot(slope, p), 0.0);
    real share = 2.0 / (1.0 + sqrt(1.0 + 4.0 * q));
    vec2 d = aside + p * share;
    real v_inverse = 1.0 / max(vxx * vyy - light.y * light.y, smallest_square());
    vec2 e = vec2(vyy * d.x - light.y * d.y, vxx * d.y - light.y * d.x) * v_inverse;
    vec2 push = vec2(sxx * e.x + sxy * e.y, sxy * e.x + syy * e.y);
    real pushed2 = max(dot(push, e), 0.0);
    return d + push * (2.5 * inversesqrt(max(pushed2, 6.25)));
}
