// Sheen, Charlie's lobe, by its cubature.
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.

// Walks over the edges twice: one walk sums their vectors, the other is the cubature about that sum.
float sheen_over_outline(Light light, Seen seen, mat3 frame, vec3 p, CharlieLobe lobe) {
    float facing = seen.reversed ? -1.0 : 1.0;
    vec3 e = vec3(0.0);
    CharlieCubature c = charlie_cubature_begin(lobe, e, facing);
    int count = clipped_length(light);
    for (int turn = 0; turn < 2; turn++) {
        begin_clip(facing);
        for (int i = outline_first(); i < count; i++) {
            if (!clipped_place(light, frame, p, i)) continue;
            do {
                if (has_clipped_edge()) {
                    if (turn == 0)
                        e += polygon_edge(clip_begin, clip_end);
                    else
                        c = charlie_cubature_edge(c, clip_begin, clip_end);
                }
            } while (!UNCUT && next_arc());
        }
        if (turn == 0) c = charlie_cubature_begin(lobe, e, facing);
    }
    return charlie_cubature_finish(c);
}

// Radiance towards the view from a light of radiance 1, for a lobe of colour 1.
float sheen_radiance(Light light, vec3 p, vec3 n, vec3 v, float alpha) {
    mat3 frame = frame_from_normal(n);
    vec3 view = transform_transposed(frame, v);
    CharlieLobe lobe = charlie_prepare(view, alpha);
    if (KIND == kPunctual) {
        PunctualIncident incident = punctual_at(light, p);
        vec3 l = transform_transposed(frame, incident.direction);
        return l.z > 0.0 ? incident.irradiance * charlie_lobe(lobe, l) : 0.0;
    }
    Seen seen = see(light, p);
    if (!seen.lit || !(view.z > 0.0)) return 0.0;
    if (may_be_small(light, p, light_elements_transformed())) {
        LightElements e = elements_in(light, seen, frame, p);
        if (elements_serve(e, light_elements_half_vector_sharpness(sqrt(alpha), view.z), light_elements_transformed())) {
            float sent = 0.0;
            for (int i = 0; i < 4; i++) {
                LightElement element = light_element_at(e, i);
                sent += element.direction.z > 0.0 ? charlie_lobe(lobe, element.direction) * element.solid_angle : 0.0;
            }
            return sent;
        }
    }
    // Corners gather about the normal, widely: the lobe has no peak about which they should.
    if (has_corners()) prepare_corners(light, frame, p, vec3(0.0, 0.0, 1.0), 1.0);
    return sheen_over_outline(light, seen, frame, p, lobe);
}
