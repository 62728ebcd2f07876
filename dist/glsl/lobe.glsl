// Steradian 0.1.0, lobe: lobes of surfaces, for GLSL 4.50.
//
// Paste after #version and your own declarations.
// It needs these files before it, in this order: math.glsl.
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
    vec3 view;
    float exponent;
    float scale;
    float a;
    float b;
    float c;
    float d;
    float e;
    float middle;
    float masking;
};

// The authors' curve: a / (1 + b x^c) + d x + e.
//
//   x        in [0, 1/2]; below 1.0e-9 it is taken there, where the power is not yet 0 but the lobe is
float steradian_charlie_curve(SteradianCharlieLobe lobe, float x) {
    float power = exp(lobe.c * log(max(x, 1.0e-9)));
    return lobe.a / (1.0 + lobe.b * power) + lobe.d * x + lobe.e;
}

// Lambda of the shadowing, fitted by its authors; the curve's mirror image beyond cosine 1/2.
//
//   cosine   of light or view; outside of [0, 1] (by rounding) it is taken at the end
float steradian_charlie_lambda(SteradianCharlieLobe lobe, float cosine) {
    float x = clamp(cosine, 0.0, 1.0);
    bool steep = x > 0.5;
    float curve = steradian_charlie_curve(lobe, steradian_select(steep, 1.0 - x, x));
    return exp(steradian_select(steep, 2.0 * lobe.middle - curve, curve));
}

// Prepares the lobe of a view.
//
//   v        unit view
//   alpha    roughness squared in (0, 1], taken to be at least 0.04: below, the model reflects more than arrives and only
//            within a few degrees of the horizon
//
// Degenerate: a view that is not above the surface makes a lobe of 0.
SteradianCharlieLobe steradian_charlie_prepare(vec3 v, float alpha) {
    float width = clamp(alpha, 0.04, 1.0);
    float t = (1.0 - width) * (1.0 - width);
    SteradianCharlieLobe lobe;
    lobe.view = v;
    lobe.exponent = 0.5 / width;
    lobe.scale = steradian_select(v.z > 0.0, (2.0 + 1.0 / width) * 0.0397887357729738339 / max(v.z, 1.0e-6), 0.0);
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
float steradian_charlie_lobe(SteradianCharlieLobe lobe, vec3 l) {
    vec3 h = l + lobe.view;
    float across = h.x * h.x + h.y * h.y;
    float sine2 = across / max(across + h.z * h.z, steradian_smallest_divisor());
    float power = exp(lobe.exponent * log(clamp(sine2, steradian_smallest_divisor(), 1.0)));
    float shadowed = lobe.scale * power / (lobe.masking + steradian_charlie_lambda(lobe, l.z));
    return steradian_select(l.z > 0.0, shadowed, 0.0);
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
    vec3 axis;
    float exponent;
    float scale;
};

// A stretched cosine lobe: scale (w.z)^exponent with w the unit direction of steradian_lobe_product_stretch(lobe, u): about the z axis of its own
// frame.
struct SteradianStretchedLobe {
    mat3 frame;
    vec3 stretch;  // symmetric 2x2 of determinant 1: xx, xy, yy
    float exponent;
    float scale;
};

// Sums over the lobes, seen from a direction.
//   about      frame whose z is that direction
//   total      sum of n_i
//   log_scale  sum of n_i log(z.r_i)
//   slope      sum of n_i tau_i, tau_i = (r_i.x, r_i.y)/(r_i.z) in the frame
//   curvature  sum of n_i tau_i tau_i^T: xx, xy, yy
//   lowest     smallest z.r_i
struct SteradianLobeProduct {
    mat3 about;
    float total;
    float log_scale;
    vec2 slope;
    vec3 curvature;
    float lowest;
};

// The state before the first lobe.
SteradianLobeProduct steradian_lobe_product_begin(vec3 direction) {
    SteradianLobeProduct p;
    p.about = steradian_frame_from_normal(direction);
    p.total = 0.0;
    p.log_scale = 0.0;
    p.slope = vec2(0.0, 0.0);
    p.curvature = vec3(0.0, 0.0, 0.0);
    p.lowest = 1.0;
    return p;
}

// Adds (u.r)^n.
SteradianLobeProduct steradian_lobe_product_add(SteradianLobeProduct p, vec3 r, float n) {
    vec3 local = steradian_transform_transposed(p.about, r);
    float z = max(local.z, 1.0e-4);
    float x = local.x / z;
    float y = local.y / z;
    SteradianLobeProduct next = p;
    next.total = p.total + n;
    next.log_scale = p.log_scale + n * log(z);
    next.slope = p.slope + vec2(n * x, n * y);
    next.curvature = p.curvature + vec3(n * x * x, n * x * y, n * y * y);
    next.lowest = min(p.lowest, local.z);
    return next;
}

// A direction nearer to the maximum: one Newton step on the logarithm, whose Hessian is -(total + curvature).
vec3 steradian_lobe_product_newton(SteradianLobeProduct p) {
    float xx = p.total + p.curvature.x;
    float yy = p.total + p.curvature.z;
    float xy = p.curvature.y;
    float inverse = 1.0 / max(xx * yy - xy * xy, steradian_smallest_divisor());
    vec3 step_to = vec3(inverse * (yy * p.slope.x - xy * p.slope.y), inverse * (xx * p.slope.y - xy * p.slope.x), 1.0);
    vec3 u = steradian_transform(p.about, step_to);
    return u * inversesqrt(dot(u, u));
}

// Height of the product at the sums' direction; 0 where a lobe does not reach.
float steradian_lobe_product_scale(SteradianLobeProduct p) {
    return steradian_select(p.lowest > 1.0e-4, exp(p.log_scale), 0.0);
}

// The isotropic lobe; its exponent gives the full lobe's integral the right size.
SteradianCosineLobe steradian_lobe_product_isotropic(SteradianLobeProduct p) {
    float xx = p.total + p.curvature.x;
    float yy = p.total + p.curvature.z;
    SteradianCosineLobe lobe;
    lobe.axis = steradian_transform(p.about, vec3(0.0, 0.0, 1.0));
    lobe.exponent = sqrt(max(xx * yy - p.curvature.y * p.curvature.y, 0.0));
    lobe.scale = steradian_lobe_product_scale(p);
    return lobe;
}

// The anisotropic lobe. A linear map of determinant 1 turns it into an isotropic one and polygons into polygons:
// the integral over a light is scale times the moment of the stretched outline about z.
SteradianStretchedLobe steradian_lobe_product_anisotropic(SteradianLobeProduct p) {
    float xx = p.total + p.curvature.x + 3.0;
    float yy = p.total + p.curvature.z + 3.0;
    float xy = p.curvature.y;
    float d = sqrt(max(xx * yy - xy * xy, steradian_smallest_divisor()));
    // The root of a symmetric matrix M of determinant 1 is (M + 1)/sqrt(trace M + 2).
    float root = inversesqrt((xx + yy) / d + 2.0);
    SteradianStretchedLobe lobe;
    lobe.frame = p.about;
    lobe.stretch = vec3(root * (xx / d + 1.0), root * xy / d, root * (yy / d + 1.0));
    lobe.exponent = d - 3.0;
    lobe.scale = steradian_lobe_product_scale(p);
    return lobe;
}

// A direction in the lobe's stretched frame. It is not unit; the zero vector stays zero.
vec3 steradian_lobe_product_stretch(SteradianStretchedLobe lobe, vec3 u) {
    vec3 l = steradian_transform_transposed(lobe.frame, u);
    return vec3(lobe.stretch.x * l.x + lobe.stretch.y * l.y, lobe.stretch.y * l.x + lobe.stretch.z * l.y, l.z);
}

// The maximum of (u.r1)^n1 (u.r2)^n2, in closed form: it lies in the plane of the two axes.
//
// Degenerate: axes 90 degrees apart and more give a direction where the product is about 0; equal axes give r1.
vec3 steradian_lobe_product_peak_of_two(vec3 r1, float n1, vec3 r2, float n2) {
    float cosine = max(dot(r1, r2), 1.0e-6);
    vec3 across = r2 - r1 * dot(r1, r2);
    float sine2 = dot(across, across);
    float tangent = sqrt(sine2) / cosine;
    float sum = n1 + n2;
    float t = 2.0 * n2 * tangent / (sum + sqrt(sum * sum + 4.0 * n1 * n2 * tangent * tangent));
    vec3 u = r1 + across * (t * inversesqrt(max(sine2, steradian_smallest_divisor())));
    return u * inversesqrt(dot(u, u));
}

// ==== microfacet ====

// Microfacet terms: GGX and Beckmann distributions, height-correlated Smith shadowing, Schlick's Fresnel.
//
// Frame: z the surface normal, x and y the directions of the widths ax and ay (equal where isotropic). l light,
// v view, h half vector, all unit and pointing away from the surface. Width alpha = roughness squared, at least 1.0e-4.

// Half vector of light and view. Degenerate: l = -v gives the zero vector.
vec3 steradian_microfacet_half_vector(vec3 l, vec3 v) {
    vec3 h = l + v;
    return h * inversesqrt(max(dot(h, h), steradian_smallest_square()));
}

// Distribution of GGX: 1 / (pi ax ay ((h_x/ax)^2 + (h_y/ay)^2 + h_z^2)^2).
//
// In the components of h, not in 1 - h_z^2, which cancels in float at small alpha.
// Degenerate: the sum is at least 1 for a unit h; the zero half vector of l = -v, finite.
// Source: Walter, Marschner, Li, Torrance, "Microfacet models for refraction", 2007, eq. 33; anisotropic: Heitz,
// "Understanding the masking-shadowing function in microfacet-based BRDFs", 2014, eq. 85.
float steradian_ggx_distribution(vec3 h, float ax, float ay) {
    float x = h.x / ax;
    float y = h.y / ay;
    float d = max(x * x + y * y + h.z * h.z, 1.0e-6);
    return steradian_inverse_pi() / (ax * ay * d * d);
}

// Length of the direction w stretched by the surface: sqrt(w_z^2 + (ax w_x)^2 + (ay w_y)^2).
float steradian_ggx_stretched_length(vec3 w, float ax, float ay) {
    float x = ax * w.x;
    float y = ay * w.y;
    return sqrt(x * x + y * y + w.z * w.z);
}

// Smith's shadowing and masking, height-correlated, in [0, 1].
//
// Degenerate: 0 where l or v is not above the surface.
// Source: Heitz 2014, eq. 99, written without Lambda: 2 l_z v_z / (l_z |v|' + v_z |l|').
float steradian_ggx_shadowing(vec3 l, vec3 v, float ax, float ay) {
    float lz = max(l.z, 0.0);
    float vz = max(v.z, 0.0);
    float d = lz * steradian_ggx_stretched_length(v, ax, ay) + vz * steradian_ggx_stretched_length(l, ax, ay);
    return 2.0 * lz * vz / max(d, steradian_smallest_square());
}

// Schlick's Fresnel with a free value at grazing.
//
//   f0, f90  reflectance along and across the normal
//   v_dot_h  cosine between view and half vector
//
// Source: Schlick, "An inexpensive BRDF model for physically-based rendering", 1994, eq. 15.
float steradian_fresnel_schlick(float f0, float f90, float v_dot_h) {
    float x = clamp(1.0 - v_dot_h, 0.0, 1.0);
    float x2 = x * x;
    return f0 + (f90 - f0) * (x2 * x2 * x);
}

// Distribution of Beckmann: exp(-((h_x/ax)^2 + (h_y/ay)^2)/h_z^2) / (pi ax ay h_z^4).
//
// Degenerate: h_z is kept above 1.0e-5, where the exponential is 0 for any alpha up to 1.
// Source: Walter et al. 2007, eq. 25.
float steradian_beckmann_distribution(vec3 h, float ax, float ay) {
    float hz = max(h.z, 1.0e-5);
    float x = h.x / (ax * hz);
    float y = h.y / (ay * hz);
    float z2 = hz * hz;
    return steradian_inverse_pi() * exp(-(x * x + y * y)) / (ax * ay * z2 * z2);
}

// A microfacet lobe without shadowing and Fresnel: BRDF times cosine, D / (4 v_z).
//
//   d        distribution at the half vector
//   l, v     directions; 0 where either is not above the surface
float steradian_microfacet_lobe_unshadowed(float d, vec3 l, vec3 v) {
    bool above = l.z > 0.0 && v.z > 0.0;
    return steradian_select(above, d / (4.0 * max(v.z, 1.0e-6)), 0.0);
}

// The GGX lobe with shadowing, without Fresnel: BRDF times cosine, D G2 / (4 v_z).
float steradian_ggx_lobe(vec3 l, vec3 v, float ax, float ay) {
    vec3 h = steradian_microfacet_half_vector(l, v);
    float g = steradian_ggx_shadowing(l, v, ax, ay);
    return steradian_microfacet_lobe_unshadowed(steradian_ggx_distribution(h, ax, ay) * g, l, v);
}

// ==== phong ====

// Lobes that are a power of a cosine: Phong about the mirrored view, Blinn-Phong about the normal.

// The logarithm of x for x in (0, 1], with small relative error up to 1: near 1 a GPU's own log promises 5e-7 of absolute error, and a
// high exponent multiplies it.
//
// Error: relative 1e-7 in float for x above 0.75, 3e-16 in double; below as the built-in log.
float steradian_phong_log(float x) {
    float near = 0.75;
    float result = log(x);
    bool high = x > near;
    if (high) {
        // d - d^2 / (2 + d) is twice t, the first term of twice the inverse hyperbolic tangent of t: so d, which is exact, carries
        // most of the digits. The next term is 2 t^9 / 9, relative 2e-8 at t = 1/7.
        float d = x - 1.0;
        float t = d / (2.0 + d);
        float t2 = t * t;
        float series = d - t * (d - t2 * (0.666666666666666667 + t2 * (0.4 + t2 * 0.285714285714285714)));
        result = steradian_select(high, series, result);
    }
    return result;
}

// The power x^n, for x in [0, 1] and n >= 0, as exp(n log x).
//
// Degenerate: x <= 1.0e-30 counts as 1.0e-30 (0 for any n of use; n = 0 gives 1).
// Error: relative, n |log x| roundings of the logarithm: where the power is not small, a few units of 1.0e-7 in float.
float steradian_phong_power(float x, float n) {
    return exp(n * steradian_phong_log(max(x, steradian_smallest_divisor())));
}

// The view mirrored at the surface.
//
//   v        view direction, shading frame
vec3 steradian_phong_mirror(vec3 v) {
    return vec3(-v.x, -v.y, v.z);
}

// The Phong lobe: (n + 1) / (2 pi) max(l.r, 0)^n. Its integral over the sphere is 1; it has no foreshortening.
//
//   l        unit direction of the light, r unit axis of the lobe
//   n        exponent, at least 0
//
// Source: Lecocq, Dufay, Sourimant, Marvie, "Analytic approximations for real-time area light shading", 2017, eq. 10.
float steradian_phong_lobe(vec3 l, vec3 r, float n) {
    return (n + 1.0) * steradian_inverse_two_pi() * steradian_phong_power(dot(l, r), n);
}

// Distribution of half vectors of Blinn-Phong: (n + 2) / (2 pi) h_z^n, normalised over projected solid angle.
//
//   h        unit half vector, shading frame
float steradian_blinn_phong_distribution(vec3 h, float n) {
    return (n + 2.0) * steradian_inverse_two_pi() * steradian_phong_power(h.z, n);
}
