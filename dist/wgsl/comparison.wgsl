// Steradian 0.1.0, comparison: methods of the literature that ours are compared with, for WGSL.
//
// Put it before your module's text; it has no bindings.
// It needs these files before it, in this order: math.wgsl, polygon.wgsl, lobe.wgsl, phong.wgsl, ltc.wgsl.
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

// ==== ltc_clipless ====

// Linearly transformed cosines without clipping, for comparison: the light is taken for the sphere that has the same
// irradiance vector under M^-1, and the horizon cuts that. The real horizon is not looked at: light leaks from below.
// Source: Hill, Heitz, "Real-time area lighting: a journey from research to production", 2016.

// Form factor of a sphere above the horizon over that of the whole sphere towards its centre.
//
//   cosine   of the sphere's centre to z, in [-1, 1]
//   f        form factor of the whole sphere towards its centre: sine squared of its angular radius, in [0, 1]
//
// Degenerate: f = 0 gives max(cosine, 0).
// Source: Snyder, "Area light sources for real-time graphics", 1996, section 3.2.
fn steradian_ltc_clipped_sphere(cosine: f32, f: f32) -> f32 {
    let z = clamp(cosine, -1.0, 1.0);
    let s2 = clamp(f, 1.0e-12, 1.0);
    let sin_w = sqrt(max(1.0 - z * z, steradian_smallest_divisor()));
    let cos_s = sqrt(1.0 - s2);
    let crossed = z * z < s2;
    // The rim meets the horizon at the azimuth whose sine and cosine are x and y.
    let x = clamp(cos_s / sin_w, 0.0, 1.0);
    let y = sqrt(max(1.0 - x * x, 0.0));
    let root = sqrt(max(s2 - y * y, 0.0));
    let arc = steradian_trig_atan2(y, x) + x * y - 2.0 * sin_w * cos_s * y;
    let rim = abs(z) * (y * root + s2 * steradian_trig_atan2(y, root));
    let whole = steradian_pi() * s2 * max(z, 0.0);
    let cut = select(whole, whole + arc - rim, crossed);
    return clamp(cut / (steradian_pi() * s2), 0.0, 1.0);
}

// Adds one edge to the irradiance vector under M^-1 [rad].
//
//   ta, tb   steradian_ltc_direction of the edge's ends, in walk order
fn steradian_ltc_clipless_add_edge(sum: vec3f, ta: vec3f, tb: vec3f) -> vec3f {
    return sum + steradian_polygon_edge(ta, tb);
}

// Integral of the lobe over the light, approximately, in [0, 1].
//
//   sum      of steradian_ltc_clipless_add_edge, begun at zero
//   reversed true where the light is seen from behind
fn steradian_ltc_clipless_integral(sum: vec3f, reversed: bool) -> f32 {
    let e = sum * select(1.0, -1.0, reversed);
    let e2 = dot(e, e);
    let inverse = inverseSqrt(max(e2, steradian_smallest_square()));
    let form_factor = clamp(e2 * inverse * steradian_inverse_pi(), 0.0, 1.0);
    return form_factor * steradian_ltc_clipped_sphere(clamp(e.z * inverse, -1.0, 1.0), form_factor);
}

// ==== moment_arvo ====

// The Phong lobe's boundary integral by Arvo's recurrence: exact for integer n, in n/2 steps an edge.
//
// (1 - x^m)/(1 - x^2) is the finite sum of x^k over every other k below m: 1 + x^2 + ... for even m. For odd m one
// factor x is taken out first, (x - x^m)/(1 - x^2) = x + x^3 + ..., and the rest, 1/(1 + x), integrates to half the
// angle of a spherical triangle. Each power integrates by parts from the last but one.
// Source: Arvo 1995, sec. 5; Lecocq et al. 2017, eq. 1 to 3, with N = n - 1.

// |s| times the integral of 1/(1 + x) over the part in front: summed over a polygon, its solid angle.
fn steradian_moment_solid_angle_front(edge: SteradianMomentEdge) -> f32 {
    let c0 = edge.c + edge.x0;
    let c1 = edge.c + edge.x1;
    let k = edge.s / (1.0 + edge.c);
    return 2.0 * steradian_trig_atan2(k * (c0 * edge.y1 - c1 * edge.y0), c0 * c1 + k * k * edge.y0 * edge.y1);
}

// |s| times the integral of (1 - x^m)/(1 - x^2) over the part in front of one edge.
//
//   n        integer exponent, at least 1
//   can_stop 1: stop when what is left is below relative_precision of the sum; 0: sum everything. Every lane waits for
//            the slowest: at grazing views, where c is near 1, the stop comes late or never.
//
// Error: see docs/measured/accuracy.md, "phong recurrence"; the recurrence is stable, its factor is below c^2.
fn steradian_moment_arvo_front(edge: SteradianMomentEdge, n: i32, can_stop: i32, relative_precision: f32) -> f32 {
    let odd_m: i32 = 1 - (n - (n / 2) * 2);
    let c2 = edge.c * edge.c;
    let x02 = edge.x0 * edge.x0;
    let x12 = edge.x1 * edge.x1;
    // The integral of x^p, and x^(p+1) y at both ends, which the next step needs.
    var power = steradian_trig_atan2(edge.x0 * edge.y1 - edge.x1 * edge.y0, edge.x0 * edge.x1 + edge.y0 * edge.y1);
    var b0 = edge.x0 * edge.y0;
    var b1 = edge.x1 * edge.y1;
    var p = 2.0;
    var steps: i32 = (n - 1) / 2;
    if (odd_m == 1) {
        power = edge.y1 - edge.y0;
        b0 = x02 * edge.y0;
        b1 = x12 * edge.y1;
        p = 3.0;
        steps = n / 2 - 1;
    }
    var sum = power;
    let left = relative_precision * (1.0 - c2);
    for (var i: i32 = 0; i < steps; i++) {
        power = (b1 - b0 + (p - 1.0) * c2 * power) / p;
        b0 = b0 * x02;
        b1 = b1 * x12;
        p = p + 2.0;
        sum = sum + power;
        // The terms fall by c^2 or more: those left sum to less than power c^2 / (1 - c^2).
        if (can_stop == 1) {
            if (power * c2 <= sum * left) {
                break;
            }
        }
    }
    var front = edge.s * sum;
    if (odd_m == 1) {
        front = front + steradian_moment_solid_angle_front(edge);
    }
    return max(front, 0.0);
}

// ==== moment_peak_fits ====

// The published peak fits of the Phong lobe's boundary integrand: Lorentzian, Lorentzian-Pearson, ellipsoid.
//
// The integrand I = (f - x^m)/(1 - x^2) is a peak over phi with its foot at 0, f = x or f = 1: the paper takes x for even n
// and 1 otherwise, but each serves every n.
// Each fit is a peak P with an antiderivative, scaled to I's largest and smallest value and to its value at the half
// width x_w; the blends also meet I at a place in the tail. For comparison with moment_series.glsl, which is both
// faster and closer. Corrected against the paper where its prints do not hold (docs/theory/moments.md lists the places).
// Source: Lecocq, Dufay, Sourimant, Marvie, "Analytic approximations for real-time area light shading", 2017,
// eq. 5 to 16; its order N is n - 1 here.

// The values that the fits share for one edge.
//   x_w, x_t     half width and the place in the tail [rad]
//   ratio_w      x_w over its limit for c -> 0
//   peak         I at the foot, less its smallest value
//   y_w, y_t     the same at x_w and x_t, over peak
//   smallest     I at phi = pi/2: 0 for f = x, 1 for f = 1
//   phi0, phi1   ends of the part in front [rad]
struct SteradianMomentPeak {
    x_w: f32,
    x_t: f32,
    ratio_w: f32,
    peak: f32,
    y_w: f32,
    y_t: f32,
    smallest: f32,
    phi0: f32,
    phi1: f32,
}

// Cosine for |x| <= pi/2: Taylor, the next term is x^16/16!, 7e-11 at pi/2.
fn steradian_moment_peak_cosine(x: f32) -> f32 {
    let t = x * x;
    return 1.0 - t / 2.0 * (1.0 - t / 12.0 * (1.0 - t / 30.0 * (1.0 - t / 56.0 * (1.0 - t / 90.0 * (1.0 - t / 132.0 * (1.0 - t / 182.0))))));
}

// Sine for |x| <= pi/2: Taylor, the next term is x^15/15!, 7e-10 at pi/2.
fn steradian_moment_peak_sine(x: f32) -> f32 {
    let t = x * x;
    return x * (1.0 - t / 6.0 * (1.0 - t / 20.0 * (1.0 - t / 42.0 * (1.0 - t / 72.0 * (1.0 - t / 110.0 * (1.0 - t / 156.0))))));
}

// I less its smallest value, at x = c cos phi. f = x: x (1 - x^n)/(1 - x^2); f = 1: x^2 (1 - x^(n-1))/(1 - x^2).
//
//   f_is_x   1 for f = x, 0 for f = 1
fn steradian_moment_peak_height(s2: f32, c2: f32, n: f32, f_is_x: i32, cosine: f32, sine: f32) -> f32 {
    let rest = s2 + c2 * sine * sine;  // 1 - x^2 without cancellation
    let x2 = max(c2 * cosine * cosine, 1.0e-12);
    let log_x = 0.5 * steradian_moment_log_1_plus(rest / x2);
    if (f_is_x == 1) {
        return sqrt(x2) * steradian_moment_1_minus_exp(n * log_x) / rest;
    }
    return x2 * steradian_moment_1_minus_exp((n - 1.0) * log_x) / rest;
}

// The half width by the paper's fit, over its limit for c -> 0 (pi/3 for f = x, pi/4 for f = 1).
//
// Error: up to 17 % (f = x) and 32 % (f = 1, n = 5000), 4 to 8 % on the average.
// Source: eq. 7, with pi/4 outside the power.
fn steradian_moment_peak_half_width_ratio(c: f32, n: f32, f_is_x: i32) -> f32 {
    if (f_is_x == 1) {
        let reduced = c - c / max(n - 1.0, 1.0);
        return sqrt(max(1.0 - reduced * reduced, 1.0e-8));
    }
    let k = max(c - c / max(n - 2.0, 1.0), 1.0e-6);
    return steradian_phong_power(max(1.0 - steradian_phong_power(k, 2.5), 1.0e-8), 0.45);
}

// The values that the fits share for one edge and a lobe of exponent n.
fn steradian_moment_peak_prepare(edge: SteradianMomentEdge, n: f32, f_is_x: i32) -> SteradianMomentPeak {
    let s2 = edge.s * edge.s;
    let c2 = edge.c * edge.c;
    var widest = 0.785398163397448310;
    var p: SteradianMomentPeak;
    p.smallest = 1.0;
    if (f_is_x == 1) {
        widest = 1.04719755119659775;
        p.smallest = 0.0;
    }
    p.ratio_w = steradian_moment_peak_half_width_ratio(edge.c, n, f_is_x);
    p.x_w = widest * p.ratio_w;
    let k = 1.0 - p.ratio_w;  // eq. 14: its twelfth power
    let k2 = k * k;
    let k4 = k2 * k2;
    p.x_t = min(p.x_w + 0.3946 * widest * (1.0 - k4 * k4 * k4), 1.57079632679489662);
    p.peak = steradian_moment_peak_height(s2, c2, n, f_is_x, 1.0, 0.0);
    let scale = 1.0 / max(p.peak, 1.0e-12);
    p.y_w = scale * steradian_moment_peak_height(s2, c2, n, f_is_x, steradian_moment_peak_cosine(p.x_w), steradian_moment_peak_sine(p.x_w));
    p.y_t = scale * steradian_moment_peak_height(s2, c2, n, f_is_x, steradian_moment_peak_cosine(p.x_t), steradian_moment_peak_sine(p.x_t));
    p.y_w = clamp(p.y_w, 0.01, 0.99);
    p.phi0 = steradian_trig_atan2(edge.y0, edge.x0);
    p.phi1 = steradian_trig_atan2(edge.y1, edge.x1);
    return p;
}

// A peak scaled to 1 at the foot and 0 at pi/2.
//   integral  over the part in front
//   tail      its value at x_t
struct SteradianMomentFit {
    integral: f32,
    tail: f32,
}

// The scaled peak from a peak's integral, its value at the tail's place and its value at pi/2; at the foot it is 1.
fn steradian_moment_fit_scaled(p: SteradianMomentPeak, integral: f32, tail: f32, lowest: f32) -> SteradianMomentFit {
    let scale = 1.0 / (1.0 - lowest);
    var fit: SteradianMomentFit;
    fit.integral = scale * (integral - lowest * (p.phi1 - p.phi0));
    fit.tail = scale * (tail - lowest);
    return fit;
}

// Width parameter of the Lorentzian. Source: eq. 11. Kept above 1.0e-3, where the scaled peak is its limit.
fn steradian_moment_lorentzian_width(p: SteradianMomentPeak) -> f32 {
    let x2 = p.x_w * p.x_w;
    return max((1.0 - p.y_w - 0.405284734569351086 * x2) / (p.y_w * x2), 1.0e-3);
}

// The Lorentzian peak 1/(1 + a phi^2). Source: eq. 11 and 12.
fn steradian_moment_fit_lorentzian(p: SteradianMomentPeak) -> SteradianMomentFit {
    let a = steradian_moment_lorentzian_width(p);
    let root = sqrt(a);
    let integral = steradian_trig_atan2(root * (p.phi1 - p.phi0), 1.0 + a * p.phi0 * p.phi1) / root;
    return steradian_moment_fit_scaled(p, integral, 1.0 / (1.0 + a * p.x_t * p.x_t), 1.0 / (1.0 + a * 2.46740110027233966));
}

// The peak of Pearson VII: (1 + b phi^2)^-2 with b = a/2.
fn steradian_moment_fit_pearson(p: SteradianMomentPeak) -> SteradianMomentFit {
    let b = 0.5 * steradian_moment_lorentzian_width(p);
    let root = sqrt(b);
    let angle = steradian_trig_atan2(root * (p.phi1 - p.phi0), 1.0 + b * p.phi0 * p.phi1);
    let ends = p.phi1 / (1.0 + b * p.phi1 * p.phi1) - p.phi0 / (1.0 + b * p.phi0 * p.phi0);
    let t = 1.0 / (1.0 + b * p.x_t * p.x_t);
    let l = 1.0 / (1.0 + b * 2.46740110027233966);
    return steradian_moment_fit_scaled(p, 0.5 * (ends + angle / root), t * t, l * l);
}

// A width of exactly 1 is a constant peak, 0/0 when scaled: kept 4e-3 away.
fn steradian_moment_fit_not_one(a: f32) -> f32 {
    return select(a, 1.004, abs(a - 1.0) < 0.004);
}

// Width parameter of the ellipsoid. Source: eq. 15.
fn steradian_moment_ellipsoid_width(p: SteradianMomentPeak) -> f32 {
    let cosine = steradian_moment_peak_cosine(p.x_w);
    let sine = steradian_moment_peak_sine(p.x_w);
    return p.y_w * sine * sine / (cosine * cosine * (1.0 - p.y_w));
}

// The ellipsoid peak a/(1 + (a - 1) cos^2 phi). Source: eq. 15 and 16.
fn steradian_moment_fit_ellipsoid(edge: SteradianMomentEdge, p: SteradianMomentPeak) -> SteradianMomentFit {
    let a = steradian_moment_fit_not_one(steradian_moment_ellipsoid_width(p));
    let root = sqrt(a);
    let cosine = steradian_moment_peak_cosine(p.x_t);
    let integral = root * steradian_moment_angle(root, edge.x0, edge.y0, edge.x1, edge.y1);
    return steradian_moment_fit_scaled(p, integral, a / (1.0 + (a - 1.0) * cosine * cosine), a);
}

// The squared ellipsoid peak (b/(1 + (b - 1) cos^2 phi))^2.
fn steradian_moment_fit_ellipsoid_squared(edge: SteradianMomentEdge, p: SteradianMomentPeak) -> SteradianMomentFit {
    let b = steradian_moment_fit_not_one(steradian_moment_ellipsoid_width(p) * (2.1 + 1.28 * p.ratio_w));
    let root = sqrt(b);
    let cosine = steradian_moment_peak_cosine(p.x_t);
    let e0 = edge.x0 * edge.y0 / max(b * edge.x0 * edge.x0 + edge.y0 * edge.y0, steradian_smallest_divisor());
    let e1 = edge.x1 * edge.y1 / max(b * edge.x1 * edge.x1 + edge.y1 * edge.y1, steradian_smallest_divisor());
    let angle = steradian_moment_angle(root, edge.x0, edge.y0, edge.x1, edge.y1);
    let integral = 0.5 * root * (b + 1.0) * angle - 0.5 * b * (b - 1.0) * (e1 - e0);
    let t = b / (1.0 + (b - 1.0) * cosine * cosine);
    return steradian_moment_fit_scaled(p, integral, t * t, b * b);
}

// Blend of a peak with too heavy a tail and one with too light a tail, so that the blend meets I in the tail.
//
// Source: eq. 13, clamped: its denominator vanishes where the two meet.
fn steradian_moment_fit_blended(p: SteradianMomentPeak, heavy: SteradianMomentFit, light: SteradianMomentFit) -> SteradianMomentFit {
    let d = light.tail - heavy.tail;
    var alpha = (light.tail - p.y_t) / select(max(d, 1.0e-12), min(d, -1.0e-12), d < 0.0);
    alpha = clamp(alpha, 0.0, 1.0);
    var fit: SteradianMomentFit;
    fit.integral = alpha * heavy.integral + (1.0 - alpha) * light.integral;
    fit.tail = alpha * heavy.tail + (1.0 - alpha) * light.tail;
    return fit;
}

// |s| times the integral of (1 - x^m)/(1 - x^2) over the part in front, from a fit.
//
// Degenerate: a peak below 1e-12 (n = 1) leaves the smallest value alone.
fn steradian_moment_fit_front(edge: SteradianMomentEdge, p: SteradianMomentPeak, fit: SteradianMomentFit, f_is_x: i32) -> f32 {
    let peak = select(0.0, p.peak * fit.integral, p.peak > 1.0e-12);
    var front = edge.s * (peak + p.smallest * (p.phi1 - p.phi0));
    if (f_is_x == 1) {
        front = front + steradian_moment_solid_angle_front(edge);
    }
    return max(front, 0.0);
}

// The Lorentzian for one edge. Error: see docs/measured/accuracy.md, "phong peak fits".
fn steradian_moment_lorentzian_front(edge: SteradianMomentEdge, n: f32, f_is_x: i32) -> f32 {
    let p = steradian_moment_peak_prepare(edge, n, f_is_x);
    return steradian_moment_fit_front(edge, p, steradian_moment_fit_lorentzian(p), f_is_x);
}

// The blend of Lorentzian and Pearson VII for one edge.
fn steradian_moment_pearson_front(edge: SteradianMomentEdge, n: f32, f_is_x: i32) -> f32 {
    let p = steradian_moment_peak_prepare(edge, n, f_is_x);
    let fit = steradian_moment_fit_blended(p, steradian_moment_fit_lorentzian(p), steradian_moment_fit_pearson(p));
    return steradian_moment_fit_front(edge, p, fit, f_is_x);
}

// The blend of ellipsoid and squared ellipsoid for one edge.
fn steradian_moment_ellipsoid_front(edge: SteradianMomentEdge, n: f32, f_is_x: i32) -> f32 {
    let p = steradian_moment_peak_prepare(edge, n, f_is_x);
    let fit = steradian_moment_fit_blended(p, steradian_moment_fit_ellipsoid(edge, p), steradian_moment_fit_ellipsoid_squared(edge, p));
    return steradian_moment_fit_front(edge, p, fit, f_is_x);
}

// ==== representative_point ====

// The representative point of a polygon light, for comparison: all of its light from the direction that is nearest to
// the mirror direction, on a lobe widened to make up for it.
//
// Assumes that the light is small against the lobe, or the lobe against the light; between the two it is off by a third and more.
//   1. The light is a point light of the light's solid angle, in the direction nearest to the mirror's.
//   2. The lobe's peak falls by (alpha/alpha')^2, alpha' = alpha + radius/(2 distance). A sphere of that radius and distance
//      has the solid angle W = pi (radius/distance)^2; of half vectors it covers W/(4 v.h), a disk of radius sqrt(W/(4 pi v.h)),
//      which at the normal is radius/(2 distance). The factor 1/sqrt(v.h) is not in the source: without it a mirror that
//      sees the light sends 1/v.h times the light's radiance, 14 times at 86 degrees.
// Walk the outline clipped to the horizon (horizon_clip.glsl).
// Source: Karis, "Real shading in Unreal Engine 4", 2013, section "Area lights", its sphere taken to a polygon. The half
// radius: its alpha' with the factor 2 at which a mirror (alpha = 0) sends the radiance of the light it sees.

// The state of a walk.
//   turn     how far the outline has turned about the mirror direction [rad]: two pi at the end where that is inside,
//            minus two pi where its opposite is, else zero; the other sign where the light is seen from behind
//   nearest  direction on the outline nearest to it
//   cosine   between the two
struct SteradianRepresentativeWalk {
    turn: f32,
    nearest: vec3f,
    cosine: f32,
}

// A walk with no edge yet.
fn steradian_representative_begin() -> SteradianRepresentativeWalk {
    var walk: SteradianRepresentativeWalk;
    walk.turn = 0.0;
    walk.nearest = vec3f(0.0, 0.0, 1.0);
    walk.cosine = -2.0;  // below any cosine, so that the first edge counts
    return walk;
}

// Adds one edge.
//
//   mirror   unit: the view mirrored at the normal
//   a, b     unit directions of the edge's ends
fn steradian_representative_add_edge(walk: SteradianRepresentativeWalk, mirror: vec3f, a: vec3f, b: vec3f) -> SteradianRepresentativeWalk {
    var next = walk;
    let ca = dot(mirror, a);
    let cb = dot(mirror, b);
    next.turn = walk.turn + steradian_trig_atan2(dot(mirror, cross(a, b)), dot(a, b) - ca * cb);
    // The nearest of the great circle, if it lies between the ends.
    let n = cross(a, b);
    let n2 = max(dot(n, n), steradian_smallest_divisor());
    let p = mirror - n * (dot(mirror, n) / n2);
    let on_circle = p * inverseSqrt(max(dot(p, p), steradian_smallest_divisor()));
    let between = dot(cross(a, p), n) > 0.0 && dot(cross(p, b), n) > 0.0;
    let nearest = select(select(b, a, ca > cb), on_circle, between);
    let cosine = dot(mirror, nearest);
    let better = cosine > walk.cosine;
    next.nearest = select(walk.nearest, nearest, better);
    next.cosine = select(walk.cosine, cosine, better);
    return next;
}

// The direction that stands for the light: the mirror direction if the light holds it, else the nearest of the outline.
fn steradian_representative_direction(walk: SteradianRepresentativeWalk, mirror: vec3f, reversed: bool) -> vec3f {
    let turn = select(walk.turn, -walk.turn, reversed);
    return select(walk.nearest, mirror, turn > steradian_pi());
}

// Radiance towards the view, per radiance of the light, without Fresnel.
//
//   view, mirror  unit, in the shading frame
//   solid_angle   of the light's part above the horizon [sr]
//   alpha         of the GGX lobe
//   reversed      true where the light is seen from behind
//
// Degenerate: 0 where the representative direction is below the horizon. For a mirror inside the light: at most 1, and
// towards alpha = 0 it is 1.
// Error: see docs/measured/accuracy.md, "GGX with shadowing and Fresnel".
fn steradian_representative_radiance(walk: SteradianRepresentativeWalk, view: vec3f, mirror: vec3f, solid_angle: f32, alpha: f32, reversed: bool) -> f32 {
    let l = steradian_representative_direction(walk, mirror, reversed);
    let h = steradian_microfacet_half_vector(l, view);
    let wider = alpha + sqrt(solid_angle * 0.0795774715459476679 / max(dot(view, h), 1.0e-6));
    let fall = alpha / wider;
    return steradian_ggx_lobe(l, view, alpha, alpha) * (fall * fall) * solid_angle;
}

// The half vector's cosine for Fresnel. Arguments as for steradian_representative_radiance.
fn steradian_representative_v_dot_h(walk: SteradianRepresentativeWalk, view: vec3f, mirror: vec3f, reversed: bool) -> f32 {
    let h = steradian_microfacet_half_vector(steradian_representative_direction(walk, mirror, reversed), view);
    return dot(view, h);
}
