// The diffuse surface: the same radiance to every side.
// Needs: constants.glsl
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.

// Radiance that a Lambert surface of albedo 1 sends out, per radiance of the light.
//
//   irradiance  polygon_irradiance, in [0, pi]
real lambert_radiance(real irradiance) {
    return irradiance * inverse_pi();
}

// The lobe itself: BRDF of albedo 1 times the cosine of the light's direction l (unit, shading frame).
real lambert_lobe(vec3 l) {
    return max(l.z, 0.0) * inverse_pi();
}

// Schlick's (1 - v.h)^5 in one direction of the light. Unit vectors; 0 where l = v, 1 where l = -v.
real lambert_grazing(vec3 l, vec3 v) {
    real x = 1.0 - sqrt(clamp(0.5 + 0.5 * dot(l, v), 0.0, 1.0));
    real x2 = x * x;
    return x2 * x2 * x;
}

// The same averaged over an even sky, each direction by its cosine.
//
//   v_z      cosine of the view, in [0, 1]
//
// Error: 9.0e-6. The test LambertUnderFresnel.MeanOverTheSkyIsThatOfQuadrature finds the polynomial again.
real lambert_grazing_of_sky(real v_z) {
    real t = 1.0 - clamp(v_z, 0.0, 1.0);
    return 8.2571e-5 + t * (2.01647e-3 + t * (9.33829e-3 + t * (7.74731e-3 + t * 8.97984e-3)));
}

// The same averaged over a light, each direction by its cosine. Approximate: in the light's mean direction, blended with
// the sky's mean by the share of the sky that the light is.
//
//   e        irradiance vector of the light above the horizon; e.z its irradiance, in [0, pi]
//   v        unit view
//
// Exact for small lights and for the whole sky. Error: see docs/measured/accuracy.md, "Diffuse under Fresnel".
// Degenerate: no light gives a number in [0, 1].
real lambert_grazing_of_light(vec3 e, vec3 v) {
    vec3 mean = e * inversesqrt(max(dot(e, e), smallest_square()));
    real in_mean = lambert_grazing(mean, v);
    real share = clamp(e.z * inverse_pi(), 0.0, 1.0);
    return in_mean + (lambert_grazing_of_sky(v.z) - in_mean) * share;
}

// Irradiance that reaches a diffuse lobe below a dielectric's boundary, of what it would get at F = F0.
//
//   loss     (F90 - F0) / (1 - F0) of the boundary; 0: what the lobe gets does not depend on the light's direction
//   e, v     as for lambert_grazing_of_light
//
// Source: glTF 2.0, appendix B: diffuse light weighs 1 - F(v.h).
real lambert_irradiance_below(vec3 e, vec3 v, real loss) {
    return e.z * (1.0 - loss * lambert_grazing_of_light(e, v));
}
