// A Phong lobe along an edge. The pipeline chooses METHOD and LOW_EXPONENT, which is 2 where the series goes through n + 2. With
// PHONG_COMPARISON, the methods that benches compare are there too; F_IS_X is the form of the fits.
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.
#ifdef PHONG_COMPARISON
#include "comparison/moment_arvo.glsl"
#include "comparison/moment_peak_fits.glsl"
#endif
#include "phong_methods.glsl"

// |s| times the integral of (1 - x^m)/(1 - x^2) over the part in front of an edge, m = n + 1.
float phong_front(MomentEdge edge, float n) {
    if (METHOD == kPhongExact) return moment_quadrature_front(edge, n).moment;
#ifdef PHONG_COMPARISON
    if (METHOD == kPhongArvo) return n < 1.0 ? moment_solid_angle_front(edge) : moment_arvo_front(edge, int(n), 0, 0.0);
    if (METHOD == kPhongLorentzian) return moment_lorentzian_front(edge, n, F_IS_X);
    if (METHOD == kPhongPearson) return moment_pearson_front(edge, n, F_IS_X);
    if (METHOD == kPhongEllipsoid) return moment_ellipsoid_front(edge, n, F_IS_X);
#endif
    bool below_1 = LOW_EXPONENT == 2;
    float order = below_1 ? n + 2.0 : n;
    if (METHOD == kPhongSeriesHigh) {
        MomentSeriesHigh series = moment_series_high_prepare(order);
        return below_1 ? moment_series_high_low_front(edge, series, n) : moment_series_high_front(edge, series);
    }
    MomentSeries series = moment_series_prepare(order);
    return below_1 ? moment_series_low_front(edge, series, n) : moment_series_front(edge, series);
}
