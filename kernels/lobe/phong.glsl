// Lobes that are a power of a cosine: Phong about the mirrored view, Blinn-Phong about the normal.
// Needs: constants.glsl
// Topics: phong, blinn_phong
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.

// The logarithm of x for x in (0, 1], with small relative error up to 1: near 1 a GPU's own log promises 5e-7 of absolute error, and a
// high exponent multiplies it.
//
// Error: relative 1e-7 in float for x above 0.75, 3e-16 in double; below as the built-in log.
real phong_log(real x) {
    real near = 0.75;
    if (real_digits() > 24) {
        near = 0.999;
    }
    real result = log(x);
    mask high = x > near;
    if (any_lane(high)) {
        // d - d^2 / (2 + d) is twice t, the first term of twice the inverse hyperbolic tangent of t: so d, which is exact, carries
        // most of the digits. The next term is 2 t^9 / 9, relative 2e-8 at t = 1/7.
        real d = x - 1.0;
        real t = d / (2.0 + d);
        real t2 = t * t;
        real series = d - t * (d - t2 * (0.666666666666666667 + t2 * (0.4 + t2 * 0.285714285714285714)));
        result = select(high, series, result);
    }
    return result;
}

// The power x^n, for x in [0, 1] and n >= 0, as exp(n log x).
//
// Degenerate: x <= 1.0e-30 counts as 1.0e-30 (0 for any n of use; n = 0 gives 1).
// Error: relative, n |log x| roundings of the logarithm: where the power is not small, a few units of 1.0e-7 in float.
real phong_power(real x, real n) {
    return exp(n * phong_log(max(x, smallest_divisor())));
}

// The view mirrored at the surface.
//
//   v        view direction, shading frame
vec3 phong_mirror(vec3 v) {
    return vec3(-v.x, -v.y, v.z);
}

// The Phong lobe: (n + 1) / (2 pi) max(l.r, 0)^n. Its integral over the sphere is 1; it has no foreshortening.
//
//   l        unit direction of the light, r unit axis of the lobe
//   n        exponent, at least 0
//
// Source: Lecocq, Dufay, Sourimant, Marvie, "Analytic approximations for real-time area light shading", 2017, eq. 10.
real phong_lobe(vec3 l, vec3 r, real n) {
    return (n + 1.0) * inverse_two_pi() * phong_power(dot(l, r), n);
}

// Distribution of half vectors of Blinn-Phong: (n + 2) / (2 pi) h_z^n, normalised over projected solid angle.
//
//   h        unit half vector, shading frame
real blinn_phong_distribution(vec3 h, real n) {
    return (n + 2.0) * inverse_two_pi() * phong_power(h.z, n);
}
