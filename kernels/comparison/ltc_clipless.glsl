// Linearly transformed cosines without clipping, for comparison: the light is taken for the sphere that has the same
// irradiance vector under M^-1, and the horizon cuts that. The real horizon is not looked at: light leaks from below.
// Needs: constants.glsl inverse_trig.glsl polygon.glsl ltc.glsl
// Topics: ltc
// Source: Hill, Heitz, "Real-time area lighting: a journey from research to production", 2016.
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.

// Form factor of a sphere above the horizon over that of the whole sphere towards its centre.
//
//   cosine   of the sphere's centre to z, in [-1, 1]
//   f        form factor of the whole sphere towards its centre: sine squared of its angular radius, in [0, 1]
//
// Degenerate: f = 0 gives max(cosine, 0).
// Source: Snyder, "Area light sources for real-time graphics", 1996, section 3.2.
real ltc_clipped_sphere(real cosine, real f) {
    real z = clamp(cosine, -1.0, 1.0);
    real s2 = clamp(f, 1.0e-12, 1.0);
    real sin_w = sqrt(max(1.0 - z * z, smallest_divisor()));
    real cos_s = sqrt(1.0 - s2);
    mask crossed = z * z < s2;
    // The rim meets the horizon at the azimuth whose sine and cosine are x and y.
    real x = clamp(cos_s / sin_w, 0.0, 1.0);
    real y = sqrt(max(1.0 - x * x, 0.0));
    real root = sqrt(max(s2 - y * y, 0.0));
    real arc = trig_atan2(y, x) + x * y - 2.0 * sin_w * cos_s * y;
    real rim = abs(z) * (y * root + s2 * trig_atan2(y, root));
    real whole = pi() * s2 * max(z, 0.0);
    real cut = select(crossed, whole + arc - rim, whole);
    return clamp(cut / (pi() * s2), 0.0, 1.0);
}

// Adds one edge to the irradiance vector under M^-1 [rad].
//
//   ta, tb   ltc_direction of the edge's ends, in walk order
vec3 ltc_clipless_add_edge(vec3 sum, vec3 ta, vec3 tb) {
    return sum + polygon_edge(ta, tb);
}

// Integral of the lobe over the light, approximately, in [0, 1].
//
//   sum      of ltc_clipless_add_edge, begun at zero
//   reversed true where the light is seen from behind
real ltc_clipless_integral(vec3 sum, mask reversed) {
    vec3 e = sum * select(reversed, -1.0, 1.0);
    real e2 = dot(e, e);
    real inverse = inversesqrt(max(e2, smallest_square()));
    real form_factor = clamp(e2 * inverse * inverse_pi(), 0.0, 1.0);
    return form_factor * ltc_clipped_sphere(clamp(e.z * inverse, -1.0, 1.0), form_factor);
}
