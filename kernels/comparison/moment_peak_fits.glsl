// The published peak fits of the Phong lobe's boundary integrand: Lorentzian, Lorentzian-Pearson, ellipsoid.
//
// The integrand I = (f - x^m)/(1 - x^2) is a peak over phi with its foot at 0, f = x or f = 1: the paper takes x for even n
// and 1 otherwise, but each serves every n.
// Each fit is a peak P with an antiderivative, scaled to I's largest and smallest value and to its value at the half
// width x_w; the blends also meet I at a place in the tail. For comparison with moment_series.glsl, which is both
// faster and closer. Corrected against the paper where its prints do not hold (docs/theory/moments.md lists the places).
// Source: Lecocq, Dufay, Sourimant, Marvie, "Analytic approximations for real-time area light shading", 2017,
// eq. 5 to 16; its order N is n - 1 here.
// Needs: constants.glsl, moment_arvo.glsl, phong.glsl
// Topics: moment
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.

// The values that the fits share for one edge.
//   x_w, x_t     half width and the place in the tail [rad]
//   ratio_w      x_w over its limit for c -> 0
//   peak         I at the foot, less its smallest value
//   y_w, y_t     the same at x_w and x_t, over peak
//   smallest     I at phi = pi/2: 0 for f = x, 1 for f = 1
//   phi0, phi1   ends of the part in front [rad]
struct MomentPeak {
    real x_w;
    real x_t;
    real ratio_w;
    real peak;
    real y_w;
    real y_t;
    real smallest;
    real phi0;
    real phi1;
};

// Cosine for |x| <= pi/2: Taylor, the next term is x^16/16!, 7e-11 at pi/2.
real moment_peak_cosine(real x) {
    real t = x * x;
    return 1.0 - t / 2.0 * (1.0 - t / 12.0 * (1.0 - t / 30.0 * (1.0 - t / 56.0 * (1.0 - t / 90.0 * (1.0 - t / 132.0 * (1.0 - t / 182.0))))));
}

// Sine for |x| <= pi/2: Taylor, the next term is x^15/15!, 7e-10 at pi/2.
real moment_peak_sine(real x) {
    real t = x * x;
    return x * (1.0 - t / 6.0 * (1.0 - t / 20.0 * (1.0 - t / 42.0 * (1.0 - t / 72.0 * (1.0 - t / 110.0 * (1.0 - t / 156.0))))));
}

// I less its smallest value, at x = c cos phi. f = x: x (1 - x^n)/(1 - x^2); f = 1: x^2 (1 - x^(n-1))/(1 - x^2).
//
//   f_is_x   1 for f = x, 0 for f = 1
real moment_peak_height(real s2, real c2, real n, int f_is_x, real cosine, real sine) {
    real rest = s2 + c2 * sine * sine;  // 1 - x^2 without cancellation
    real x2 = max(c2 * cosine * cosine, 1.0e-12);
    real log_x = 0.5 * moment_log_1_plus(rest / x2);
    if (f_is_x == 1) {
        return sqrt(x2) * moment_1_minus_exp(n * log_x) / rest;
    }
    return x2 * moment_1_minus_exp((n - 1.0) * log_x) / rest;
}

// The half width by the paper's fit, over its limit for c -> 0 (pi/3 for f = x, pi/4 for f = 1).
//
// Error: up to 17 % (f = x) and 32 % (f = 1, n = 5000), 4 to 8 % on the average.
// Source: eq. 7, with pi/4 outside the power.
real moment_peak_half_width_ratio(real c, real n, int f_is_x) {
    if (f_is_x == 1) {
        real reduced = c - c / max(n - 1.0, 1.0);
        return sqrt(max(1.0 - reduced * reduced, 1.0e-8));
    }
    real k = max(c - c / max(n - 2.0, 1.0), 1.0e-6);
    return phong_power(max(1.0 - phong_power(k, 2.5), 1.0e-8), 0.45);
}

// The values that the fits share for one edge and a lobe of exponent n.
MomentPeak moment_peak_prepare(MomentEdge edge, real n, int f_is_x) {
    real s2 = edge.s * edge.s;
    real c2 = edge.c * edge.c;
    real widest = 0.785398163397448310;
    MomentPeak p;
    p.smallest = 1.0;
    if (f_is_x == 1) {
        widest = 1.04719755119659775;
        p.smallest = 0.0;
    }
    p.ratio_w = moment_peak_half_width_ratio(edge.c, n, f_is_x);
    p.x_w = widest * p.ratio_w;
    real k = 1.0 - p.ratio_w;  // eq. 14: its twelfth power
    real k2 = k * k;
    real k4 = k2 * k2;
    p.x_t = min(p.x_w + 0.3946 * widest * (1.0 - k4 * k4 * k4), 1.57079632679489662);
    p.peak = moment_peak_height(s2, c2, n, f_is_x, 1.0, 0.0);
    real scale = 1.0 / max(p.peak, 1.0e-12);
    p.y_w = scale * moment_peak_height(s2, c2, n, f_is_x, moment_peak_cosine(p.x_w), moment_peak_sine(p.x_w));
    p.y_t = scale * moment_peak_height(s2, c2, n, f_is_x, moment_peak_cosine(p.x_t), moment_peak_sine(p.x_t));
    p.y_w = clamp(p.y_w, 0.01, 0.99);
    p.phi0 = trig_atan2(edge.y0, edge.x0);
    p.phi1 = trig_atan2(edge.y1, edge.x1);
    return p;
}

// A peak scaled to 1 at the foot and 0 at pi/2.
//   integral  over the part in front
//   tail      its value at x_t
struct MomentFit {
    real integral;
    real tail;
};

// The scaled peak from a peak's integral, its value at the tail's place and its value at pi/2; at the foot it is 1.
MomentFit moment_fit_scaled(MomentPeak p, real integral, real tail, real lowest) {
    real scale = 1.0 / (1.0 - lowest);
    MomentFit fit;
    fit.integral = scale * (integral - lowest * (p.phi1 - p.phi0));
    fit.tail = scale * (tail - lowest);
    return fit;
}

// Width parameter of the Lorentzian. Source: eq. 11. Kept above 1.0e-3, where the scaled peak is its limit.
real moment_lorentzian_width(MomentPeak p) {
    real x2 = p.x_w * p.x_w;
    return max((1.0 - p.y_w - 0.405284734569351086 * x2) / (p.y_w * x2), 1.0e-3);
}

// The Lorentzian peak 1/(1 + a phi^2). Source: eq. 11 and 12.
MomentFit moment_fit_lorentzian(MomentPeak p) {
    real a = moment_lorentzian_width(p);
    real root = sqrt(a);
    real integral = trig_atan2(root * (p.phi1 - p.phi0), 1.0 + a * p.phi0 * p.phi1) / root;
    return moment_fit_scaled(p, integral, 1.0 / (1.0 + a * p.x_t * p.x_t), 1.0 / (1.0 + a * 2.46740110027233966));
}

// The peak of Pearson VII: (1 + b phi^2)^-2 with b = a/2.
MomentFit moment_fit_pearson(MomentPeak p) {
    real b = 0.5 * moment_lorentzian_width(p);
    real root = sqrt(b);
    real angle = trig_atan2(root * (p.phi1 - p.phi0), 1.0 + b * p.phi0 * p.phi1);
    real ends = p.phi1 / (1.0 + b * p.phi1 * p.phi1) - p.phi0 / (1.0 + b * p.phi0 * p.phi0);
    real t = 1.0 / (1.0 + b * p.x_t * p.x_t);
    real l = 1.0 / (1.0 + b * 2.46740110027233966);
    return moment_fit_scaled(p, 0.5 * (ends + angle / root), t * t, l * l);
}

// A width of exactly 1 is a constant peak, 0/0 when scaled: kept 4e-3 away.
real moment_fit_not_one(real a) {
    return select(abs(a - 1.0) < 0.004, 1.004, a);
}

// Width parameter of the ellipsoid. Source: eq. 15.
real moment_ellipsoid_width(MomentPeak p) {
    real cosine = moment_peak_cosine(p.x_w);
    real sine = moment_peak_sine(p.x_w);
    return p.y_w * sine * sine / (cosine * cosine * (1.0 - p.y_w));
}

// The ellipsoid peak a/(1 + (a - 1) cos^2 phi). Source: eq. 15 and 16.
MomentFit moment_fit_ellipsoid(MomentEdge edge, MomentPeak p) {
    real a = moment_fit_not_one(moment_ellipsoid_width(p));
    real root = sqrt(a);
    real cosine = moment_peak_cosine(p.x_t);
    real integral = root * moment_angle(root, edge.x0, edge.y0, edge.x1, edge.y1);
    return moment_fit_scaled(p, integral, a / (1.0 + (a - 1.0) * cosine * cosine), a);
}

// The squared ellipsoid peak (b/(1 + (b - 1) cos^2 phi))^2.
MomentFit moment_fit_ellipsoid_squared(MomentEdge edge, MomentPeak p) {
    real b = moment_fit_not_one(moment_ellipsoid_width(p) * (2.1 + 1.28 * p.ratio_w));
    real root = sqrt(b);
    real cosine = moment_peak_cosine(p.x_t);
    real e0 = edge.x0 * edge.y0 / max(b * edge.x0 * edge.x0 + edge.y0 * edge.y0, smallest_divisor());
    real e1 = edge.x1 * edge.y1 / max(b * edge.x1 * edge.x1 + edge.y1 * edge.y1, smallest_divisor());
    real angle = moment_angle(root, edge.x0, edge.y0, edge.x1, edge.y1);
    real integral = 0.5 * root * (b + 1.0) * angle - 0.5 * b * (b - 1.0) * (e1 - e0);
    real t = b / (1.0 + (b - 1.0) * cosine * cosine);
    return moment_fit_scaled(p, integral, t * t, b * b);
}

// Blend of a peak with too heavy a tail and one with too light a tail, so that the blend meets I in the tail.
//
// Source: eq. 13, clamped: its denominator vanishes where the two meet.
MomentFit moment_fit_blended(MomentPeak p, MomentFit heavy, MomentFit light) {
    real d = light.tail - heavy.tail;
    real alpha = (light.tail - p.y_t) / select(d < 0.0, min(d, -1.0e-12), max(d, 1.0e-12));
    alpha = clamp(alpha, 0.0, 1.0);
    MomentFit fit;
    fit.integral = alpha * heavy.integral + (1.0 - alpha) * light.integral;
    fit.tail = alpha * heavy.tail + (1.0 - alpha) * light.tail;
    return fit;
}

// |s| times the integral of (1 - x^m)/(1 - x^2) over the part in front, from a fit.
//
// Degenerate: a peak below 1e-12 (n = 1) leaves the smallest value alone.
real moment_fit_front(MomentEdge edge, MomentPeak p, MomentFit fit, int f_is_x) {
    real peak = select(p.peak > 1.0e-12, p.peak * fit.integral, 0.0);
    real front = edge.s * (peak + p.smallest * (p.phi1 - p.phi0));
    if (f_is_x == 1) {
        front = front + moment_solid_angle_front(edge);
    }
    return max(front, 0.0);
}

// The Lorentzian for one edge. Error: see docs/measured/accuracy.md, "phong peak fits".
real moment_lorentzian_front(MomentEdge edge, real n, int f_is_x) {
    MomentPeak p = moment_peak_prepare(edge, n, f_is_x);
    return moment_fit_front(edge, p, moment_fit_lorentzian(p), f_is_x);
}

// The blend of Lorentzian and Pearson VII for one edge.
real moment_pearson_front(MomentEdge edge, real n, int f_is_x) {
    MomentPeak p = moment_peak_prepare(edge, n, f_is_x);
    MomentFit fit = moment_fit_blended(p, moment_fit_lorentzian(p), moment_fit_pearson(p));
    return moment_fit_front(edge, p, fit, f_is_x);
}

// The blend of ellipsoid and squared ellipsoid for one edge.
real moment_ellipsoid_front(MomentEdge edge, real n, int f_is_x) {
    MomentPeak p = moment_peak_prepare(edge, n, f_is_x);
    MomentFit fit = moment_fit_blended(p, moment_fit_ellipsoid(edge, p), moment_fit_ellipsoid_squared(edge, p));
    return moment_fit_front(edge, p, fit, f_is_x);
}
