// Steradian 0.1.0, phong: Phong's lobe over polygons, exactly and by a series, for GLSL 4.50.
//
// Paste after #version and your own declarations.
// It needs these files before it, in this order: math.glsl, lobe.glsl.
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

// ==== moment ====

// Axial moments of spherical polygons: the integral of max(u.r, 0)^n over a light, for the Phong lobe about r.
//
// With m = n + 1, theta the angle from r and psi the azimuth about r,
//     m * moment = closed integral over the outline of (1 - max(cos theta, 0)^m) dpsi
// for any real n > -1, as long as -r is not inside (docs/theory/moments.md derives it). No parity of n, no solid angle, no
// vertices on the lobe's equator. On an edge, phi is the angle along its great circle from the foot, the point
// nearest to r, where u.r = c; s = sin of the angle from r to the circle's plane; x = u.r = c cos phi and
// y = c sin phi. The edge's share is
//     sign(s) * ( |s| * integral of (1 - x^m)/(1 - x^2) dphi  over the part in front of the lobe's equator
//                 + the azimuth that the part behind sweeps ).
// steradian_moment_edge finds what every method shares; the methods, a file each, integrate the part in front.
//
// Frame: any; r is the unit axis. Edges in walk order (kernels/outline/polygon.glsl), clipped to the surface's horizon
// (kernels/outline/horizon_clip.glsl) before, so that -r cannot be inside a light.
// Source: Arvo, "Applications of irradiance tensors to the simulation of non-Lambertian phenomena", 1995; Lecocq,
// Dufay, Sourimant, Marvie, "Analytic approximations for real-time area light shading", 2017. The form without
// parity is this project's own.

// One edge, seen from the lobe's axis.
//   side            sign of s, +1 or -1; 0 for an edge without length
//   s, c            |s| and the cosine that belongs to it
//   x0, y0, x1, y1  the ends of the part in front, (c cos phi, c sin phi); equal where there is none
//   log_c           -log(c^2), accurate for c near 1
//   swept           azimuth that the part behind sweeps, positive [rad]
struct SteradianMomentEdge {
    float side;
    float s;
    float c;
    float x0;
    float y0;
    float x1;
    float y1;
    float log_c;
    float swept;
};

// log(1 + z) for z >= 0. Error: relative 3e-7 in float, 1e-13 in double.
float steradian_moment_log_1_plus(float z) {
    float near = 0.25;
    // Twice the inverse hyperbolic tangent of t; the next term is t^10 / 11.
    float t = z / (2.0 + z);
    float t2 = t * t;
    float series = 2.0 * t * (1.0 + t2 * (0.333333333333333333 + t2 * (0.2 + t2 * (0.142857142857142857 + t2 * 0.111111111111111111))));
    return steradian_select(z < near, series, log(1.0 + z));
}

// 1 - exp(-x) for x >= 0. Error: relative 3e-7 in float, 1e-13 in double.
float steradian_moment_1_minus_exp(float x) {
    float near = 0.25;
    float result = 1.0 - exp(-x);
    bool small = x < near;
    if (small) {
        // Taylor, nested; the next term is x^6 / 5040.
        float series = x * (1.0 - 0.5 * x * (1.0 - 0.333333333333333333 * x * (1.0 - 0.25 * x * (1.0 - 0.2 * x * (1.0 - 0.166666666666666667 * x)))));
        result = steradian_select(small, series, result);
    }
    return result;
}

// Angle in [0, pi] from the direction (w x0, y0) to (w x1, y1): the definite integral of atan(tan(phi) / w).
float steradian_moment_angle(float w, float x0, float y0, float x1, float y1) {
    return steradian_trig_atan2_unwrapped(w * (x0 * y1 - x1 * y0), w * w * x0 * x1 + y0 * y1);
}

// -log(1 - s2), from s2 where it is small and from c2 = 1 - s2 where that is. Error: relative 3e-6 in float, 1e-13.
float steradian_moment_minus_log_cosine2(float s2, float c2) {
    float near = 0.05;
    float result = -log(c2);
    bool small = s2 < near;
    if (small) {
        // Taylor; the next term is s2^7 / 7.
        float series = s2 * (1.0 + s2 * (0.5 + s2 * (0.333333333333333333 + s2 * (0.25 + s2 * (0.2 + s2 * 0.166666666666666667)))));
        result = steradian_select(small, series, result);
    }
    return result;
}

// Prepares one edge.
//
//   a, b     unit directions of the edge's ends, in walk order
//   r        unit axis of the lobe
//
// Degenerate: a = b, a = -b or a zero vector gives an edge that adds nothing. An axis within 1e-3 of the normal of
// the edge's plane sees the whole edge near its equator, where the integrand is 1: all of it counts as swept.
SteradianMomentEdge steradian_moment_edge(vec3 a, vec3 b, vec3 r) {
    float pole2 = 1.0e-6;
    vec3 n = cross(a, b - a);  // of a short edge, too, with all its digits
    float n2 = dot(n, n);
    bool has_length = n2 > steradian_smallest_divisor();
    n = n * inversesqrt(max(n2, steradian_smallest_divisor()));
    float s = dot(n, r);
    vec3 q = cross(n, r);
    // The share vanishes with s, like s sqrt(n/2) in the highlight: a floor of 1e-10 would show there.
    float s2 = clamp(s * s, steradian_smallest_divisor(), 1.0);
    float c2 = clamp(dot(q, q), pole2, 1.0);

    SteradianMomentEdge edge;
    edge.side = steradian_select(has_length, steradian_select(s < 0.0, -1.0, 1.0), 0.0);
    edge.s = s2 * inversesqrt(s2);
    edge.c = c2 * inversesqrt(c2);
    edge.log_c = steradian_moment_minus_log_cosine2(s2, c2);
    float x0 = dot(a, r);
    float y0 = dot(a, q);
    float x1 = dot(b, r);
    float y1 = dot(b, q);
    edge.x0 = x0;
    edge.y0 = y0;
    edge.x1 = x1;
    edge.y1 = y1;
    edge.swept = 0.0;
    bool behind0 = x0 <= 0.0;
    bool behind1 = x1 <= 0.0;
    bool pole = x0 * x0 + y0 * y0 < pole2;
    if (behind0 || behind1 || pole) {
        // The lobe's equator cuts the circle at phi = -pi/2 and pi/2.
        bool none = (behind0 && behind1) || pole;
        edge.x0 = steradian_select(behind0 || none, 0.0, x0);
        edge.y0 = steradian_select(none, edge.c, steradian_select(behind0, -edge.c, y0));
        edge.x1 = steradian_select(behind1 || none, 0.0, x1);
        edge.y1 = steradian_select(behind1 || none, edge.c, y1);
        float whole = steradian_moment_angle(edge.s, x0, y0, x1, y1);
        float in_front = steradian_moment_angle(edge.s, edge.x0, edge.y0, edge.x1, edge.y1);
        float swept = steradian_select(none, whole, max(whole - in_front, 0.0));
        if (pole) {
            float arc = steradian_trig_atan2(sqrt(n2), dot(a, b));
            swept = steradian_select(pole, arc, swept);
        }
        edge.swept = steradian_select(behind0 || behind1 || pole, swept, 0.0);
    }
    return edge;
}

// The edge's share of m times the moment.
//
//   front    |s| times the integral of (1 - x^m)/(1 - x^2) over the part in front, by any method
float steradian_moment_edge_share(SteradianMomentEdge edge, float front) {
    return edge.side * (front + edge.swept);
}

// Radiance of an energy-normalised Phong lobe of albedo 1 under radiance 1, in [0, 1].
//
//   sum      of the edges' shares
//   reversed true where the light is seen from behind, so that the walk ran the wrong way round
//
// Source: Lecocq et al. 2017, eq. 10: (n + 1)/(2 pi) times the moment; without foreshortening.
float steradian_moment_phong_radiance(float sum, bool reversed) {
    return clamp(steradian_select(reversed, -sum, sum) * steradian_inverse_two_pi(), 0.0, 1.0);
}

// ==== moment_quadrature ====

// The Phong lobe's boundary integral by Gauss-Legendre quadrature in the ellipsoid's angle u (moment_series.glsl).
//
// The reference for the methods in constant time: exact up to quadrature, any real n > -1. The library's exact form
// subdivides steradian_moment_quadrature_piece until it converges (source/integrals/phong/exact_moment.cpp); steradian_moment_quadrature_front
// is the fixed rule, 14 nodes for each side of the foot.
// The variable of integration is t = tan(u/2), in [-1, 1] in front: no trigonometry.
// Source: this project (docs/theory/moments.md); nodes: roots of the Legendre polynomial of degree 14.

// The values that the integrand needs from an edge and a lobe.
//   t0, t1   ends of the part in front
struct SteradianMomentQuadrature {
    float m;
    float s2;
    float c2;
    float kap;
    float w;
    float t0;
    float t1;
};

// The parameter t = tan(u/2) of the direction (w x, y), x >= 0, whose angle is u.
float steradian_moment_quadrature_parameter(float w, float x, float y) {
    float wx = w * x;
    return clamp(y / max(wx + sqrt(wx * wx + y * y), steradian_smallest_length()), -1.0, 1.0);
}

// Prepares the integrand of one edge for a lobe of exponent n.
SteradianMomentQuadrature steradian_moment_quadrature_prepare(SteradianMomentEdge edge, float n) {
    SteradianMomentQuadrature q;
    q.m = n + 1.0;
    q.s2 = edge.s * edge.s;
    q.c2 = edge.c * edge.c;
    q.kap = sqrt(steradian_moment_1_minus_exp(0.5 * q.m * edge.log_c));
    q.w = edge.s / q.kap;
    q.t0 = steradian_moment_quadrature_parameter(q.w, edge.x0, edge.y0);
    q.t1 = steradian_moment_quadrature_parameter(q.w, edge.x1, edge.y1);
    return q;
}

// Both integrands at t, with du/dt included.
//   moment   |s| (1 - x^m)/(1 - x^2) dphi = kap E du, E = w^2 (1 - x^m)/Q, Q = s^2 cos^2 u + w^2 sin^2 u
//   power    x^m dphi
struct SteradianMomentIntegrands {
    float moment;
    float power;
};

// The integrands at one t.
SteradianMomentIntegrands steradian_moment_quadrature_integrands(SteradianMomentQuadrature q, float t) {
    float t2 = t * t;
    float d = 1.0 / (1.0 + t2);
    float cos_u = max((1.0 - t2) * d, 1.0e-15);
    float sin_u = 2.0 * t * d;
    float cos2 = cos_u * cos_u;
    float wsin2 = q.w * q.w * sin_u * sin_u;
    float Q = q.s2 * cos2 + wsin2;
    float exponent = 0.5 * q.m * steradian_moment_log_1_plus(Q / (q.c2 * cos2));  // -log(x^m)
    SteradianMomentIntegrands result;
    result.moment = 2.0 * d * q.kap * q.w * q.w * steradian_moment_1_minus_exp(exponent) / Q;
    result.power = 2.0 * d * q.w * exp(-exponent) / (cos2 + wsin2);
    return result;
}

// Adds one pair of nodes at mid - offset and mid + offset.
SteradianMomentIntegrands steradian_moment_quadrature_pair(SteradianMomentIntegrands sum, SteradianMomentQuadrature q, float mid, float offset, float weight) {
    SteradianMomentIntegrands a = steradian_moment_quadrature_integrands(q, mid - offset);
    SteradianMomentIntegrands b = steradian_moment_quadrature_integrands(q, mid + offset);
    SteradianMomentIntegrands next;
    next.moment = sum.moment + weight * (a.moment + b.moment);
    next.power = sum.power + weight * (a.power + b.power);
    return next;
}

// Both integrals from t = low to t = high.
SteradianMomentIntegrands steradian_moment_quadrature_piece(SteradianMomentQuadrature q, float low, float high) {
    float mid = 0.5 * (low + high);
    float h = 0.5 * (high - low);
    SteradianMomentIntegrands sum;
    sum.moment = 0.0;
    sum.power = 0.0;
    sum = steradian_moment_quadrature_pair(sum, q, mid, h * 0.986283808696812339, h * 0.035119460331751863);
    sum = steradian_moment_quadrature_pair(sum, q, mid, h * 0.928434883663573517, h * 0.080158087159760210);
    sum = steradian_moment_quadrature_pair(sum, q, mid, h * 0.827201315069764993, h * 0.121518570687903185);
    sum = steradian_moment_quadrature_pair(sum, q, mid, h * 0.687292904811685470, h * 0.157203167158193535);
    sum = steradian_moment_quadrature_pair(sum, q, mid, h * 0.515248636358154092, h * 0.185538397477937814);
    sum = steradian_moment_quadrature_pair(sum, q, mid, h * 0.319112368927889760, h * 0.205198463721295604);
    sum = steradian_moment_quadrature_pair(sum, q, mid, h * 0.108054948707343662, h * 0.215263853463157790);
    return sum;
}

// Both integrals over the part in front of an edge.
//   moment   |s| times the integral of (1 - x^m)/(1 - x^2) dphi, m = n + 1
//   power    the integral of x^m dphi
//
// Error: see docs/measured/accuracy.md, "phong quadrature".
SteradianMomentIntegrands steradian_moment_quadrature_front(SteradianMomentEdge edge, float n) {
    SteradianMomentQuadrature q = steradian_moment_quadrature_prepare(edge, n);
    SteradianMomentIntegrands to0 = steradian_moment_quadrature_piece(q, 0.0, q.t0);
    SteradianMomentIntegrands to1 = steradian_moment_quadrature_piece(q, 0.0, q.t1);
    SteradianMomentIntegrands result;
    result.moment = max(to1.moment - to0.moment, 0.0);
    result.power = max(to1.power - to0.power, 0.0);
    return result;
}

// ==== moment_series ====

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

// A lobe's series: amplitude of harmonic k is (1 - kap2) times a cubic in kap2, constant first.
struct SteradianMomentSeries {
    float m;
    vec4 b0;
    vec4 b1;
    vec4 b2;
    vec4 b3;
};

// The series of high quality: two harmonics more, each a quintic; low holds its first three coefficients.
struct SteradianMomentSeriesHigh {
    float m;
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
SteradianMomentSeries steradian_moment_series_prepare(float n) {
    float g = 1.0 / (n + 1.0);
    SteradianMomentSeries series;
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
SteradianMomentSeriesHigh steradian_moment_series_high_prepare(float n) {
    float g = 1.0 / (n + 1.0);
    SteradianMomentSeriesHigh series;
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
float steradian_moment_series_cubic(vec4 b, float t) {
    return ((b.w * t + b.z) * t + b.y) * t + b.x;
}

// A harmonic's amplitude over 1 - kap2 in high quality, at t = kap2.
float steradian_moment_series_quintic(vec3 low, vec3 high, float t) {
    return ((((high.z * t + high.y) * t + high.x) * t + low.z) * t + low.y) * t + low.x;
}

// The part in front in the ellipsoid's own angle.
//   kap, kap2  of the ellipsoid
//   du         angle from end to end [rad]
//   cosine     twice the cosine of 2u at end 0 and end 1
//   sine       the sine of 2u
struct SteradianMomentWarp {
    float kap;
    float kap2;
    float du;
    vec2 cosine;
    vec2 sine;
};

// Finds the ellipsoid of one edge for a lobe of exponent m - 1.
SteradianMomentWarp steradian_moment_warp(SteradianMomentEdge edge, float m) {
    SteradianMomentWarp warp;
    warp.kap2 = steradian_moment_1_minus_exp(0.5 * m * edge.log_c);
    float over_kap = inversesqrt(warp.kap2);
    warp.kap = warp.kap2 * over_kap;
    float w = edge.s * over_kap;
    float wx0 = w * edge.x0;
    float wx1 = w * edge.x1;
    warp.du = steradian_trig_atan2_unwrapped(wx0 * edge.y1 - wx1 * edge.y0, wx0 * wx1 + edge.y0 * edge.y1);
    // One division for both ends: they are at least c^2 w^2, 1e-10 where the pole begins.
    float d0 = wx0 * wx0 + edge.y0 * edge.y0;
    float d1 = wx1 * wx1 + edge.y1 * edge.y1;
    float over_both = 2.0 / max(d0 * d1, steradian_smallest_divisor());
    float scale0 = over_both * d1;
    float scale1 = over_both * d0;
    warp.cosine = vec2(scale0 * (wx0 * wx0 - edge.y0 * edge.y0), scale1 * (wx1 * wx1 - edge.y1 * edge.y1));
    warp.sine = vec2(scale0 * wx0 * edge.y0, scale1 * wx1 * edge.y1);
    return warp;
}

// |s| times the integral of (1 - x^m)/(1 - x^2) over the part in front of one edge.
//
//   edge     by steradian_moment_edge
//   series   by steradian_moment_series_prepare, n >= 1
//
// Error: see docs/measured/accuracy.md, "phong series": 3e-4 of the full lobe's 2 pi for each side of the foot.
float steradian_moment_series_front(SteradianMomentEdge edge, SteradianMomentSeries series) {
    SteradianMomentWarp warp = steradian_moment_warp(edge, series.m);
    float t = warp.kap2;
    // sin(2(k + 1)u) = 2 cos(2u) sin(2ku) - sin(2(k - 1)u), at both ends.
    vec2 s1 = warp.sine;
    vec2 s2 = vec2(warp.cosine.x * s1.x, warp.cosine.y * s1.y);
    vec2 s3 = vec2(warp.cosine.x * s2.x - s1.x, warp.cosine.y * s2.y - s1.y);
    float bump = steradian_moment_series_cubic(series.b0, t) * warp.du
              + steradian_moment_series_cubic(series.b1, t) * (s1.y - s1.x) * 0.5
              + steradian_moment_series_cubic(series.b2, t) * (s2.y - s2.x) * 0.25
              + steradian_moment_series_cubic(series.b3, t) * (s3.y - s3.x) * 0.166666666666666667;
    return max(warp.kap * (warp.du + (1.0 - t) * bump), 0.0);
}

// The result of steradian_moment_series_front, in high quality. Error: about 5e-5 of the full lobe for each side of the foot.
float steradian_moment_series_high_front(SteradianMomentEdge edge, SteradianMomentSeriesHigh series) {
    SteradianMomentWarp warp = steradian_moment_warp(edge, series.m);
    float t = warp.kap2;
    vec2 s1 = warp.sine;
    vec2 s2 = vec2(warp.cosine.x * s1.x, warp.cosine.y * s1.y);
    vec2 s3 = vec2(warp.cosine.x * s2.x - s1.x, warp.cosine.y * s2.y - s1.y);
    vec2 s4 = vec2(warp.cosine.x * s3.x - s2.x, warp.cosine.y * s3.y - s2.y);
    vec2 s5 = vec2(warp.cosine.x * s4.x - s3.x, warp.cosine.y * s4.y - s3.y);
    float bump = steradian_moment_series_quintic(series.low0, series.high0, t) * warp.du
              + steradian_moment_series_quintic(series.low1, series.high1, t) * (s1.y - s1.x) * 0.5
              + steradian_moment_series_quintic(series.low2, series.high2, t) * (s2.y - s2.x) * 0.25
              + steradian_moment_series_quintic(series.low3, series.high3, t) * (s3.y - s3.x) * 0.166666666666666667
              + steradian_moment_series_quintic(series.low4, series.high4, t) * (s4.y - s4.x) * 0.125
              + steradian_moment_series_quintic(series.low5, series.high5, t) * (s5.y - s5.x) * 0.1;
    return max(warp.kap * (warp.du + (1.0 - t) * bump), 0.0);
}

// ==== moment_cosine ====

// Powers of the cosine along an edge, the exact double-axis moment, and the Phong series below exponent 1.
//
// The integral of cos^n from the foot is an incomplete beta function. With v^2 = -2 log cos phi it becomes that of
// exp(-(n + 1/2) v^2/2) (1 - v^4/48 ...): an error function and one correction. For n < 8 two steps of the recurrence
// over n lead to where that is close.
// Source: this project (docs/theory/moments.md); the double-axis moment: Arvo 1995, sec. 5.

// The integral of cos^n phi from the foot to the end (x, y) = (c cos phi, c sin phi), |phi| <= pi/2, n >= 4.
//
// Error: relative to the integral up to pi/2, 7e-5 at n = 4, 7e-6 at n = 8, 3e-6 at n = 10, 2e-7 at n = 20.
// Source of the error function: Abramowitz, Stegun, "Handbook of mathematical functions", 1964, 7.1.26.
float steradian_moment_cosine_from_foot(float x, float y, float n) {
    float a = n + 0.5;
    float v2 = steradian_moment_log_1_plus(y * y / max(x * x, steradian_smallest_divisor()));
    float t = 0.5 * a * v2;
    float v = sqrt(v2);
    float decay = exp(-t);
    float e = 1.0 / (1.0 + 0.3275911 * sqrt(t));
    float p = ((((1.061405429 * e - 1.453152027) * e + 1.421413741) * e - 0.284496736) * e + 0.254829592) * e;
    // The correction's share of the integral up to pi/2, which is sqrt(pi/(2 a)) (1 - 1/(16 a^2)).
    float correction = v * (v2 + 3.0 / a) * inversesqrt(a) / (60.1590786 - 3.75994241 / (a * a));
    // Half the beta function B(1/2, (n+1)/2): Gamma(h + 1)/Gamma(h + 1/2) squared is k + 1/(32 k) - 9/(2048 k^3),
    // k = h + 1/4, h = n/2, to 2e-5 at n = 4 and 4e-7 at n = 8.
    float k = 0.5 * n + 0.25;
    float quarter_turn = 0.886226925452758014 * inversesqrt(k + 0.03125 / k - 0.00439453125 / (k * k * k));
    float magnitude = quarter_turn * (1.0 - decay * (p - correction));
    return steradian_select(y < 0.0, -magnitude, magnitude);
}

// The integral of x^n dphi, x = c cos phi, over the part in front of one edge; n >= 0.
//
//   low      1 for n < 8, else 0; the same for every lane
//
// Error: at most 9e-5 of the integral over a half circle for n >= 0, 4e-5 for n >= 1, 7e-6 for n >= 5.
float steradian_moment_cosine_front(SteradianMomentEdge edge, float n, int low) {
    float order = n;
    if (low == 1) {
        order = n + 4.0;
    }
    float cosines = steradian_moment_cosine_from_foot(edge.x1, edge.y1, order) - steradian_moment_cosine_from_foot(edge.x0, edge.y0, order);
    float result = exp(-0.5 * order * edge.log_c) * cosines;
    if (low == 1) {
        // (n + 1) c^2 int x^n = (n + 2) int x^(n+2) - [x^(n+1) y], twice.
        float c2 = edge.c * edge.c;
        float p0 = steradian_phong_power(edge.x0, n + 1.0) * edge.y0;
        float p1 = steradian_phong_power(edge.x1, n + 1.0) * edge.y1;
        result = ((n + 4.0) * result - (p1 * edge.x1 * edge.x1 - p0 * edge.x0 * edge.x0)) / ((n + 3.0) * c2);
        result = ((n + 2.0) * result - (p1 - p0)) / ((n + 1.0) * c2);
    }
    return max(result, 0.0);
}

// |s| times the integral of (1 - x^m)/(1 - x^2) over the part in front, for m = n + 1 below 2.
//
//   n        exponent, in [0, 1)
//   raised   the series of exponent n + 2: (1 - x^m)/(1 - x^2) = (1 - x^(m+2))/(1 - x^2) - x^m
float steradian_moment_series_low_front(SteradianMomentEdge edge, SteradianMomentSeries raised, float n) {
    return max(steradian_moment_series_front(edge, raised) - edge.s * steradian_moment_cosine_front(edge, n + 1.0, 1), 0.0);
}

// The result of steradian_moment_series_low_front, in high quality; the error is then that of the cosines.
float steradian_moment_series_high_low_front(SteradianMomentEdge edge, SteradianMomentSeriesHigh raised, float n) {
    return max(steradian_moment_series_high_front(edge, raised) - edge.s * steradian_moment_cosine_front(edge, n + 1.0, 1), 0.0);
}

// One edge's share of (n + 2) times the double-axis moment, the integral of max(u.r, 0)^n (u.v) over a light.
//
//   a, b     as for steradian_moment_edge, r unit axis of the power, v the other axis, of any length
//   share    steradian_moment_edge_share with exponent n - 1 (m = n), by any method, n >= 1
//   cosines  the integral of x^n dphi over the part in front, by any method
//
// Exact as far as share and cosines are: foreshortening (v the normal) and the v.h of half-vector space need no
// product of lobes.
float steradian_moment_double_axis_share(vec3 a, vec3 b, vec3 r, vec3 v, float share, float cosines) {
    vec3 n = cross(a, b);
    float n2 = dot(n, n);
    float inward = dot(n, v) * inversesqrt(max(n2, steradian_smallest_divisor()));
    return dot(r, v) * share + steradian_select(n2 > steradian_smallest_divisor(), inward * cosines, 0.0);
}

// The two integrands over the part in front of a lobe of exponent n times the light's cosine, by quadrature: share's and cosines'.
//
//   level  1 where n is 0, the same for every lane: the integral of x^0 is the angle, and (1 - x^0)/(1 - x^2) is 0
SteradianMomentIntegrands steradian_moment_foreshortened_front(SteradianMomentEdge edge, float n, int level) {
    SteradianMomentIntegrands front;
    front.moment = 0.0;
    front.power = 0.0;
    if (level > 0) {
        front.power = steradian_trig_atan2(edge.x0 * edge.y1 - edge.x1 * edge.y0, edge.x0 * edge.x1 + edge.y0 * edge.y1);
    } else {
        front = steradian_moment_quadrature_front(edge, n - 1.0);
    }
    return front;
}

// One edge's share of (n + 2) times the moment of a lobe times the light's cosine: z is the normal.
//
//   front    |s| times the integral of (1 - x^m)/(1 - x^2) with exponent n - 1, by any method
//   cosines  the integral of x^n dphi over the part in front, by any method
float steradian_moment_foreshortened_share(SteradianMomentEdge edge, vec3 a, vec3 b, vec3 r, float front, float cosines) {
    return steradian_moment_double_axis_share(a, b, r, vec3(0.0, 0.0, 1.0), steradian_moment_edge_share(edge, front), cosines);
}
