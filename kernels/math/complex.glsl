// Complex numbers: vec2(real part, imaginary part).
// Needs: constants.glsl
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.

// The product a b.
vec2 complex_product(vec2 a, vec2 b) {
    return vec2(a.x * b.x - a.y * b.y, a.x * b.y + a.y * b.x);
}

// The quotient a / b. Degenerate: |b|^2 below 1.0e-36 counts as 1.0e-36.
vec2 complex_quotient(vec2 a, vec2 b) {
    real scale = 1.0 / max(dot(b, b), smallest_square());
    return vec2(a.x * b.x + a.y * b.y, a.y * b.x - a.x * b.y) * scale;
}

// The unit number in the direction of a: a / |a|. Degenerate: zero stays zero.
vec2 complex_sign(vec2 a) {
    return a * inversesqrt(max(dot(a, a), smallest_square()));
}

// The unit number of angle x, exp(i x), for x in [-pi, pi].
//
// Taylor series of the cosine and the sine of x / 2, then the square. Error: the first terms left out, (pi/2)^14/14! =
// 6.4e-9 for 24 bits and (pi/2)^22/22! = 1.8e-17 for 53.
vec2 complex_unit(real x) {
    real y = 0.5 * x;
    real t = y * y;
    real c = 1.0;
    real s = 1.0;
    if (real_digits() > 24) {
        c = 1.0 - t * 0.00326797385620915033 * (1.0 - t * 0.00263157894736842105);
        c = 1.0 - t * 0.00549450549450549451 * (1.0 - t * 0.00416666666666666667 * c);
        s = 1.0 - t * 0.00292397660818713450 * (1.0 - t * 0.00238095238095238095);
        s = 1.0 - t * 0.00476190476190476190 * (1.0 - t * 0.00367647058823529412 * s);
        s = 1.0 - t * 0.00641025641025641026 * s;
    }
    c = 1.0 - t * 0.0111111111111111111 * (1.0 - t * 0.00757575757575757576 * c);
    c = 1.0 - t * 0.0333333333333333333 * (1.0 - t * 0.0178571428571428571 * c);
    c = 1.0 - t * 0.5 * (1.0 - t * 0.0833333333333333333 * c);
    s = 1.0 - t * 0.0138888888888888889 * (1.0 - t * 0.00909090909090909091 * s);
    s = 1.0 - t * 0.05 * (1.0 - t * 0.0238095238095238095 * s);
    s = y * (1.0 - t * 0.166666666666666667 * s);
    return vec2(c * c - s * s, 2.0 * c * s);
}
