// Quartic polynomials that are positive on the real axis: two conjugate pairs of roots.
// Needs: constants.glsl
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.

// The roots of a real quartic without real roots: one of each conjugate pair, the one with positive imaginary part.
struct QuarticPoles {
    vec2 z1;
    vec2 z2;
};

// Largest root of 4 c^3 - 3 c = x: the cosine of a third of the angle whose cosine is x, in [1/2, 1].
//
//   x        in [-1, 1]
//
// The start in t = sqrt((1 + x)/2), the cosine of half the angle, has the right value at both ends and the right slope
// at x = -1, where the root has infinite slope in x; then two steps of Newton.
// Error: 1e-7 at worst before rounding; test Quartic.CosineOfTheThirdOfAnAngle.
real quartic_third_cosine(real x) {
    real t = sqrt(max(0.5 + 0.5 * x, 0.0));
    real c = 0.5 + t * (0.577350269189625765 - 0.0773502691896257645 * t);
    for (int i = 0; i < 2; i++) {
        real c2 = c * c;
        c = c - (c * (4.0 * c2 - 3.0) - x) / max(12.0 * c2 - 3.0, 1.0e-6);
    }
    return c;
}

// Roots of t^4 + c3 t^3 + c2 t^2 + c1 t + c0, good enough to start an iteration from.
//
//   c0..c3   the roots should be of the order of 1: scale the variable so that c0 = 1
//   returns  imaginary parts at least 1.0e-3: below, the square is the noise of 24 bits
//
// Ferrari: with y = t + c3/4 the quartic is (y^2 + s y + a)(y^2 - s y + b). s^2, the squared distance of the pairs along
// the real axis, is the only root of the resolvent that is not negative; all three are real, so that it is a
// cosine. Where s is small, b - a comes from a + b and a b instead of from a quotient of noise.
// Error: a start; float loses half the digits where pairs are nearly equal.
// Source: Ferrari in Cardano, "Ars magna", 1545; the three real roots: Viete.
QuarticPoles quartic_poles_approximate(real c0, real c1, real c2, real c3) {
    real shift = 0.25 * c3;
    real shift2 = shift * shift;
    real p = c2 - 6.0 * shift2;
    real q = c1 - 2.0 * c2 * shift + 8.0 * shift2 * shift;
    real r = c0 - c1 * shift + c2 * shift2 - 3.0 * shift2 * shift2;

    // Largest root of the resolvent z^3 + 2 p z^2 + (p^2 - 4 r) z - q^2.
    real radius2 = max(p * p + 12.0 * r, 1.0e-12);
    real radius = sqrt(radius2);
    real cosine = clamp((p * (p * p - 36.0 * r) + 13.5 * q * q) / (radius2 * radius), -1.0, 1.0);
    real z = max(0.666666666666666667 * (radius * quartic_third_cosine(cosine) - p), 0.0);
    real s = sqrt(z);

    real sum = p + z;
    real root = sqrt(max(sum * sum - 4.0 * r, 0.0));
    real difference = select(z > 1.0e-3 * abs(p), q / max(s, smallest_length()), select(q < 0.0, -root, root));
    QuarticPoles poles;
    poles.z1 = vec2(-0.5 * s - shift, sqrt(max(0.5 * (sum - difference) - 0.25 * z, 1.0e-6)));
    poles.z2 = vec2(0.5 * s - shift, sqrt(max(0.5 * (sum + difference) - 0.25 * z, 1.0e-6)));
    return poles;
}
