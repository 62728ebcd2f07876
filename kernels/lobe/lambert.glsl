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
