// The diffuse lobe: irradiance in closed form.
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.

vec3 polygon_vector(Light light, Seen seen, mat3 frame, vec3 p) {
    PolygonWalk walk = polygon_begin();
    int count = outline_length(light);
    for (int i = 0; i < count; i++) {
        next_edge(light, frame, p, i);
        if (i < 1) continue;
        if (UNCUT)
            walk.edges += polygon_edge(edge_begin, edge_end);
        else
            walk = polygon_add_edge(walk, edge_begin, edge_end);
    }
    return polygon_irradiance_vector(walk, seen.reversed);
}

// Irradiance vector from a light of radiance 1, in the frame; its z is the irradiance, in [0, pi].
vec3 irradiance_vector(Light light, Seen seen, mat3 frame, vec3 p) {
    if (!seen.lit) return vec3(0.0);
    LightElementsLimits limits = light_elements_along_arcs();
    if (KIND == kPolygon || by_pieces()) limits = light_elements_along_edges();
    if (may_be_small(light, p, limits)) {
        LightElements elements = elements_in(light, seen, frame, p);
        if (elements_serve(elements, light_elements_diffuse_sharpness(), limits)) return light_elements_irradiance_vector(elements);
    }
    if (KIND == kPolygon || by_pieces()) return polygon_vector(light, seen, frame, p);
    if (KIND == kCapsule) return capsule_irradiance_vector(capsule_in(light, frame, p));
    if (KIND == kEllipsoid) {
        if (BALLS) return capsule_irradiance_vector(capsule_between(light.r[2].xyz, light.r[2].xyz, light.r[2].w, frame, p));
    }
    if (UNCUT) return ellipse_whole_irradiance_vector(ellipse_in(frame));
    return ellipse_irradiance_vector(ellipse_in(frame));
}

// Irradiance from a light of radiance 1 that reaches the diffuse lobe below a boundary.
float irradiance_below_boundary(Light light, vec3 p, vec3 n, vec3 v, float loss) {
    if (KIND == kPunctual) {
        PunctualIncident incident = punctual_at(light, p);
        return incident.irradiance * max(dot(n, incident.direction), 0.0) * (1.0 - loss * lambert_grazing(incident.direction, v));
    }
    mat3 frame = frame_from_normal(n);
    Seen seen = see(light, p);
    return irradiance_below(irradiance_vector(light, seen, frame, p), transform_transposed(frame, v), loss);
}
