// Parity cases of punctual.glsl; tests/parity/case.glsl says how to write one.
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.

// incident light of a spot, irradiance and direction
//   a.xyz  vector(0.5, 5)
//   b.xyz  direction
//   b.w    range(0, 0.03)
//   c.x    range(1, 4)
//   c.y    range(-1, 2)
// Values: 4
vec4 case_punctual_incident(CaseInput i) {
    PunctualSource light;
    light.position = case_xyz(i.a);
    light.direction = case_xyz(i.b);
    light.inverse_range2 = i.b.w;
    light.spot_scale = i.c.x;
    light.spot_offset = i.c.y;
    PunctualIncident incident = punctual_incident(light, vec3(0.0, 0.0, 0.0));
    return vec4(incident.irradiance, incident.direction.x, incident.direction.y, incident.direction.z);
}
