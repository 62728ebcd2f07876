// Microfacet terms: GGX and Beckmann distributions, height-correlated Smith shadowing, Schlick's Fresnel.
//
// Frame: z the surface normal, x and y the directions of the widths ax and ay (equal where isotropic). l light,
// v view, h half vector, all unit and pointing away from the surface. Width alpha = roughness squared, at least 1.0e-4.
// Needs: constants.glsl
// Topics: microfacet, ggx, fresnel, beckmann
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.

// Half vector of light and view. Degenerate: l = -v gives the zero vector.
vec3 microfacet_half_vector(vec3 l, vec3 v) {
    vec3 h = l + v;
    return h * inversesqrt(max(dot(h, h), smallest_square()));
}

// Distribution of GGX: 1 / (pi ax ay ((h_x/ax)^2 + (h_y/ay)^2 + h_z^2)^2).
//
// In the components of h, not in 1 - h_z^2, which cancels in float at small alpha.
// Degenerate: the sum is at least 1 for a unit h; the zero half vector of l = -v, finite.
// Source: Walter, Marschner, Li, Torrance, "Microfacet models for refraction", 2007, eq. 33; anisotropic: Heitz,
// "Understanding the masking-shadowing function in microfacet-based BRDFs", 2014, eq. 85.
real ggx_distribution(vec3 h, real ax, real ay) {
    real x = h.x / ax;
    real y = h.y / ay;
    real d = max(x * x + y * y + h.z * h.z, 1.0e-6);
    return inverse_pi() / (ax * ay * d * d);
}

// Length of the direction w stretched by the surface: sqrt(w_z^2 + (ax w_x)^2 + (ay w_y)^2).
real ggx_stretched_length(vec3 w, real ax, real ay) {
    real x = ax * w.x;
    real y = ay * w.y;
    return sqrt(x * x + y * y + w.z * w.z);
}

// Smith's shadowing and masking, height-correlated, in [0, 1].
//
// Degenerate: 0 where l or v is not above the surface.
// Source: Heitz 2014, eq. 99, written without Lambda: 2 l_z v_z / (l_z |v|' + v_z |l|').
real ggx_shadowing(vec3 l, vec3 v, real ax, real ay) {
    real lz = max(l.z, 0.0);
    real vz = max(v.z, 0.0);
    real d = lz * ggx_stretched_length(v, ax, ay) + vz * ggx_stretched_length(l, ax, ay);
    return 2.0 * lz * vz / max(d, smallest_square());
}

// Schlick's Fresnel with a free value at grazing.
//
//   f0, f90  reflectance along and across the normal
//   v_dot_h  cosine between view and half vector
//
// Source: Schlick, "An inexpensive BRDF model for physically-based rendering", 1994, eq. 15.
real fresnel_schlick(real f0, real f90, real v_dot_h) {
    real x = clamp(1.0 - v_dot_h, 0.0, 1.0);
    real x2 = x * x;
    return f0 + (f90 - f0) * (x2 * x2 * x);
}

// Distribution of Beckmann: exp(-((h_x/ax)^2 + (h_y/ay)^2)/h_z^2) / (pi ax ay h_z^4).
//
// Degenerate: h_z is kept above 1.0e-5, where the exponential is 0 for any alpha up to 1.
// Source: Walter et al. 2007, eq. 25.
real beckmann_distribution(vec3 h, real ax, real ay) {
    real hz = max(h.z, 1.0e-5);
    real x = h.x / (ax * hz);
    real y = h.y / (ay * hz);
    real z2 = hz * hz;
    return inverse_pi() * exp(-(x * x + y * y)) / (ax * ay * z2 * z2);
}

// A microfacet lobe without shadowing and Fresnel: BRDF times cosine, D / (4 v_z).
//
//   d        distribution at the half vector
//   l, v     directions; 0 where either is not above the surface
real microfacet_lobe_unshadowed(real d, vec3 l, vec3 v) {
    mask above = l.z > 0.0 && v.z > 0.0;
    return select(above, d / (4.0 * max(v.z, 1.0e-6)), 0.0);
}

// The GGX lobe with shadowing, without Fresnel: BRDF times cosine, D G2 / (4 v_z).
real ggx_lobe(vec3 l, vec3 v, real ax, real ay) {
    vec3 h = microfacet_half_vector(l, v);
    real g = ggx_shadowing(l, v, ax, ay);
    return microfacet_lobe_unshadowed(ggx_distribution(h, ax, ay) * g, l, v);
}
