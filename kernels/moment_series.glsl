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
// Largest error 2.1e-04 of the full lobe for a piece of an edge that begins at the foot.
MomentSeries moment_series_prepare(real n) {
    real g = 1.0 / (n + 1.0);
    MomentSeries series;
    series.m = n + 1.0;
    series.b0 = vec4(
        0.12664 + g * (-0.27884 + g * 0.05067),
        0.06216 + g * (-0.15549 + g * 0.05883),
        -0.08614 + g * (0.26499 - g * 0.17662),
        0.12450 + g * (-0.35388 + g * 0.19859));
    series.b1 = vec4(
        -0.03496 + g * (0.03643 + g * 0.07005),
        0.05028 + g * (-0.26898 + g * 0.34776),
        -0.10106 + g * (0.52762 - g * 0.67573),
        0.13428 + g * (-0.69464 + g * 0.88252));
    series.b2 = vec4(
        -0.13584 + g * (0.38390 - g * 0.22874),
        -0.06308 + g * (0.10921 + g * 0.05324),
        0.04086 + g * (0.10980 - g * 0.44533),
        -0.08175 + g * (-0.03621 + g * 0.47176));
    series.b3 = vec4(
        0.04578 + g * (-0.10843 + g * 0.02987),
        -0.05618 + g * (0.32100 - g * 0.43483),
        0.11286 + g * (-0.58345 + g * 0.73743),
        -0.15784 + g * (0.84344 - g * 1.09508));
    return series;
}

// Largest error 5.9e-05 of the full lobe for a piece of an edge that begins at the foot.
MomentSeriesHigh moment_series_high_prepare(real n) {
    real g = 1.0 / (n + 1.0);
    MomentSeriesHigh series;
    series.m = n + 1.0;
    series.low0 = vec3(
        0.12765 + g * (-0.28157 + g * 0.05202),
        0.05820 + g * (-0.15265 + g * 0.06950),
        -0.18571 + g * (0.63688 - g * 0.51376));
    series.high0 = vec3(
        0.70175 + g * (-2.31306 + g * 1.75683),
        -0.99827 + g * (3.29119 - g * 2.49952),
        0.54206 + g * (-1.76220 + g * 1.30706));
    series.low1 = vec3(
        -0.03389 + g * (0.03102 + g * 0.07682),
        0.04779 + g * (-0.26197 + g * 0.34458),
        -0.22906 + g * (1.24690 - g * 1.64554));
    series.high1 = vec3(
        0.83356 + g * (-4.50918 + g * 5.92237),
        -1.18822 + g * (6.42166 - g * 8.42880),
        0.63979 + g * (-3.44198 + g * 4.50310));
    series.low2 = vec3(
        -0.13654 + g * (0.38380 - g * 0.22520),
        -0.05641 + g * (0.08939 + g * 0.06743),
        0.06001 + g * (0.37821 - g * 1.15616));
    series.high2 = vec3(
        -0.29005 + g * (-1.09053 + g * 3.89390),
        0.40816 + g * (1.57607 - g * 5.57382),
        -0.23395 + g * (-0.79226 + g * 2.93810));
    series.low3 = vec3(
        0.04446 + g * (-0.10136 + g * 0.02064),
        -0.04980 + g * (0.28145 - g * 0.37720),
        0.22723 + g * (-1.13211 + g * 1.37913));
    series.high3 = vec3(
        -0.85099 + g * (4.31591 - g * 5.34370),
        1.21358 + g * (-6.14901 + g * 7.60796),
        -0.66280 + g * (3.37589 - g * 4.19809));
    series.low4 = vec3(
        0.00506 + g * (-0.08685 + g * 0.16309),
        0.00073 + g * (0.04780 - g * 0.11587),
        0.15668 + g * (-1.30346 + g * 2.17438));
    series.high4 = vec3(
        -0.50590 + g * (4.31400 - g * 7.26613),
        0.72886 + g * (-6.20386 + g * 10.44214),
        -0.38198 + g * (3.27380 - g * 5.52514));
    series.low5 = vec3(
        -0.01082 + g * (0.08145 - g * 0.12466),
        -0.00133 + g * (0.00550 - g * 0.00686),
        0.00144 + g * (-0.14055 + g * 0.33187));
    series.high5 = vec3(
        0.02264 + g * (0.22873 - g * 0.69895),
        -0.03337 + g * (-0.32085 + g * 0.99036),
        0.03129 + g * (0.05213 - g * 0.32435));
    return series;
}

real moment_series_cubic(vec4 b, real t) {
    return ((b.w * t + b.z) * t + b.y) * t + b.x;
}

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

MomentWarp moment_warp(MomentEdge edge, real m) {
    MomentWarp warp;
    warp.kap2 = moment_1_minus_exp(0.5 * m * edge.log_c);
    warp.kap = sqrt(warp.kap2);
    real w = edge.s / warp.kap;
    warp.du = moment_angle(w, edge.x0, edge.y0, edge.x1, edge.y1);
    real wx0 = w * edge.x0;
    real wx1 = w * edge.x1;
    real scale0 = 2.0 / max(wx0 * wx0 + edge.y0 * edge.y0, 1.0e-36);
    real scale1 = 2.0 / max(wx1 * wx1 + edge.y1 * edge.y1, 1.0e-36);
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

// The same in high quality. Error: about 6e-5 of the full lobe for each side of the foot.
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
