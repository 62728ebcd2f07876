// The Phong lobe's boundary integral in constant time: the matched ellipsoid and its cosine series.
//
// The integrand (1 - x^m)/(1 - x^2) is compared with that of the ellipsoid which has the same peak and the same
// far tail. In the ellipsoid's own angle u, tan u = tan(phi)/w, w = |s|/kap, kap^2 = 1 - c^m,
//     |s| * integral of the integrand dphi = kap * integral of E(u) du,
// exactly; E is even, periodic in pi, 1 at both ends, and within 0.3 of 1 between: a few cosines give it. Their
// amplitudes depend on kap^2 and 1/m alone and carry the factor 1 - kap^2 = c^m, so that the error vanishes away
// from the highlight. Valid for n >= 1; moment_cosine.glsl serves 0 <= n < 1.
// Coefficients: tools/fit_phong_series finds them; the test PhongSeries.CoefficientsAreTheFittedOnes compares.
// Source: this project (docs/theory/moments.md).
// Needs: constants.glsl moment.glsl
// Topics: moment
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.

// A lobe's series: amplitude of harmonic k is (1 - kap2) times a cubic in kap2, constant first.
struct MomentSeries {
    real m;
    vec4 b0;
    vec4 b1;
    vec4 b2;
    vec4 b3;
};

// The series of high quality: two harmonics more, each a quintic; low holds its first three coefficients.
struct MomentSeriesHigh {
    real m;
    vec3 low0;
    vec3 high0;
    vec3 low1;
    vec3 high1;
    vec3 low2;
    vec3 high2;
    vec3 low3;
    vec3 high3;
    vec3 low4;
    vec3 high4;
    vec3 low5;
    vec3 high5;
};

// The series of the lobe of exponent n. Prepare once per lobe.
// Largest error 2.7e-04 of the full lobe for a piece of an edge that begins at the foot.
MomentSeries moment_series_prepare(real n) {
    real g = 1.0 / (n + 1.0);
    MomentSeries series;
    series.m = n + 1.0;
    series.b0 = vec4(
        0.12391 + g * (-0.25888 + g * 0.02078),
        0.07456 + g * (-0.20614 + g * 0.11305),
        -0.12583 + g * (0.43406 - g * 0.36368),
        0.15639 + g * (-0.50303 + g * 0.37906));
    series.b1 = vec4(
        -0.03292 + g * (0.01056 + g * 0.11495),
        0.06163 + g * (-0.30904 + g * 0.37892),
        -0.11837 + g * (0.57004 - g * 0.68066),
        0.14285 + g * (-0.68183 + g * 0.80688));
    series.b2 = vec4(
        -0.13853 + g * (0.41672 - g * 0.28568),
        -0.06770 + g * (0.08453 + g * 0.12882),
        0.04014 + g * (0.23881 - g * 0.72146),
        -0.07736 + g * (-0.16196 + g * 0.72256));
    series.b3 = vec4(
        0.05051 + g * (-0.15092 + g * 0.09913),
        -0.07193 + g * (0.41519 - g * 0.56582),
        0.16852 + g * (-0.91416 + g * 1.19835),
        -0.20343 + g * (1.12430 - g * 1.49409));
    return series;
}

// Largest error 5.2e-05 of the full lobe for a piece of an edge that begins at the foot.
MomentSeriesHigh moment_series_high_prepare(real n) {
    real g = 1.0 / (n + 1.0);
    MomentSeriesHigh series;
    series.m = n + 1.0;
    series.low0 = vec3(
        0.12669 + g * (-0.27819 + g * 0.04967),
        0.07312 + g * (-0.20720 + g * 0.11887),
        -0.28171 + g * (0.96646 - g * 0.78366));
    series.high0 = vec3(
        0.96760 + g * (-3.22789 + g * 2.51001),
        -1.31672 + g * (4.38441 - g * 3.39728),
        0.67908 + g * (-2.22981 + g * 1.68799));
    series.low1 = vec3(
        -0.03401 + g * (0.03357 + g * 0.07057),
        0.06494 + g * (-0.35196 + g * 0.45924),
        -0.35605 + g * (1.94458 - g * 2.56698));
    series.high1 = vec3(
        1.18702 + g * (-6.44998 + g * 8.48253),
        -1.61836 + g * (8.78673 - g * 11.54971),
        0.82904 + g * (-4.48596 + g * 5.88295));
    series.low2 = vec3(
        -0.13696 + g * (0.38633 - g * 0.22764),
        -0.06158 + g * (0.07469 + g * 0.12325),
        0.10552 + g * (0.38974 - g * 1.38750));
    series.high2 = vec3(
        -0.41931 + g * (-1.05462 + g * 4.38637),
        0.57016 + g * (1.43774 - g * 5.97208),
        -0.30823 + g * (-0.67167 + g * 2.98664));
    series.low3 = vec3(
        0.04598 + g * (-0.11007 + g * 0.03214),
        -0.06747 + g * (0.36907 - g * 0.48289),
        0.33782 + g * (-1.67745 + g * 2.03933));
    series.high3 = vec3(
        -1.15579 + g * (5.80262 - g * 7.12399),
        1.57642 + g * (-7.90773 + g * 9.70255),
        -0.81732 + g * (4.11164 - g * 5.05901));
    series.low4 = vec3(
        0.00469 + g * (-0.08385 + g * 0.15819),
        -0.00971 + g * (0.12521 - g * 0.23654),
        0.23694 + g * (-1.87957 + g * 3.05375));
    series.high4 = vec3(
        -0.72818 + g * (5.87109 - g * 9.60316),
        0.99890 + g * (-8.04735 + g * 13.15881),
        -0.50043 + g * (4.05438 - g * 6.64504));
    series.low5 = vec3(
        -0.01005 + g * (0.07653 - g * 0.11794),
        -0.00224 + g * (0.01770 - g * 0.03021),
        -0.00365 + g * (-0.11481 + g * 0.29662));
    series.high5 = vec3(
        0.03795 + g * (0.13754 - g * 0.56050),
        -0.05687 + g * (-0.14794 + g * 0.70035),
        0.04439 + g * (-0.05460 - g * 0.13949));
    return series;
}

// A harmonic's amplitude over 1 - kap2, at t = kap2.
real moment_series_cubic(vec4 b, real t) {
    return ((b.w * t + b.z) * t + b.y) * t + b.x;
}

// A harmonic's amplitude over 1 - kap2 in high quality, at t = kap2.
real moment_series_quintic(vec3 low, vec3 high, real t) {
    return ((((high.z * t + high.y) * t + high.x) * t + low.z) * t + low.y) * t + low.x;
}

// The part in front in the ellipsoid's own angle.
//   kap, kap2  of the ellipsoid
//   du         angle from end to end [rad]
//   cosine     twice the cosine of 2u at end 0 and end 1
//   sine       the sine of 2u
struct MomentWarp {
    real kap;
    real kap2;
    real du;
    vec2 cosine;
    vec2 sine;
};

// Finds the ellipsoid of one edge for a lobe of exponent m - 1.
MomentWarp moment_warp(MomentEdge edge, real m) {
    MomentWarp warp;
    warp.kap2 = moment_1_minus_exp(0.5 * m * edge.log_c);
    real over_kap = inversesqrt(warp.kap2);
    warp.kap = warp.kap2 * over_kap;
    real w = edge.s * over_kap;
    real wx0 = w * edge.x0;
    real wx1 = w * edge.x1;
    warp.du = trig_atan2_unwrapped(wx0 * edge.y1 - wx1 * edge.y0, wx0 * wx1 + edge.y0 * edge.y1);
    // One division for both ends: they are at least c^2 w^2, 1e-10 where the pole begins.
    real d0 = wx0 * wx0 + edge.y0 * edge.y0;
    real d1 = wx1 * wx1 + edge.y1 * edge.y1;
    real over_both = 2.0 / max(d0 * d1, smallest_divisor());
    real scale0 = over_both * d1;
    real scale1 = over_both * d0;
    warp.cosine = vec2(scale0 * (wx0 * wx0 - edge.y0 * edge.y0), scale1 * (wx1 * wx1 - edge.y1 * edge.y1));
    warp.sine = vec2(scale0 * wx0 * edge.y0, scale1 * wx1 * edge.y1);
    return warp;
}

// |s| times the integral of (1 - x^m)/(1 - x^2) over the part in front of one edge.
//
//   edge     by moment_edge
//   series   by moment_series_prepare, n >= 1
//
// Error: see docs/measured/accuracy.md, "phong series": 3e-4 of the full lobe's 2 pi for each side of the foot.
real moment_series_front(MomentEdge edge, MomentSeries series) {
    MomentWarp warp = moment_warp(edge, series.m);
    real t = warp.kap2;
    // sin(2(k + 1)u) = 2 cos(2u) sin(2ku) - sin(2(k - 1)u), at both ends.
    vec2 s1 = warp.sine;
    vec2 s2 = vec2(warp.cosine.x * s1.x, warp.cosine.y * s1.y);
    vec2 s3 = vec2(warp.cosine.x * s2.x - s1.x, warp.cosine.y * s2.y - s1.y);
    real bump = moment_series_cubic(series.b0, t) * warp.du
              + moment_series_cubic(series.b1, t) * (s1.y - s1.x) * 0.5
              + moment_series_cubic(series.b2, t) * (s2.y - s2.x) * 0.25
              + moment_series_cubic(series.b3, t) * (s3.y - s3.x) * 0.166666666666666667;
    return max(warp.kap * (warp.du + (1.0 - t) * bump), 0.0);
}

// The result of moment_series_front, in high quality. Error: about 5e-5 of the full lobe for each side of the foot.
real moment_series_high_front(MomentEdge edge, MomentSeriesHigh series) {
    MomentWarp warp = moment_warp(edge, series.m);
    real t = warp.kap2;
    vec2 s1 = warp.sine;
    vec2 s2 = vec2(warp.cosine.x * s1.x, warp.cosine.y * s1.y);
    vec2 s3 = vec2(warp.cosine.x * s2.x - s1.x, warp.cosine.y * s2.y - s1.y);
    vec2 s4 = vec2(warp.cosine.x * s3.x - s2.x, warp.cosine.y * s3.y - s2.y);
    vec2 s5 = vec2(warp.cosine.x * s4.x - s3.x, warp.cosine.y * s4.y - s3.y);
    real bump = moment_series_quintic(series.low0, series.high0, t) * warp.du
              + moment_series_quintic(series.low1, series.high1, t) * (s1.y - s1.x) * 0.5
              + moment_series_quintic(series.low2, series.high2, t) * (s2.y - s2.x) * 0.25
              + moment_series_quintic(series.low3, series.high3, t) * (s3.y - s3.x) * 0.166666666666666667
              + moment_series_quintic(series.low4, series.high4, t) * (s4.y - s4.x) * 0.125
              + moment_series_quintic(series.low5, series.high5, t) * (s5.y - s5.x) * 0.1;
    return max(warp.kap * (warp.du + (1.0 - t) * bump), 0.0);
}
