// Steradian 0.1.0, lobe: lobes of surfaces, for WGSL.
//
// Put it before your module's text; it has no bindings.
// It needs these files before it, in this order: math.wgsl.
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

// ==== charlie ====

// Charlie: the sheen of cloth, glTF's KHR_materials_sheen.
//
// Frame: z the surface normal; l light and v view unit and pointing away from the surface. Brightest where light or view
// grazes, and dark about the mirror direction: no peak, but a hole.
// Source: Estevez, Kulla, "Production friendly microfacet sheen BRDF", 2017, eq. 2 to 4 and table 1.

// The lobe of one view.
//   exponent  of the half vector's sine squared: 1 / (2 alpha)
//   scale     what multiplies its power over 1 + both shadowings: (2 + 1 / alpha) / (8 pi v_z); 0 for a view below
//   a ... e   the curve of the shadowing's logarithm, blended for alpha
//   middle    that curve at 1/2
//   masking   the view's own 1 + Lambda
struct SteradianCharlieLobe {
    view: vec3f,
    exponent: f32,
    scale: f32,
    a: f32,
    b: f32,
    c: f32,
    d: f32,
    e: f32,
    middle: f32,
    masking: f32,
}

// The authors' curve: a / (1 + b x^c) + d x + e.
//
//   x        in [0, 1/2]; below 1.0e-9 it is taken there, where the power is not yet 0 but the lobe is
fn steradian_charlie_curve(lobe: SteradianCharlieLobe, x: f32) -> f32 {
    let power = exp(lobe.c * log(max(x, 1.0e-9)));
    return lobe.a / (1.0 + lobe.b * power) + lobe.d * x + lobe.e;
}

// Lambda of the shadowing, fitted by its authors; the curve's mirror image beyond cosine 1/2.
//
//   cosine   of light or view; outside of [0, 1] (by rounding) it is taken at the end
fn steradian_charlie_lambda(lobe: SteradianCharlieLobe, cosine: f32) -> f32 {
    let x = clamp(cosine, 0.0, 1.0);
    let steep = x > 0.5;
    let curve = steradian_charlie_curve(lobe, select(x, 1.0 - x, steep));
    return exp(select(curve, 2.0 * lobe.middle - curve, steep));
}

// Prepares the lobe of a view.
//
//   v        unit view
//   alpha    roughness squared in (0, 1], taken to be at least 0.04: below, the model reflects more than arrives and only
//            within a few degrees of the horizon
//
// Degenerate: a view that is not above the surface makes a lobe of 0.
fn steradian_charlie_prepare(v: vec3f, alpha: f32) -> SteradianCharlieLobe {
    let width = clamp(alpha, 0.04, 1.0);
    let t = (1.0 - width) * (1.0 - width);
    var lobe: SteradianCharlieLobe;
    lobe.view = v;
    lobe.exponent = 0.5 / width;
    lobe.scale = select(0.0, (2.0 + 1.0 / width) * 0.0397887357729738339 / max(v.z, 1.0e-6), v.z > 0.0);
    lobe.a = 21.5473 + t * (25.3245 - 21.5473);
    lobe.b = 3.82987 + t * (3.32435 - 3.82987);
    lobe.c = 0.19823 + t * (0.16801 - 0.19823);
    lobe.d = -1.97760 + t * (1.97760 - 1.27393);
    lobe.e = -4.32054 + t * (4.32054 - 4.85967);
    lobe.middle = 0.0;
    lobe.middle = steradian_charlie_curve(lobe, 0.5);
    lobe.masking = 0.0;
    lobe.masking = 1.0 + steradian_charlie_lambda(lobe, v.z);
    return lobe;
}

// BRDF of colour 1 times the light's cosine, D / (4 v_z (1 + Lambda_v + Lambda_l)).
//
//   l        unit; 0 where it is not above the surface
//
// Degenerate: l = -v has no half vector and gives a finite number.
// Error: see docs/measured/accuracy.md, "Charlie lobe".
fn steradian_charlie_lobe(lobe: SteradianCharlieLobe, l: vec3f) -> f32 {
    let h = l + lobe.view;
    let across = h.x * h.x + h.y * h.y;
    let sine2 = across / max(across + h.z * h.z, steradian_smallest_divisor());
    let power = exp(lobe.exponent * log(clamp(sine2, steradian_smallest_divisor(), 1.0)));
    let shadowed = lobe.scale * power / (lobe.masking + steradian_charlie_lambda(lobe, l.z));
    return select(0.0, shadowed, l.z > 0.0);
}

// ==== lobe_product ====

// The product of cosine lobes as one lobe: peak-matched, isotropic or anisotropic.
//
// P(u) = product of (u.r_i)^n_i is replaced by a lobe that has its maximum, at the same place, and its curvature
// there. Spherical Gaussians, the usual way, miss height and width from 30 degrees between the axes on.
// Any number of lobes is walked several times: twice for Newton steps towards the maximum, once for the result.
//
//   SteradianLobeProduct p = steradian_lobe_product_begin(start);          // start: direction of the sum of n_i r_i
//   for each lobe: p = steradian_lobe_product_add(p, r_i, n_i);
//   start = steradian_lobe_product_newton(p);                     // three lobes within 50 degrees: .003 degrees off after one
//   ... the same again, then
//   SteradianCosineLobe lobe = steradian_lobe_product_isotropic(p);
//
// Frame: any. Axes are unit vectors; the peak must lie in front of all of them, else the product is 0.
// Source: this project (docs/theory/moments.md).

// A cosine lobe: scale (u.axis)^exponent.
struct SteradianCosineLobe {
    axis: vec3f,
    exponent: f32,
    scale: f32,
}

// A stretched cosine lobe: scale (w.z)^exponent with w the unit direction of steradian_lobe_product_stretch(lobe, u): about the z axis of its own
// frame.
struct SteradianStretchedLobe {
    frame: mat3x3f,
    stretch: vec3f,  // symmetric 2x2 of determinant 1: xx, xy, yy
    exponent: f32,
    scale: f32,
}

// Sums over the lobes, seen from a direction.
//   about      frame whose z is that direction
//   total      sum of n_i
//   log_scale  sum of n_i log(z.r_i)
//   slope      sum of n_i tau_i, tau_i = (r_i.x, r_i.y)/(r_i.z) in the frame
//   curvature  sum of n_i tau_i tau_i^T: xx, xy, yy
//   lowest     smallest z.r_i
struct SteradianLobeProduct {
    about: mat3x3f,
    total: f32,
    log_scale: f32,
    slope: vec2f,
    curvature: vec3f,
    lowest: f32,
}

// The state before the first lobe.
fn steradian_lobe_product_begin(direction: vec3f) -> SteradianLobeProduct {
    var p: SteradianLobeProduct;
    p.about = steradian_frame_from_normal(direction);
    p.total = 0.0;
    p.log_scale = 0.0;
    p.slope = vec2f(0.0, 0.0);
    p.curvature = vec3f(0.0, 0.0, 0.0);
    p.lowest = 1.0;
    return p;
}

// Adds (u.r)^n.
fn steradian_lobe_product_add(p: SteradianLobeProduct, r: vec3f, n: f32) -> SteradianLobeProduct {
    let local = steradian_transform_transposed(p.about, r);
    let z = max(local.z, 1.0e-4);
    let x = local.x / z;
    let y = local.y / z;
    var next = p;
    next.total = p.total + n;
    next.log_scale = p.log_scale + n * log(z);
    next.slope = p.slope + vec2f(n * x, n * y);
    next.curvature = p.curvature + vec3f(n * x * x, n * x * y, n * y * y);
    next.lowest = min(p.lowest, local.z);
    return next;
}

// A direction nearer to the maximum: one Newton step on the logarithm, whose Hessian is -(total + curvature).
fn steradian_lobe_product_newton(p: SteradianLobeProduct) -> vec3f {
    let xx = p.total + p.curvature.x;
    let yy = p.total + p.curvature.z;
    let xy = p.curvature.y;
    let inverse = 1.0 / max(xx * yy - xy * xy, steradian_smallest_divisor());
    let step_to = vec3f(inverse * (yy * p.slope.x - xy * p.slope.y), inverse * (xx * p.slope.y - xy * p.slope.x), 1.0);
    let u = steradian_transform(p.about, step_to);
    return u * inverseSqrt(dot(u, u));
}

// Height of the product at the sums' direction; 0 where a lobe does not reach.
fn steradian_lobe_product_scale(p: SteradianLobeProduct) -> f32 {
    return select(0.0, exp(p.log_scale), p.lowest > 1.0e-4);
}

// The isotropic lobe; its exponent gives the full lobe's integral the right size.
fn steradian_lobe_product_isotropic(p: SteradianLobeProduct) -> SteradianCosineLobe {
    let xx = p.total + p.curvature.x;
    let yy = p.total + p.curvature.z;
    var lobe: SteradianCosineLobe;
    lobe.axis = steradian_transform(p.about, vec3f(0.0, 0.0, 1.0));
    lobe.exponent = sqrt(max(xx * yy - p.curvature.y * p.curvature.y, 0.0));
    lobe.scale = steradian_lobe_product_scale(p);
    return lobe;
}

// The anisotropic lobe. A linear map of determinant 1 turns it into an isotropic one and polygons into polygons:
// the integral over a light is scale times the moment of the stretched outline about z.
fn steradian_lobe_product_anisotropic(p: SteradianLobeProduct) -> SteradianStretchedLobe {
    let xx = p.total + p.curvature.x + 3.0;
    let yy = p.total + p.curvature.z + 3.0;
    let xy = p.curvature.y;
    let d = sqrt(max(xx * yy - xy * xy, steradian_smallest_divisor()));
    // The root of a symmetric matrix M of determinant 1 is (M + 1)/sqrt(trace M + 2).
    let root = inverseSqrt((xx + yy) / d + 2.0);
    var lobe: SteradianStretchedLobe;
    lobe.frame = p.about;
    lobe.stretch = vec3f(root * (xx / d + 1.0), root * xy / d, root * (yy / d + 1.0));
    lobe.exponent = d - 3.0;
    lobe.scale = steradian_lobe_product_scale(p);
    return lobe;
}

// A direction in the lobe's stretched frame. It is not unit; the zero vector stays zero.
fn steradian_lobe_product_stretch(lobe: SteradianStretchedLobe, u: vec3f) -> vec3f {
    let l = steradian_transform_transposed(lobe.frame, u);
    return vec3f(lobe.stretch.x * l.x + lobe.stretch.y * l.y, lobe.stretch.y * l.x + lobe.stretch.z * l.y, l.z);
}

// The maximum of (u.r1)^n1 (u.r2)^n2, in closed form: it lies in the plane of the two axes.
//
// Degenerate: axes 90 degrees apart and more give a direction where the product is about 0; equal axes give r1.
fn steradian_lobe_product_peak_of_two(r1: vec3f, n1: f32, r2: vec3f, n2: f32) -> vec3f {
    let cosine = max(dot(r1, r2), 1.0e-6);
    let across = r2 - r1 * dot(r1, r2);
    let sine2 = dot(across, across);
    let tangent = sqrt(sine2) / cosine;
    let sum = n1 + n2;
    let t = 2.0 * n2 * tangent / (sum + sqrt(sum * sum + 4.0 * n1 * n2 * tangent * tangent));
    let u = r1 + across * (t * inverseSqrt(max(sine2, steradian_smallest_divisor())));
    return u * inverseSqrt(dot(u, u));
}

// ==== microfacet ====

// Microfacet terms: GGX and Beckmann distributions, height-correlated Smith shadowing, Schlick's Fresnel.
//
// Frame: z the surface normal, x and y the directions of the widths ax and ay (equal where isotropic). l light,
// v view, h half vector, all unit and pointing away from the surface. Width alpha = roughness squared, at least 1.0e-4.

// Half vector of light and view. Degenerate: l = -v gives the zero vector.
fn steradian_microfacet_half_vector(l: vec3f, v: vec3f) -> vec3f {
    let h = l + v;
    return h * inverseSqrt(max(dot(h, h), steradian_smallest_square()));
}

// Distribution of GGX: 1 / (pi ax ay ((h_x/ax)^2 + (h_y/ay)^2 + h_z^2)^2).
//
// In the components of h, not in 1 - h_z^2, which cancels in float at small alpha.
// Degenerate: the sum is at least 1 for a unit h; the zero half vector of l = -v, finite.
// Source: Walter, Marschner, Li, Torrance, "Microfacet models for refraction", 2007, eq. 33; anisotropic: Heitz,
// "Understanding the masking-shadowing function in microfacet-based BRDFs", 2014, eq. 85.
fn steradian_ggx_distribution(h: vec3f, ax: f32, ay: f32) -> f32 {
    let x = h.x / ax;
    let y = h.y / ay;
    let d = max(x * x + y * y + h.z * h.z, 1.0e-6);
    return steradian_inverse_pi() / (ax * ay * d * d);
}

// Length of the direction w stretched by the surface: sqrt(w_z^2 + (ax w_x)^2 + (ay w_y)^2).
fn steradian_ggx_stretched_length(w: vec3f, ax: f32, ay: f32) -> f32 {
    let x = ax * w.x;
    let y = ay * w.y;
    return sqrt(x * x + y * y + w.z * w.z);
}

// Smith's shadowing and masking, height-correlated, in [0, 1].
//
// Degenerate: 0 where l or v is not above the surface.
// Source: Heitz 2014, eq. 99, written without Lambda: 2 l_z v_z / (l_z |v|' + v_z |l|').
fn steradian_ggx_shadowing(l: vec3f, v: vec3f, ax: f32, ay: f32) -> f32 {
    let lz = max(l.z, 0.0);
    let vz = max(v.z, 0.0);
    let d = lz * steradian_ggx_stretched_length(v, ax, ay) + vz * steradian_ggx_stretched_length(l, ax, ay);
    return 2.0 * lz * vz / max(d, steradian_smallest_square());
}

// Schlick's Fresnel with a free value at grazing.
//
//   f0, f90  reflectance along and across the normal
//   v_dot_h  cosine between view and half vector
//
// Source: Schlick, "An inexpensive BRDF model for physically-based rendering", 1994, eq. 15.
fn steradian_fresnel_schlick(f0: f32, f90: f32, v_dot_h: f32) -> f32 {
    let x = clamp(1.0 - v_dot_h, 0.0, 1.0);
    let x2 = x * x;
    return f0 + (f90 - f0) * (x2 * x2 * x);
}

// Distribution of Beckmann: exp(-((h_x/ax)^2 + (h_y/ay)^2)/h_z^2) / (pi ax ay h_z^4).
//
// Degenerate: h_z is kept above 1.0e-5, where the exponential is 0 for any alpha up to 1.
// Source: Walter et al. 2007, eq. 25.
fn steradian_beckmann_distribution(h: vec3f, ax: f32, ay: f32) -> f32 {
    let hz = max(h.z, 1.0e-5);
    let x = h.x / (ax * hz);
    let y = h.y / (ay * hz);
    let z2 = hz * hz;
    return steradian_inverse_pi() * exp(-(x * x + y * y)) / (ax * ay * z2 * z2);
}

// A microfacet lobe without shadowing and Fresnel: BRDF times cosine, D / (4 v_z).
//
//   d        distribution at the half vector
//   l, v     directions; 0 where either is not above the surface
fn steradian_microfacet_lobe_unshadowed(d: f32, l: vec3f, v: vec3f) -> f32 {
    let above = l.z > 0.0 && v.z > 0.0;
    return select(0.0, d / (4.0 * max(v.z, 1.0e-6)), above);
}

// The GGX lobe with shadowing, without Fresnel: BRDF times cosine, D G2 / (4 v_z).
fn steradian_ggx_lobe(l: vec3f, v: vec3f, ax: f32, ay: f32) -> f32 {
    let h = steradian_microfacet_half_vector(l, v);
    let g = steradian_ggx_shadowing(l, v, ax, ay);
    return steradian_microfacet_lobe_unshadowed(steradian_ggx_distribution(h, ax, ay) * g, l, v);
}

// ==== phong ====

// Lobes that are a power of a cosine: Phong about the mirrored view, Blinn-Phong about the normal.

// The logarithm of x for x in (0, 1], with small relative error up to 1: near 1 a GPU's own log promises 5e-7 of absolute error, and a
// high exponent multiplies it.
//
// Error: relative 1e-7 in float for x above 0.75, 3e-16 in double; below as the built-in log.
fn steradian_phong_log(x: f32) -> f32 {
    let near = 0.75;
    var result = log(x);
    let high = x > near;
    if (high) {
        // d - d^2 / (2 + d) is twice t, the first term of twice the inverse hyperbolic tangent of t: so d, which is exact, carries
        // most of the digits. The next term is 2 t^9 / 9, relative 2e-8 at t = 1/7.
        let d = x - 1.0;
        let t = d / (2.0 + d);
        let t2 = t * t;
        let series = d - t * (d - t2 * (0.666666666666666667 + t2 * (0.4 + t2 * 0.285714285714285714)));
        result = select(result, series, high);
    }
    return result;
}

// The power x^n, for x in [0, 1] and n >= 0, as exp(n log x).
//
// Degenerate: x <= 1.0e-30 counts as 1.0e-30 (0 for any n of use; n = 0 gives 1).
// Error: relative, n |log x| roundings of the logarithm: where the power is not small, a few units of 1.0e-7 in float.
fn steradian_phong_power(x: f32, n: f32) -> f32 {
    return exp(n * steradian_phong_log(max(x, steradian_smallest_divisor())));
}

// The view mirrored at the surface.
//
//   v        view direction, shading frame
fn steradian_phong_mirror(v: vec3f) -> vec3f {
    return vec3f(-v.x, -v.y, v.z);
}

// The Phong lobe: (n + 1) / (2 pi) max(l.r, 0)^n. Its integral over the sphere is 1; it has no foreshortening.
//
//   l        unit direction of the light, r unit axis of the lobe
//   n        exponent, at least 0
//
// Source: Lecocq, Dufay, Sourimant, Marvie, "Analytic approximations for real-time area light shading", 2017, eq. 10.
fn steradian_phong_lobe(l: vec3f, r: vec3f, n: f32) -> f32 {
    return (n + 1.0) * steradian_inverse_two_pi() * steradian_phong_power(dot(l, r), n);
}

// Distribution of half vectors of Blinn-Phong: (n + 2) / (2 pi) h_z^n, normalised over projected solid angle.
//
//   h        unit half vector, shading frame
fn steradian_blinn_phong_distribution(h: vec3f, n: f32) -> f32 {
    return (n + 2.0) * steradian_inverse_two_pi() * steradian_phong_power(h.z, n);
}
