// Inverse trigonometry for the kernels, the same in every language.
//
// The built-in acos and atan of shader compilers differ by up to 8e-5; these polynomials do not. Each exists for 24
// bits (float, GPU) and for 53 (double); real_digits() is a compile-time constant and picks one.
// Coefficients: tools/fit_inverse_trig finds them; the test InverseTrig.PolynomialsAreTheFittedOnes compares.
// Needs: constants.glsl
// Topics: trig
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.

// Degree 9, largest relative error 1.3e-08 before rounding.
real trig_angle_over_sine_24_bits(real t) {
    real p = 0.01116282422619877;
    p = p * t - 0.032591688733997218;
    p = p * t + 0.05097575847577638;
    p = p * t - 0.033552997791327491;
    p = p * t + 0.030059175970996568;
    p = p * t + 0.020163489805166888;
    p = p * t + 0.057977801513775039;
    p = p * t + 0.13326657225500885;
    p = p * t + 0.33333538143391106;
    p = p * t + 0.9999999897346874;
    return p;
}

// Degree 22, largest relative error 9.6e-19 before rounding.
real trig_angle_over_sine_53_bits(real t) {
    real p = 0.0000544854223807370529296;
    p = p * t - 0.00051584262216649147;
    p = p * t + 0.0023195714097954288;
    p = p * t - 0.0065257721900453007;
    p = p * t + 0.012831171382518264;
    p = p * t - 0.018665698304732546;
    p = p * t + 0.020792441196777131;
    p = p * t - 0.018085568996634216;
    p = p * t + 0.01247298987576087;
    p = p * t - 0.0068049923845819099;
    p = p * t + 0.0030530252835647264;
    p = p * t - 0.0009177286809174119;
    p = p * t + 0.0005524402819890922;
    p = p * t + 0.00049169516695552677;
    p = p * t + 0.0011805559952202177;
    p = p * t + 0.0024850713024891246;
    p = p * t + 0.0053281297869745845;
    p = p * t + 0.011544003308720685;
    p = p * t + 0.025396825761030178;
    p = p * t + 0.057142857132990513;
    p = p * t + 0.13333333333347488;
    p = p * t + 0.33333333333333254;
    p = p * t + 1.0;
    return p;
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

// Angle over sine of an angle in [0, pi/2], from its cosine: acos(c) / sqrt(1 - c*c).
//
//   t        1 - c, in [0, 1]
//   returns  1 at t = 0 to pi/2 at t = 1
//
// Error: see docs/measured/accuracy.md, "angle over sine". A series in 1 - c has positive terms: nothing cancels.
real trig_angle_over_sine_acute(real t) {
    if (real_digits() > 24) {
        return trig_angle_over_sine_53_bits(t);
    }
    return trig_angle_over_sine_24_bits(t);
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

// Degree 8: the derivative of trig_angle_over_sine_24_bits.
real trig_angle_over_sine_slope_24_bits(real t) {
    real p = 0.10046541803578893;
    p = p * t - 0.260733509871977744;
    p = p * t + 0.35683030933043466;
    p = p * t - 0.201317986747964946;
    p = p * t + 0.15029587985498284;
    p = p * t + 0.080653959220667552;
    p = p * t + 0.173933404541325117;
    p = p * t + 0.2665331445100177;
    p = p * t + 0.33333538143391106;
    return p;
}

// Degree 21: the derivative of trig_angle_over_sine_53_bits.
real trig_angle_over_sine_slope_53_bits(real t) {
    real p = 0.00119867929237621516;
    p = p * t - 0.0108326950654963209;
    p = p * t + 0.046391428195908576;
    p = p * t - 0.123989671610860713;
    p = p * t + 0.230961084885328752;
    p = p * t - 0.317316871180453282;
    p = p * t + 0.332679059148434096;
    p = p * t - 0.27128353494951324;
    p = p * t + 0.17462185826065218;
    p = p * t - 0.0884649009995648287;
    p = p * t + 0.0366363034027767168;
    p = p * t - 0.0100950154900915309;
    p = p * t + 0.005524402819890922;
    p = p * t + 0.00442525650259974093;
    p = p * t + 0.0094444479617617416;
    p = p * t + 0.0173954991174238722;
    p = p * t + 0.031968778721847507;
    p = p * t + 0.057720016543603425;
    p = p * t + 0.101587303044120712;
    p = p * t + 0.171428571398971539;
    p = p * t + 0.26666666666694976;
    p = p * t + 0.33333333333333254;
    return p;
}

// Minus the derivative of angle over sine by the cosine, of an angle in [0, pi].
//
//   c        cosine, in [-1, 1]
//   s2       sine squared, computed on its own
//   f        trig_angle_over_sine(c, s2)
//   returns  1/3 at c = 1, 1 at c = 0; (1 - c f) / s2 in between and beyond
//
// Degenerate: it grows like pi / s2^1.5 towards pi and stops at s2 = 1.0e-12.
// Error: see docs/measured/accuracy.md, "slope of angle over sine". The quotient cancels for acute angles; the polynomial does not.
real trig_angle_over_sine_slope(real c, real s2, real f) {
    real t = 1.0 - abs(c);
    real slope = trig_angle_over_sine_slope_24_bits(t);
    if (real_digits() > 24) {
        slope = trig_angle_over_sine_slope_53_bits(t);
    }
    mask obtuse = c < 0.0;
    if (any_lane(obtuse)) {
        slope = select(obtuse, (1.0 - c * min(f, 1.0e12)) / max(s2, 1.0e-12), slope);
    }
    return slope;
}
