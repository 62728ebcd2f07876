// The product of cosine lobes as one lobe: peak-matched, isotropic or anisotropic.
//
// P(u) = product of (u.r_i)^n_i is replaced by a lobe that has its maximum, at the same place, and its curvature
// there. Spherical Gaussians, the usual way, miss height and width from 30 degrees between the axes on.
// Any number of lobes is walked several times: twice for Newton steps towards the maximum, once for the result.
//
//   LobeProduct p = lobe_product_begin(start);          // start: direction of the sum of n_i r_i
//   for each lobe: p = lobe_product_add(p, r_i, n_i);
//   start = lobe_product_newton(p);                     // three lobes within 50 degrees: .003 degrees off after one
//   ... the same again, then
//   CosineLobe lobe = lobe_product_isotropic(p);
//
// Frame: any. Axes are unit vectors; the peak must lie in front of all of them, else the product is 0.
// Source: this project (docs/theory/moments.md).
// Needs: constants.glsl frame.glsl
// Topics: lobe_product, cosine_lobe, stretched_lobe
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.

// A cosine lobe: scale (u.axis)^exponent.
struct CosineLobe {
    vec3 axis;
    real exponent;
    real scale;
};

// A stretched cosine lobe: scale (w.z)^exponent with w the unit direction of lobe_product_stretch(lobe, u): about the z axis of its own
// frame.
struct StretchedLobe {
    mat3 frame;
    vec3 stretch;  // symmetric 2x2 of determinant 1: xx, xy, yy
    real exponent;
    real scale;
};

// Sums over the lobes, seen from a direction.
//   about      frame whose z is that direction
//   total      sum of n_i
//   log_scale  sum of n_i log(z.r_i)
//   slope      sum of n_i tau_i, tau_i = (r_i.x, r_i.y)/(r_i.z) in the frame
//   curvature  sum of n_i tau_i tau_i^T: xx, xy, yy
//   lowest     smallest z.r_i
struct LobeProduct {
    mat3 about;
    real total;
    real log_scale;
    vec2 slope;
    vec3 curvature;
    real lowest;
};

// The state before the first lobe.
LobeProduct lobe_product_begin(vec3 direction) {
    LobeProduct p;
    p.about = frame_from_normal(direction);
    p.total = 0.0;
    p.log_scale = 0.0;
    p.slope = vec2(0.0, 0.0);
    p.curvature = vec3(0.0, 0.0, 0.0);
    p.lowest = 1.0;
    return p;
}

// Adds (u.r)^n.
LobeProduct lobe_product_add(LobeProduct p, vec3 r, real n) {
    vec3 local = transform_transposed(p.about, r);
    real z = max(local.z, 1.0e-4);
    real x = local.x / z;
    real y = local.y / z;
    LobeProduct next = p;
    next.total = p.total + n;
    next.log_scale = p.log_scale + n * log(z);
    next.slope = p.slope + vec2(n * x, n * y);
    next.curvature = p.curvature + vec3(n * x * x, n * x * y, n * y * y);
    next.lowest = min(p.lowest, local.z);
    return next;
}

// A direction nearer to the maximum: one Newton step on the logarithm, whose Hessian is -(total + curvature).
vec3 lobe_product_newton(LobeProduct p) {
    real xx = p.total + p.curvature.x;
    real yy = p.total + p.curvature.z;
    real xy = p.curvature.y;
    real inverse = 1.0 / max(xx * yy - xy * xy, smallest_divisor());
    vec3 step_to = vec3(inverse * (yy * p.slope.x - xy * p.slope.y), inverse * (xx * p.slope.y - xy * p.slope.x), 1.0);
    vec3 u = transform(p.about, step_to);
    return u * inversesqrt(dot(u, u));
}

// Height of the product at the sums' direction; 0 where a lobe does not reach.
real lobe_product_scale(LobeProduct p) {
    return select(p.lowest > 1.0e-4, exp(p.log_scale), 0.0);
}

// The isotropic lobe; its exponent gives the full lobe's integral the right size.
CosineLobe lobe_product_isotropic(LobeProduct p) {
    real xx = p.total + p.curvature.x;
    real yy = p.total + p.curvature.z;
    CosineLobe lobe;
    lobe.axis = transform(p.about, vec3(0.0, 0.0, 1.0));
    lobe.exponent = sqrt(max(xx * yy - p.curvature.y * p.curvature.y, 0.0));
    lobe.scale = lobe_product_scale(p);
    return lobe;
}

// The anisotropic lobe. A linear map of determinant 1 turns it into an isotropic one and polygons into polygons:
// the integral over a light is scale times the moment of the stretched outline about z.
StretchedLobe lobe_product_anisotropic(LobeProduct p) {
    real xx = p.total + p.curvature.x + 3.0;
    real yy = p.total + p.curvature.z + 3.0;
    real xy = p.curvature.y;
    real d = sqrt(max(xx * yy - xy * xy, smallest_divisor()));
    // The root of a symmetric matrix M of determinant 1 is (M + 1)/sqrt(trace M + 2).
    real root = inversesqrt((xx + yy) / d + 2.0);
    StretchedLobe lobe;
    lobe.frame = p.about;
    lobe.stretch = vec3(root * (xx / d + 1.0), root * xy / d, root * (yy / d + 1.0));
    lobe.exponent = d - 3.0;
    lobe.scale = lobe_product_scale(p);
    return lobe;
}

// A direction in the lobe's stretched frame. It is not unit; the zero vector stays zero.
vec3 lobe_product_stretch(StretchedLobe lobe, vec3 u) {
    vec3 l = transform_transposed(lobe.frame, u);
    return vec3(lobe.stretch.x * l.x + lobe.stretch.y * l.y, lobe.stretch.y * l.x + lobe.stretch.z * l.y, l.z);
}

// The maximum of (u.r1)^n1 (u.r2)^n2, in closed form: it lies in the plane of the two axes.
//
// Degenerate: axes 90 degrees apart and more give a direction where the product is about 0; equal axes give r1.
vec3 lobe_product_peak_of_two(vec3 r1, real n1, vec3 r2, real n2) {
    real cosine = max(dot(r1, r2), 1.0e-6);
    vec3 across = r2 - r1 * dot(r1, r2);
    real sine2 = dot(across, across);
    real tangent = sqrt(sine2) / cosine;
    real sum = n1 + n2;
    real t = 2.0 * n2 * tangent / (sum + sqrt(sum * sum + 4.0 * n1 * n2 * tangent * tangent));
    vec3 u = r1 + across * (t * inversesqrt(max(sine2, smallest_divisor())));
    return u * inversesqrt(dot(u, u));
}
