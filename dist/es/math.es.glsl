// Steradian 0.1.0, math: arithmetic that all topics share, for GLSL ES 3.00 (WebGL2).
//
// Paste after #version 300 es and `precision highp float;`.
// It needs no other file.
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

float steradian_select(bool m, float a, float b) { return m ? a : b; }
vec2 steradian_select(bool m, vec2 a, vec2 b) { return m ? a : b; }
vec3 steradian_select(bool m, vec3 a, vec3 b) { return m ? a : b; }
vec4 steradian_select(bool m, vec4 a, vec4 b) { return m ? a : b; }

vec2 steradian_xy(vec3 v) { return v.xy; }

// Matrix of three columns times vector, and its transpose times vector.
vec3 steradian_transform(mat3 m, vec3 v) { return m[0] * v.x + m[1] * v.y + m[2] * v.z; }
vec3 steradian_transform_transposed(mat3 m, vec3 v) { return vec3(dot(m[0], v), dot(m[1], v), dot(m[2], v)); }

// ==== constants ====

// The constants that all kernels share. A constant is a function: the same in every language.

// The circle's constant.
float steradian_pi() { return 3.14159265358979324; }

// 1 / pi.
float steradian_inverse_pi() { return 0.318309886183790672; }

// 1 / (2 pi).
float steradian_inverse_two_pi() { return 0.159154943091895336; }

// False in every lane.
bool steradian_mask_none() {
    float zero = 0.0;
    return zero > 0.0;
}

// True in every lane.
bool steradian_mask_all() { return !steradian_mask_none(); }

// Squared lengths are kept above this before a division or an inverse root: the smallest normal float is 1.2e-38, and below it
// GPUs and packs count every number as 0.
float steradian_smallest_square() { return 1.0e-36; }

// Lengths are kept above this before a division: the root of steradian_smallest_square.
float steradian_smallest_length() { return 1.0e-18; }

// Divisors of numbers of the order of 1 are kept above this, so that the quotient may still be multiplied by 1.0e8 within float.
// What is smaller is rounding: a cross product of two unit vectors of float has a square of about 1.0e-14 where they are equal.
float steradian_smallest_divisor() { return 1.0e-30; }

// ==== complex ====

// Complex numbers: vec2(real part, imaginary part).

// The product a b.
vec2 steradian_complex_product(vec2 a, vec2 b) {
    return vec2(a.x * b.x - a.y * b.y, a.x * b.y + a.y * b.x);
}

// The quotient a / b. Degenerate: |b|^2 below 1.0e-36 counts as 1.0e-36.
vec2 steradian_complex_quotient(vec2 a, vec2 b) {
    float scale = 1.0 / max(dot(b, b), steradian_smallest_square());
    return vec2(a.x * b.x + a.y * b.y, a.y * b.x - a.x * b.y) * scale;
}

// The unit number in the direction of a: a / |a|. Degenerate: zero stays zero.
vec2 steradian_complex_sign(vec2 a) {
    return a * inversesqrt(max(dot(a, a), steradian_smallest_square()));
}

// The unit number of angle x, exp(i x), for x in [-pi, pi].
//
// Taylor series of the cosine and the sine of x / 2, then the square. Error: the first terms left out, (pi/2)^14/14! =
// 6.4e-9 for 24 bits and (pi/2)^22/22! = 1.8e-17 for 53.
vec2 steradian_complex_unit(float x) {
    float y = 0.5 * x;
    float t = y * y;
    float c = 1.0;
    float s = 1.0;
    c = 1.0 - t * 0.0111111111111111111 * (1.0 - t * 0.00757575757575757576 * c);
    c = 1.0 - t * 0.0333333333333333333 * (1.0 - t * 0.0178571428571428571 * c);
    c = 1.0 - t * 0.5 * (1.0 - t * 0.0833333333333333333 * c);
    s = 1.0 - t * 0.0138888888888888889 * (1.0 - t * 0.00909090909090909091 * s);
    s = 1.0 - t * 0.05 * (1.0 - t * 0.0238095238095238095 * s);
    s = y * (1.0 - t * 0.166666666666666667 * s);
    return vec2(c * c - s * s, 2.0 * c * s);
}

// ==== frame ====

// Shading frames. A frame is a mat3 whose columns are x, y and z; steradian_transform_transposed(frame, w) takes a world
// vector into it, transform(frame, l) back.

// Orthonormal right-handed frame with z along n and x, y in any direction.
//
//   n        unit normal
//
// Source: Duff, Burgess, Christensen, Hery, Kensler, Liani, Villemin, "Building an orthonormal basis, revisited", 2017.
mat3 steradian_frame_from_normal(vec3 n) {
    float s = steradian_select(n.z < 0.0, -1.0, 1.0);
    float a = -1.0 / (s + n.z);
    float b = n.x * n.y * a;
    vec3 x = vec3(1.0 + s * n.x * n.x * a, s * b, -s * n.x);
    vec3 y = vec3(b, s + n.y * n.y * a, -n.y);
    return mat3(x, y, n);
}

// Orthonormal right-handed frame with z along n and the view in the half plane of x and z.
//
//   n, v     unit normal and view
//
// Degenerate: a view along the normal (closer than 1e-6) gives any x.
mat3 steradian_frame_from_normal_and_view(vec3 n, vec3 v) {
    mat3 other = steradian_frame_from_normal(n);
    vec3 t = v - n * dot(n, v);
    float t2 = dot(t, t);
    vec3 x = steradian_select(t2 > 1.0e-12, t * inversesqrt(max(t2, 1.0e-12)), steradian_transform(other, vec3(1.0, 0.0, 0.0)));
    return mat3(x, cross(n, x), n);
}

// ==== gauss_legendre ====

// Nodes and weights of Gauss and Legendre on [0, 1]: zeros of Legendre's polynomials.
//
// The test GaussLegendre.IntegratesPolynomialsOfItsDegreesExactly proves every number.

// Node j of the rule with n nodes, j from 0, n in 1 to 6 or 8: vec2(node, weight). Weights add up to 1.
//
// Degenerate: a rule or node that there is not gives (1/2, 0).
vec2 steradian_gauss_legendre_node(int n, int j) {
    vec2 r = vec2(0.5, 0.0);
    if (n == 1) {
        if (j == 0) { r = vec2(0.5, 1.0); }
    }
    if (n == 2) {
        if (j == 0) { r = vec2(0.211324865405187118, 0.5); }
        if (j == 1) { r = vec2(0.788675134594812882, 0.5); }
    }
    if (n == 3) {
        if (j == 0) { r = vec2(0.112701665379258311, 0.277777777777777778); }
        if (j == 1) { r = vec2(0.5, 0.444444444444444444); }
        if (j == 2) { r = vec2(0.887298334620741689, 0.277777777777777778); }
    }
    if (n == 4) {
        if (j == 0) { r = vec2(0.069431844202973712, 0.173927422568726929); }
        if (j == 1) { r = vec2(0.330009478207571868, 0.326072577431273071); }
        if (j == 2) { r = vec2(0.669990521792428132, 0.326072577431273071); }
        if (j == 3) { r = vec2(0.930568155797026288, 0.173927422568726929); }
    }
    if (n == 5) {
        if (j == 0) { r = vec2(0.046910077030668004, 0.118463442528094544); }
        if (j == 1) { r = vec2(0.230765344947158454, 0.239314335249683234); }
        if (j == 2) { r = vec2(0.5, 0.284444444444444444); }
        if (j == 3) { r = vec2(0.769234655052841546, 0.239314335249683234); }
        if (j == 4) { r = vec2(0.953089922969331996, 0.118463442528094544); }
    }
    if (n == 6) {
        if (j == 0) { r = vec2(0.033765242898423986, 0.085662246189585173); }
        if (j == 1) { r = vec2(0.169395306766867743, 0.180380786524069304); }
        if (j == 2) { r = vec2(0.380690406958401546, 0.233956967286345524); }
        if (j == 3) { r = vec2(0.619309593041598454, 0.233956967286345524); }
        if (j == 4) { r = vec2(0.830604693233132257, 0.180380786524069304); }
        if (j == 5) { r = vec2(0.966234757101576014, 0.085662246189585173); }
    }
    if (n == 8) {
        if (j == 0) { r = vec2(0.019855071751231884, 0.05061426814518813); }
        if (j == 1) { r = vec2(0.10166676129318663, 0.111190517226687235); }
        if (j == 2) { r = vec2(0.237233795041835507, 0.156853322938943644); }
        if (j == 3) { r = vec2(0.408282678752175098, 0.181341891689180991); }
        if (j == 4) { r = vec2(0.591717321247824902, 0.181341891689180991); }
        if (j == 5) { r = vec2(0.762766204958164493, 0.156853322938943644); }
        if (j == 6) { r = vec2(0.89833323870681337, 0.111190517226687235); }
        if (j == 7) { r = vec2(0.980144928248768116, 0.05061426814518813); }
    }
    return r;
}

// A direction of a fan of the sphere about a centre, on the way from there to the rim: where a radial rule in the cosine has its node.
//
//   outward     unit, perpendicular to the centre
//   rim_cosine  of the rim's distance from the centre
//   share       of 1 - cosine, in [0, 1]
vec3 steradian_fan_place(vec3 centre, vec3 outward, float rim_cosine, float share) {
    float cosine = 1.0 - (1.0 - rim_cosine) * share;
    return centre * cosine + outward * sqrt(max(1.0 - cosine * cosine, 0.0));
}

// ==== inverse_trig ====

// Inverse trigonometry for the kernels, the same in every language.
//
// The built-in acos and atan of shader compilers differ by up to 8e-5; these polynomials do not. Each exists for 24
// bits (float, GPU) and for 53 (double); real_digits() is a compile-time constant and picks one.
// Coefficients: tools/fit_inverse_trig finds them; the test InverseTrig.PolynomialsAreTheFittedOnes compares.

// Degree 9, largest relative error 1.3e-08 before rounding; and its derivative, by the same steps.
vec2 steradian_trig_angle_over_sine_24_bits(float t) {
    float p = 0.01116282422619877;
    float d = p;
    p = p * t - 0.032591688733997218;
    d = d * t + p;
    p = p * t + 0.05097575847577638;
    d = d * t + p;
    p = p * t - 0.033552997791327491;
    d = d * t + p;
    p = p * t + 0.030059175970996568;
    d = d * t + p;
    p = p * t + 0.020163489805166888;
    d = d * t + p;
    p = p * t + 0.057977801513775039;
    d = d * t + p;
    p = p * t + 0.13326657225500885;
    d = d * t + p;
    p = p * t + 0.33333538143391106;
    d = d * t + p;
    p = p * t + 0.9999999897346874;
    return vec2(p, d);
}

// Degree 8, largest relative error 1.8e-08 before rounding.
float steradian_trig_atan_over_argument_24_bits(float q) {
    float p = 0.002766283501762026;
    p = p * q - 0.015731249122183651;
    p = p * q + 0.042137623589193041;
    p = p * q - 0.07456854826004547;
    p = p * q + 0.10618370636953849;
    p = p * q - 0.14197797794085124;
    p = p * q + 0.19991872029109073;
    p = p * q - 0.33333036709286273;
    p = p * q + 0.99999998178865568;
    return p;
}

// Angle over sine of an angle in [0, pi/2], from its cosine: acos(c) / sqrt(1 - c*c), and its derivative by t.
//
//   t        1 - c, in [0, 1]
//   returns  vec2(1, 1/3) at t = 0 to vec2(pi/2, 1) at t = 1
//
// Error: see docs/measured/accuracy.md, "angle over sine" and "slope of angle over sine". A series in 1 - c has positive terms: nothing
// cancels.
vec2 steradian_trig_angle_over_sine_acute_and_slope(float t) {
    return steradian_trig_angle_over_sine_24_bits(t);
}

// Angle over sine alone. Arguments: steradian_trig_angle_over_sine_acute_and_slope.
float steradian_trig_angle_over_sine_acute(float t) {
    vec2 both = steradian_trig_angle_over_sine_acute_and_slope(t);
    return both.x;
}

// Angle over sine of an angle in [0, pi], from its cosine and the square of its sine.
//
//   c        cosine, in [-1, 1]; the polynomial goes on smoothly where rounding exceeds it
//   s2       sine squared, computed on its own (a squared cross product), not as 1 - c*c, which cancels near pi
//
// Degenerate: towards pi the value grows like pi/sine; it stops at s2 = 1.0e-30, where products with the sine are 0.
float steradian_trig_angle_over_sine(float c, float s2) {
    float f = steradian_trig_angle_over_sine_acute(1.0 - abs(c));
    bool obtuse = c < 0.0;
    if (obtuse) {
        f = steradian_select(obtuse, steradian_pi() * inversesqrt(max(s2, steradian_smallest_divisor())) - f, f);
    }
    return f;
}

// Angle over sine, and minus its derivative by the cosine: 1/3 at c = 1, 1 at c = 0; (1 - c f) / s2 in between and beyond. Arguments:
// steradian_trig_angle_over_sine, whose value is x.
//
// Degenerate: the slope grows like pi / s2^1.5 towards pi and stops at s2 = 1.0e-12.
// Error: see docs/measured/accuracy.md, "slope of angle over sine". The quotient cancels for acute angles; the polynomial does not.
vec2 steradian_trig_angle_over_sine_and_slope(float c, float s2) {
    vec2 both = steradian_trig_angle_over_sine_acute_and_slope(1.0 - abs(c));
    bool obtuse = c < 0.0;
    if (obtuse) {
        float f = steradian_pi() * inversesqrt(max(s2, steradian_smallest_divisor())) - both.x;
        both = steradian_select(obtuse, vec2(f, (1.0 - c * min(f, 1.0e12)) / max(s2, 1.0e-12)), both);
    }
    return both;
}

// The angle of the vector (x, y) from the x axis, in (-pi, pi] [rad].
//
// Degenerate: (0, 0) gives 0. Scale does not matter as long as the smaller over the larger does not underflow.
// Error: see docs/measured/accuracy.md, "atan2".
float steradian_trig_atan2(float y, float x) {
    float ax = abs(x);
    float ay = abs(y);
    float larger = max(ax, ay);
    float t = min(ax, ay) / max(larger, 1.0e-37);
    float q = t * t;
    float p = steradian_trig_atan_over_argument_24_bits(q);
    float angle = t * p;
    angle = steradian_select(ay > ax, 0.5 * steradian_pi() - angle, angle);
    angle = steradian_select(x < 0.0, steradian_pi() - angle, angle);
    return steradian_select(y < 0.0, -angle, angle);
}

// The same angle, counted from -pi/2 to 3 pi/2: for angles known to lie in [0, pi], whose rounding must not wrap.
float steradian_trig_atan2_unwrapped(float y, float x) {
    float angle = steradian_trig_atan2(y, x);
    return steradian_select(angle < -0.5 * steradian_pi(), angle + 2.0 * steradian_pi(), angle);
}

// ==== quartic ====

// Quartic polynomials that are positive on the real axis: two conjugate pairs of roots.

// The roots of a real quartic without real roots: one of each conjugate pair, the one with positive imaginary part.
struct SteradianQuarticPoles {
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
float steradian_quartic_third_cosine(float x) {
    float t = sqrt(max(0.5 + 0.5 * x, 0.0));
    float c = 0.5 + t * (0.577350269189625765 - 0.0773502691896257645 * t);
    for (int i = 0; i < 2; i++) {
        float c2 = c * c;
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
SteradianQuarticPoles steradian_quartic_poles_approximate(float c0, float c1, float c2, float c3) {
    float shift = 0.25 * c3;
    float shift2 = shift * shift;
    float p = c2 - 6.0 * shift2;
    float q = c1 - 2.0 * c2 * shift + 8.0 * shift2 * shift;
    float r = c0 - c1 * shift + c2 * shift2 - 3.0 * shift2 * shift2;

    // Largest root of the resolvent z^3 + 2 p z^2 + (p^2 - 4 r) z - q^2.
    float radius2 = max(p * p + 12.0 * r, 1.0e-12);
    float radius = sqrt(radius2);
    float cosine = clamp((p * (p * p - 36.0 * r) + 13.5 * q * q) / (radius2 * radius), -1.0, 1.0);
    float z = max(0.666666666666666667 * (radius * steradian_quartic_third_cosine(cosine) - p), 0.0);
    float s = sqrt(z);

    float sum = p + z;
    float root = sqrt(max(sum * sum - 4.0 * r, 0.0));
    float difference = steradian_select(z > 1.0e-3 * abs(p), q / max(s, steradian_smallest_length()), steradian_select(q < 0.0, -root, root));
    SteradianQuarticPoles poles;
    poles.z1 = vec2(-0.5 * s - shift, sqrt(max(0.5 * (sum - difference) - 0.25 * z, 1.0e-6)));
    poles.z2 = vec2(0.5 * s - shift, sqrt(max(0.5 * (sum + difference) - 0.25 * z, 1.0e-6)));
    return poles;
}
