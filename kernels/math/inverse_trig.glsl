// Inverse trigonometry for the kernels, the same in every language.
//
// The built-in acos and atan of shader compilers differ by up to 8e-5; these polynomials do not. Each exists for 24
// bits (float, GPU) and for 53 (double); real_digits() is a compile-time constant and picks one.
// Coefficients: tools/fit_inverse_trig finds them; the test InverseTrig.PolynomialsAreTheFittedOnes compares.
// Needs: constants.glsl
// Topics: trig
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.

// Degree 9, largest relative error 1.3e-08 before rounding; and its derivative, by the same steps.
vec2 trig_angle_over_sine_24_bits(real t) {
    real p = 0.01116282422619877;
    real d = p;
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

// Degree 22, largest relative error 9.6e-19 before rounding; and its derivative, by the same steps.
vec2 trig_angle_over_sine_53_bits(real t) {
    real p = 0.0000544854223807370529296;
    real d = p;
    p = p * t - 0.00051584262216649147;
    d = d * t + p;
    p = p * t + 0.0023195714097954288;
    d = d * t + p;
    p = p * t - 0.0065257721900453007;
    d = d * t + p;
    p = p * t + 0.012831171382518264;
    d = d * t + p;
    p = p * t - 0.018665698304732546;
    d = d * t + p;
    p = p * t + 0.020792441196777131;
    d = d * t + p;
    p = p * t - 0.018085568996634216;
    d = d * t + p;
    p = p * t + 0.01247298987576087;
    d = d * t + p;
    p = p * t - 0.0068049923845819099;
    d = d * t + p;
    p = p * t + 0.0030530252835647264;
    d = d * t + p;
    p = p * t - 0.0009177286809174119;
    d = d * t + p;
    p = p * t + 0.0005524402819890922;
    d = d * t + p;
    p = p * t + 0.00049169516695552677;
    d = d * t + p;
    p = p * t + 0.0011805559952202177;
    d = d * t + p;
    p = p * t + 0.0024850713024891246;
    d = d * t + p;
    p = p * t + 0.0053281297869745845;
    d = d * t + p;
    p = p * t + 0.011544003308720685;
    d = d * t + p;
    p = p * t + 0.025396825761030178;
    d = d * t + p;
    p = p * t + 0.057142857132990513;
    d = d * t + p;
    p = p * t + 0.13333333333347488;
    d = d * t + p;
    p = p * t + 0.33333333333333254;
    d = d * t + p;
    p = p * t + 1.0;
    return vec2(p, d);
}

// Degree 8, largest relative error 1.8e-08 before rounding.
real trig_atan_over_argument_24_bits(real q) {
    real p = 0.002766283501762026;
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

// Degree 22, largest relative error 1.5e-19 before rounding.
real trig_atan_over_argument_53_bits(real q) {
    real p = 0.0000054235777122049748619;
    p = p * q - 0.0000681501430177685972979;
    p = p * q + 0.00040788678988090021;
    p = p * q - 0.0015537533402612332;
    p = p * q + 0.0042551148264804942;
    p = p * q - 0.0089974339942772708;
    p = p * q + 0.015464694610323185;
    p = p * q - 0.022566714208211488;
    p = p * q + 0.029121244608854832;
    p = p * q - 0.034556867496289889;
    p = p * q + 0.039051162476945012;
    p = p * q - 0.043181268997216637;
    p = p * q + 0.047543887590470332;
    p = p * q - 0.052616416091309293;
    p = p * q + 0.058821133510041305;
    p = p * q - 0.066666376799540378;
    p = p * q + 0.076923050864584883;
    p = p * q - 0.090909089238135857;
    p = p * q + 0.11111111103899986;
    p = p * q - 0.14285714285522452;
    p = p * q + 0.19999999999997281;
    p = p * q - 0.3333333333333332;
    p = p * q + 1.0;
    return p;
}

// Angle over sine of an angle in [0, pi/2], from its cosine: acos(c) / sqrt(1 - c*c), and its derivative by t.
//
//   t        1 - c, in [0, 1]
//   returns  vec2(1, 1/3) at t = 0 to vec2(pi/2, 1) at t = 1
//
// Error: see docs/measured/accuracy.md, "angle over sine" and "slope of angle over sine". A series in 1 - c has positive terms: nothing
// cancels.
vec2 trig_angle_over_sine_acute_and_slope(real t) {
    if (real_digits() > 24) {
        return trig_angle_over_sine_53_bits(t);
    }
    return trig_angle_over_sine_24_bits(t);
}

// Angle over sine alone. Arguments: trig_angle_over_sine_acute_and_slope.
real trig_angle_over_sine_acute(real t) {
    vec2 both = trig_angle_over_sine_acute_and_slope(t);
    return both.x;
}

// Angle over sine of an angle in [0, pi], from its cosine and the square of its sine.
//
//   c        cosine, in [-1, 1]; the polynomial goes on smoothly where rounding exceeds it
//   s2       sine squared, computed on its own (a squared cross product), not as 1 - c*c, which cancels near pi
//
// Degenerate: towards pi the value grows like pi/sine; it stops at s2 = 1.0e-30, where products with the sine are 0.
real trig_angle_over_sine(real c, real s2) {
    real f = trig_angle_over_sine_acute(1.0 - abs(c));
    mask obtuse = c < 0.0;
    if (any_lane(obtuse)) {
        f = select(obtuse, pi() * inversesqrt(max(s2, smallest_divisor())) - f, f);
    }
    return f;
}

// Angle over sine, and minus its derivative by the cosine: 1/3 at c = 1, 1 at c = 0; (1 - c f) / s2 in between and beyond. Arguments:
// trig_angle_over_sine, whose value is x.
//
// Degenerate: the slope grows like pi / s2^1.5 towards pi and stops at s2 = 1.0e-12.
// Error: see docs/measured/accuracy.md, "slope of angle over sine". The quotient cancels for acute angles; the polynomial does not.
vec2 trig_angle_over_sine_and_slope(real c, real s2) {
    vec2 both = trig_angle_over_sine_acute_and_slope(1.0 - abs(c));
    mask obtuse = c < 0.0;
    if (any_lane(obtuse)) {
        real f = pi() * inversesqrt(max(s2, smallest_divisor())) - both.x;
        both = select(obtuse, vec2(f, (1.0 - c * min(f, 1.0e12)) / max(s2, 1.0e-12)), both);
    }
    return both;
}

// The angle of the vector (x, y) from the x axis, in (-pi, pi] [rad].
//
// Degenerate: (0, 0) gives 0. Scale does not matter as long as the smaller over the larger does not underflow.
// Error: see docs/measured/accuracy.md, "atan2".
real trig_atan2(real y, real x) {
    real ax = abs(x);
    real ay = abs(y);
    real larger = max(ax, ay);
    real t = min(ax, ay) / max(larger, 1.0e-37);
    real q = t * t;
    real p = trig_atan_over_argument_24_bits(q);
    if (real_digits() > 24) {
        p = trig_atan_over_argument_53_bits(q);
    }
    real angle = t * p;
    angle = select(ay > ax, 0.5 * pi() - angle, angle);
    angle = select(x < 0.0, pi() - angle, angle);
    return select(y < 0.0, -angle, angle);
}

// The same angle, counted from -pi/2 to 3 pi/2: for angles known to lie in [0, pi], whose rounding must not wrap.
real trig_atan2_unwrapped(real y, real x) {
    real angle = trig_atan2(y, x);
    return select(angle < -0.5 * pi(), angle + 2.0 * pi(), angle);
}
