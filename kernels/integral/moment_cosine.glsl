// Powers of the cosine along an edge, the exact double-axis moment, and the Phong series below exponent 1.
//
// The integral of cos^n from the foot is an incomplete beta function. With v^2 = -2 log cos phi it becomes that of
// exp(-(n + 1/2) v^2/2) (1 - v^4/48 ...): an error function and one correction. For n < 8 two steps of the recurrence
// over n lead to where that is close.
// Source: this project (docs/theory/moments.md); the double-axis moment: Arvo 1995, sec. 5.
// Needs: constants.glsl, inverse_trig.glsl, moment_quadrature.glsl, moment_series.glsl, phong.glsl
// Topics: moment
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.

// The integral of cos^n phi from the foot to the end (x, y) = (c cos phi, c sin phi), |phi| <= pi/2, n >= 4.
//
// Error: relative to the integral up to pi/2, 7e-5 at n = 4, 7e-6 at n = 8, 3e-6 at n = 10, 2e-7 at n = 20.
// Source of the error function: Abramowitz, Stegun, "Handbook of mathematical functions", 1964, 7.1.26.
real moment_cosine_from_foot(real x, real y, real n) {
    real a = n + 0.5;
    real v2 = moment_log_1_plus(y * y / max(x * x, smallest_divisor()));
    real t = 0.5 * a * v2;
    real v = sqrt(v2);
    real decay = exp(-t);
    real e = 1.0 / (1.0 + 0.3275911 * sqrt(t));
    real p = ((((1.061405429 * e - 1.453152027) * e + 1.421413741) * e - 0.284496736) * e + 0.254829592) * e;
    // The correction's share of the integral up to pi/2, which is sqrt(pi/(2 a)) (1 - 1/(16 a^2)).
    real correction = v * (v2 + 3.0 / a) * inversesqrt(a) / (60.1590786 - 3.75994241 / (a * a));
    // Half the beta function B(1/2, (n+1)/2): Gamma(h + 1)/Gamma(h + 1/2) squared is k + 1/(32 k) - 9/(2048 k^3),
    // k = h + 1/4, h = n/2, to 2e-5 at n = 4 and 4e-7 at n = 8.
    real k = 0.5 * n + 0.25;
    real quarter_turn = 0.886226925452758014 * inversesqrt(k + 0.03125 / k - 0.00439453125 / (k * k * k));
    real magnitude = quarter_turn * (1.0 - decay * (p - correction));
    return select(y < 0.0, -magnitude, magnitude);
}

// The integral of x^n dphi, x = c cos phi, over the part in front of one edge; n >= 0.
//
//   low      1 for n < 8, else 0; the same for every lane
//
// Error: at most 9e-5 of the integral over a half circle for n >= 0, 4e-5 for n >= 1, 7e-6 for n >= 5.
real moment_cosine_front(MomentEdge edge, real n, int low) {
    real order = n;
    if (low == 1) {
        order = n + 4.0;
    }
    real cosines = moment_cosine_from_foot(edge.x1, edge.y1, order) - moment_cosine_from_foot(edge.x0, edge.y0, order);
    real result = exp(-0.5 * order * edge.log_c) * cosines;
    if (low == 1) {
        // (n + 1) c^2 int x^n = (n + 2) int x^(n+2) - [x^(n+1) y], twice.
        real c2 = edge.c * edge.c;
        real p0 = phong_power(edge.x0, n + 1.0) * edge.y0;
        real p1 = phong_power(edge.x1, n + 1.0) * edge.y1;
        result = ((n + 4.0) * result - (p1 * edge.x1 * edge.x1 - p0 * edge.x0 * edge.x0)) / ((n + 3.0) * c2);
        result = ((n + 2.0) * result - (p1 - p0)) / ((n + 1.0) * c2);
    }
    return max(result, 0.0);
}

// |s| times the integral of (1 - x^m)/(1 - x^2) over the part in front, for m = n + 1 below 2.
//
//   n        exponent, in [0, 1)
//   raised   the series of exponent n + 2: (1 - x^m)/(1 - x^2) = (1 - x^(m+2))/(1 - x^2) - x^m
real moment_series_low_front(MomentEdge edge, MomentSeries raised, real n) {
    return max(moment_series_front(edge, raised) - edge.s * moment_cosine_front(edge, n + 1.0, 1), 0.0);
}

// The result of moment_series_low_front, in high quality; the error is then that of the cosines.
real moment_series_high_low_front(MomentEdge edge, MomentSeriesHigh raised, real n) {
    return max(moment_series_high_front(edge, raised) - edge.s * moment_cosine_front(edge, n + 1.0, 1), 0.0);
}

// One edge's share of (n + 2) times the double-axis moment, the integral of max(u.r, 0)^n (u.v) over a light.
//
//   a, b     as for moment_edge, r unit axis of the power, v the other axis, of any length
//   share    moment_edge_share with exponent n - 1 (m = n), by any method, n >= 1
//   cosines  the integral of x^n dphi over the part in front, by any method
//
// Exact as far as share and cosines are: foreshortening (v the normal) and the v.h of half-vector space need no
// product of lobes.
real moment_double_axis_share(vec3 a, vec3 b, vec3 r, vec3 v, real share, real cosines) {
    vec3 n = cross(a, b);
    real n2 = dot(n, n);
    real inward = dot(n, v) * inversesqrt(max(n2, smallest_divisor()));
    return dot(r, v) * share + select(n2 > smallest_divisor(), inward * cosines, 0.0);
}

// The two integrands over the part in front of a lobe of exponent n times the light's cosine, by quadrature: share's and cosines'.
//
//   level  1 where n is 0, the same for every lane: the integral of x^0 is the angle, and (1 - x^0)/(1 - x^2) is 0
MomentIntegrands moment_foreshortened_front(MomentEdge edge, real n, int level) {
    MomentIntegrands front;
    front.moment = 0.0;
    front.power = 0.0;
    if (level > 0) {
        front.power = trig_atan2(edge.x0 * edge.y1 - edge.x1 * edge.y0, edge.x0 * edge.x1 + edge.y0 * edge.y1);
    } else {
        front = moment_quadrature_front(edge, n - 1.0);
    }
    return front;
}

// One edge's share of (n + 2) times the moment of a lobe times the light's cosine: z is the normal.
//
//   front    |s| times the integral of (1 - x^m)/(1 - x^2) with exponent n - 1, by any method
//   cosines  the integral of x^n dphi over the part in front, by any method
real moment_foreshortened_share(MomentEdge edge, vec3 a, vec3 b, vec3 r, real front, real cosines) {
    return moment_double_axis_share(a, b, r, vec3(0.0, 0.0, 1.0), moment_edge_share(edge, front), cosines);
}
