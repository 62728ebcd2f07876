// Point and spot lights of glTF (KHR_lights_punctual): what arrives at a point from one direction.
//
// Positions in metres, vectors in any one frame. A directional light needs no kernel: its illuminance arrives everywhere
// against its direction.
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.

// The values of one light.
//   position        [m]
//   direction       unit: along which a spot shines
//   inverse_range2  1 / range^2 [1/m2]; 0 without a limit
//   spot_scale, spot_offset
//                   of the line from the cosine of the angle to the spot's axis to the square root of its fall-off: 1 / (cos
//                   inner - cos outer) and -cos outer times that; 0 and 1 of a point light
struct PunctualSource {
    vec3 position;
    vec3 direction;
    real inverse_range2;
    real spot_scale;
    real spot_offset;
};

// Light from one direction.
//   direction   unit, to the light
//   irradiance  across it, of a light of intensity 1 [1/m2]
struct PunctualIncident {
    vec3 direction;
    real irradiance;
};

// Light of intensity 1 at the point p.
//
// Degenerate: distances below 1.0e-6 count as that; at none, the direction is the zero vector.
// Source: KHR_lights_punctual, "Range property" and "Inner and outer cone angles".
PunctualIncident punctual_incident(PunctualSource light, vec3 p) {
    vec3 to = light.position - p;
    real d2 = max(dot(to, to), 1.0e-12);
    PunctualIncident incident;
    incident.direction = to * inversesqrt(d2);
    real q = d2 * light.inverse_range2;
    real within = clamp(1.0 - q * q, 0.0, 1.0);
    real spot = clamp(light.spot_offset - dot(light.direction, incident.direction) * light.spot_scale, 0.0, 1.0);
    incident.irradiance = within * (spot * spot) / d2;
    return incident;
}
