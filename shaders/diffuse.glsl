// The diffuse lobe: irradiance in closed form.
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.

vec3 polygon_vector(Light light, Seen seen, mat3 frame, vec3 p) {
    PolygonWalk walk = polygon_begin();
    int count = outline_length(light);
    int i = 1;
    vec3 previous = outline_place(light, frame, p, 0).direction;
    do {
        Place place = outline_place(light, frame, p, i);
        vec3 from = place.joined ? previous : place.direction;
        if (UNCUT)
            walk.edges += polygon_edge(from, place.direction);
        else
            walk = polygon_add_edge(walk, from, place.direction);
        previous = place.direction;
        ++i;
    } while (i < count);
    return polygon_irradiance_vector(walk, seen.reversed);
}

// Irradiance vector from a light of radiance 1, in the frame; its z is the irradiance, in [0, pi].
vec3 irradiance_vector(Light light, Seen seen, mat3 frame, vec3 p) {
    vec3 e;
    LightElementsLimits limits = light_elements_along_arcs();
    if (KIND == kPolygon || by_pieces()) {
        e = polygon_vector(light, seen, frame, p);
        limits = light_elements_along_edges();
    } else if (KIND == kCapsule) {
        e = capsule_irradiance_vector(capsule_in(light, frame, p));
    } else if (BALLS) {
        e = capsule_irradiance_vector(capsule_between(light.r[2].xyz, light.r[2].xyz, light.r[2].w, frame, p));
    } else if (UNCUT) {
        e = ellipse_whole_irradiance_vector(ellipse_in(light, frame, p));
    } else {
        e = ellipse_irradiance_vector(ellipse_in(light, frame, p));
    }
    if (may_be_small(light, p, limits)) {
        LightElements elements = elements_in(light, seen, frame, p);
        if (elements_serve(elements, light_elements_diffuse_sharpness(), limits)) e = light_elements_irradiance_vector(elements);
    }
    return seen.lit ? e : vec3(0.0);
}

// Irradiance from a light of radiance 1 that reaches the diffuse lobe below a boundary.
float irradiance_below_boundary(Light light, vec3 p, vec3 n, vec3 v, float loss) {
    if (KIND == kPunctual) {
        PunctualIncident incident = punctual_at(light, p);
        return incident.irradiance * max(dot(n, incident.direction), 0.0) * (1.0 - loss * lambert_grazing(incident.direction, v));
    }
    mat3 frame = frame_from_normal(n);
    return irradiance_below(irradiance_vector(light, see(light, p), frame, p), transform_transposed(frame, v), loss);
}
