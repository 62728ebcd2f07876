// The Phong lobe's boundary integral in constant time: the matched ellipsoid and its cosine series.
//
// The integrand (1 - x^m)/(1 - x^2) is compared with that of the ellipsoid which has the same peak and the same
// far tail. In the ellipsoid's own angle u, tan u = tan(phi)/w, w = |s|/kap, kap^2 = 1 - c^m,
//     |s| * integral of the integrand dphi = kap * integral of E(u) du,
// exactly; E is even, periodic in pi, 1 at both ends, and within 0.3 of 1 between: a few cosines give it. Their
// amplitudes depend on kap^2 and 1/m alone and carry the factor 1 - kap^2 = c^m, so that the error vanishes away
// from the highlight. Valid for n >= 1; moment_cosine.glsl serves 0 <= n < 1.
// Coefficients: tools/fit_phong_series finds them; the test PhongSeries.CoefficientsAreTheFittedOnes compares.
// Source: this project (docs/moments.md).
// Needs: moment.glsl
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
// Largest error 2.2e-04 of the full lobe for a piece of an edge that begins at the foot.
MomentSeries moment_series_prepare(real n) {
    real g = 1.0 / (n + 1.0);
    MomentSeries series;
    series.m = n + 1.0;
    series.b0 = vec4(
        0.12557 + g * (-0.27563 + g * 0.04870),
        0.07372 + g * (-0.19343 + g * 0.08837),
        -0.11704 + g * (0.36657 - g * 0.25594),
        0.14769 + g * (-0.43202 + g * 0.26283));
    series.b1 = vec4(
        -0.03624 + g * (0.04407 + g * 0.05910),
        0.06330 + g * (-0.33447 + g * 0.42828),
        -0.13595 + g * (0.70502 - g * 0.89613),
        0.16026 + g * (-0.82384 + g * 1.03934));
    series.b2 = vec4(
        -0.13522 + g * (0.38321 - g * 0.22983),
        -0.06937 + g * (0.10996 + g * 0.07945),
        0.05773 + g * (0.10382 - g * 0.50598),
        -0.09477 + g * (-0.01994 + g * 0.49008));
    series.b3 = vec4(
        0.04719 + g * (-0.11741 + g * 0.04327),
        -0.07026 + g * (0.38975 - g * 0.51644),
        0.15093 + g * (-0.77915 + g * 0.98284),
        -0.18602 + g * (0.98226 - g * 1.26158));
    return series;
}

// Largest error 5.2e-05 of the full lobe for a piece of an edge that begins at the foot.
MomentSeriesHigh moment_series_high_prepare(real n) {
    real g = 1.0 / (n + 1.0);
    MomentSeriesHigh series;
    series.m = n + 1.0;
    series.low0 = vec3(
        0.12703 + g * (-0.27960 + g * 0.05068),
        0.07290 + g * (-0.20575 + g * 0.11681),
        -0.28538 + g * (0.99711 - g * 0.83461));
    series.high0 = vec3(
        0.97855 + g * (-3.32180 + g * 2.66803),
        -1.33217 + g * (4.51682 - g * 3.62002),
        0.68719 + g * (-2.30012 + g * 1.80682));
    series.low1 = vec3(
        -0.03470 + g * (0.03639 + g * 0.06855),
        0.06539 + g * (-0.35485 + g * 0.46335),
        -0.34870 + g * (1.88329 - g * 2.46506));
    series.high1 = vec3(
        1.16512 + g * (-6.26216 + g * 8.16649),
        -1.58746 + g * (8.52191 - g * 11.10423),
        0.81281 + g * (-4.34534 + g * 5.64527));
    series.low2 = vec3(
        -0.13626 + g * (0.38351 - g * 0.22562),
        -0.06203 + g * (0.07759 + g * 0.11914),
        0.09818 + g * (0.45104 - g * 1.48943));
    series.high2 = vec3(
        -0.39741 + g * (-1.24245 + g * 4.70244),
        0.53926 + g * (1.70258 - g * 6.41759),
        -0.29200 + g * (-0.81231 + g * 3.22433));
    series.low3 = vec3(
        0.04529 + g * (-0.10725 + g * 0.03012),
        -0.06702 + g * (0.36617 - g * 0.47877),
        0.34517 + g * (-1.73875 + g * 2.14127));
    series.high3 = vec3(
        -1.17770 + g * (5.99047 - g * 7.44009),
        1.60733 + g * (-8.17260 + g * 10.14812),
        -0.83356 + g * (4.25230 - g * 5.29673));
    series.low4 = vec3(
        0.00539 + g * (-0.08666 + g * 0.16020),
        -0.01016 + g * (0.12811 - g * 0.24066),
        0.22959 + g * (-1.81825 + g * 2.95180));
    series.high4 = vec3(
        -0.70628 + g * (5.68321 - g * 9.28700),
        0.96798 + g * (-7.78243 + g * 12.71316),
        -0.48419 + g * (3.91370 - g * 6.40728));
    series.low5 = vec3(
        -0.01074 + g * (0.07935 - g * 0.11996),
        -0.00179 + g * (0.01480 - g * 0.02609),
        0.00371 + g * (-0.17613 + g * 0.39859));
    series.high5 = vec3(
        0.01604 + g * (0.32547 - g * 0.87674),
        -0.02595 + g * (-0.41291 + g * 1.14610),
        0.02814 + g * (0.08612 - g * 0.37731));
    return series;
}

// A harmonic's amplitude over 1 - kap2, at t = kap2.
real moment_series_cubic(vec4 b, real t) {
    return ((b.w * t + b.z) * t + b.y) * t + b.x;
}

// The same in high quality.
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
    real over_both = 2.0 / max(d0 * d1, 1.0e-30);
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
// Error: see docs/accuracy.md, "phong series": about 2e-4 of the full lobe's 2 pi for each side of the foot.
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

// The same in high quality. Error: about 5e-5 of the full lobe for each side of the foot.
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
