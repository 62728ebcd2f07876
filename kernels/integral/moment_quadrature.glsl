// The Phong lobe's boundary integral by Gauss-Legendre quadrature in the ellipsoid's angle u (moment_series.glsl).
//
// The reference for the methods in constant time: exact up to quadrature, any real n > -1. The library's exact form
// subdivides moment_quadrature_piece until it converges (source/integrals/phong/exact_moment.cpp); moment_quadrature_front
// is the fixed rule, 14 nodes for each side of the foot.
// The variable of integration is t = tan(u/2), in [-1, 1] in front: no trigonometry.
// Source: this project (docs/theory/moments.md); nodes: roots of the Legendre polynomial of degree 14.
// Needs: constants.glsl moment.glsl
// Topics: moment
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.

// The values that the integrand needs from an edge and a lobe.
//   t0, t1   ends of the part in front
struct MomentQuadrature {
    real m;
    real s2;
    real c2;
    real kap;
    real w;
    real t0;
    real t1;
};

// The parameter t = tan(u/2) of the direction (w x, y), x >= 0, whose angle is u.
real moment_quadrature_parameter(real w, real x, real y) {
    real wx = w * x;
    return clamp(y / max(wx + sqrt(wx * wx + y * y), smallest_length()), -1.0, 1.0);
}

// Prepares the integrand of one edge for a lobe of exponent n.
MomentQuadrature moment_quadrature_prepare(MomentEdge edge, real n) {
    MomentQuadrature q;
    q.m = n + 1.0;
    q.s2 = edge.s * edge.s;
    q.c2 = edge.c * edge.c;
    q.kap = sqrt(moment_1_minus_exp(0.5 * q.m * edge.log_c));
    q.w = edge.s / q.kap;
    q.t0 = moment_quadrature_parameter(q.w, edge.x0, edge.y0);
    q.t1 = moment_quadrature_parameter(q.w, edge.x1, edge.y1);
    return q;
}

// Both integrands at t, with du/dt included.
//   moment   |s| (1 - x^m)/(1 - x^2) dphi = kap E du, E = w^2 (1 - x^m)/Q, Q = s^2 cos^2 u + w^2 sin^2 u
//   power    x^m dphi
struct MomentIntegrands {
    real moment;
    real power;
};

// The integrands at one t.
MomentIntegrands moment_quadrature_integrands(MomentQuadrature q, real t) {
    real t2 = t * t;
    real d = 1.0 / (1.0 + t2);
    real cos_u = max((1.0 - t2) * d, 1.0e-15);
    real sin_u = 2.0 * t * d;
    real cos2 = cos_u * cos_u;
    real wsin2 = q.w * q.w * sin_u * sin_u;
    real Q = q.s2 * cos2 + wsin2;
    real exponent = 0.5 * q.m * moment_log_1_plus(Q / (q.c2 * cos2));  // -log(x^m)
    MomentIntegrands result;
    result.moment = 2.0 * d * q.kap * q.w * q.w * moment_1_minus_exp(exponent) / Q;
    result.power = 2.0 * d * q.w * exp(-exponent) / (cos2 + wsin2);
    return result;
}

// Adds one pair of nodes at mid - offset and mid + offset.
MomentIntegrands moment_quadrature_pair(MomentIntegrands sum, MomentQuadrature q, real mid, real offset, real weight) {
    MomentIntegrands a = moment_quadrature_integrands(q, mid - offset);
    MomentIntegrands b = moment_quadrature_integrands(q, mid + offset);
    MomentIntegrands next;
    next.moment = sum.moment + weight * (a.moment + b.moment);
    next.power = sum.power + weight * (a.power + b.power);
    return next;
}

// Both integrals from t = low to t = high.
MomentIntegrands moment_quadrature_piece(MomentQuadrature q, real low, real high) {
    real mid = 0.5 * (low + high);
    real h = 0.5 * (high - low);
    MomentIntegrands sum;
    sum.moment = 0.0;
    sum.power = 0.0;
    sum = moment_quadrature_pair(sum, q, mid, h * 0.986283808696812339, h * 0.035119460331751863);
    sum = moment_quadrature_pair(sum, q, mid, h * 0.928434883663573517, h * 0.080158087159760210);
    sum = moment_quadrature_pair(sum, q, mid, h * 0.827201315069764993, h * 0.121518570687903185);
    sum = moment_quadrature_pair(sum, q, mid, h * 0.687292904811685470, h * 0.157203167158193535);
    sum = moment_quadrature_pair(sum, q, mid, h * 0.515248636358154092, h * 0.185538397477937814);
    sum = moment_quadrature_pair(sum, q, mid, h * 0.319112368927889760, h * 0.205198463721295604);
    sum = moment_quadrature_pair(sum, q, mid, h * 0.108054948707343662, h * 0.215263853463157790);
    return sum;
}

// Both integrals over the part in front of an edge.
//   moment   |s| times the integral of (1 - x^m)/(1 - x^2) dphi, m = n + 1
//   power    the integral of x^m dphi
//
// Error: see docs/measured/accuracy.md, "phong quadrature".
MomentIntegrands moment_quadrature_front(MomentEdge edge, real n) {
    MomentQuadrature q = moment_quadrature_prepare(edge, n);
    MomentIntegrands to0 = moment_quadrature_piece(q, 0.0, q.t0);
    MomentIntegrands to1 = moment_quadrature_piece(q, 0.0, q.t1);
    MomentIntegrands result;
    result.moment = max(to1.moment - to0.moment, 0.0);
    result.power = max(to1.power - to0.power, 0.0);
    return result;
}
