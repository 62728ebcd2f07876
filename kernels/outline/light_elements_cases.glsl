// Parity cases of light_elements.glsl; tests/parity/case.glsl says how to write one.
// Needs: frame.glsl
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.

// A square far away, facing the point, that is small in any case.
LightElements case_elements(CaseInput i) {
    mat3 frame = frame_from_normal(case_xyz(i.a));
    LightElements e;
    e.center = case_xyz(i.a) * i.b.x;
    e.reach_a = transform(frame, vec3(i.b.y, 0.0, 0.0));
    e.reach_b = transform(frame, vec3(0.0, i.b.y, 0.0));
    e.area = case_xyz(i.a) * (-6.0 * i.b.y * i.b.y);
    return e;
}

// light elements, direction and solid angle of one
//   a.xyz  direction
//   b.x    log(0.1, 10)
//   b.y    log(1e-6, 1e-3)
// Values: 4
vec4 case_light_element(CaseInput i) {
    LightElement element = light_element_at(case_elements(i), 1);
    return vec4(element.direction.x, element.direction.y, element.direction.z, element.solid_angle);
}

// light elements, irradiance, and whether they serve for three lobes
//   a.xyz  direction
//   b.x    log(3, 10)
//   b.y    log(1e-6, 1e-3)
//   b.z    log(0.3, 1)
//   b.w    range(0.5, 1)
// Values: 2
vec4 case_light_elements(CaseInput i) {
    LightElements e = case_elements(i);
    vec3 normal = case_xyz(i.a);
    mask serve = light_elements_serve(e, normal, light_elements_diffuse_sharpness(), 2.0, 0.0)
        && light_elements_serve(e, normal, light_elements_sharpness(i.b.z), 128.0, 0.0)
        && light_elements_serve(e, normal, light_elements_half_vector_sharpness(i.b.z, i.b.w), 128.0, 0.015);
    vec3 around = light_elements_irradiance_vector(e);
    return vec4(around.z, select(serve, 1.0, 0.0), 0.0, 0.0);
}

// Sum of a set of limits.
real case_sum_of_limits(LightElementsLimits l) { return l.roundings + l.least_distance2 + l.bias; }

// light elements, limits of integrals
//   a.x  log(0.1, 1000)
// Error: relative
// Values: 2
vec4 case_light_elements_limits(CaseInput i) {
    real bias = light_elements_series_bias() + light_elements_series_high_bias() + light_elements_beckmann_bias();
    real fixed_limits = case_sum_of_limits(light_elements_along_edges()) + case_sum_of_limits(light_elements_transformed())
        + case_sum_of_limits(light_elements_along_arcs()) + case_sum_of_limits(light_elements_along_half_vectors(bias));
    return vec4(fixed_limits, case_sum_of_limits(light_elements_along_power(i.a.x, bias)), 0.0, 0.0);
}
