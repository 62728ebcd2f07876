// Beckmann's and Blinn-Phong's lobes by arcs of half vectors. Mirrors source/integrals/ggx/half_vector.h.
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.

const bool BECKMANN = LOBE_FORM == 1;
OwnLobe arcs_lobe;

#define ARC_SUM float
float share_of_arc(GgxView view, vec3 a, vec3 b) {
    if (BECKMANN) return beckmann_arc(view, a, b, beckmann_series());
    float n = arcs_lobe.exponent;
    MomentSeries series = moment_series_prepare(LOW_EXPONENT == 2 ? n + 1.0 : n - 1.0);
    return blinn_phong_arc_approximate(a, b, view.v, series, n, LOW_EXPONENT);
}
float share_at(GgxView view, vec3 h) {
    return BECKMANN ? beckmann_at_half_vector(view, h) : blinn_phong_at_half_vector(h, view.v, arcs_lobe.exponent);
}
#include "arcs.glsl"

// Value of the lobe in a direction; used for light from one direction and for the elements of a small light.
float arcs_lobe_at(GgxView view, vec3 l) {
    vec3 h = microfacet_half_vector(l, view.v);
    float d = BECKMANN ? beckmann_distribution(h, view.ax, view.ay) : blinn_phong_distribution(h, arcs_lobe.exponent);
    return microfacet_lobe_unshadowed(d, l, view.v);
}

float arcs_over_outline(Light light, Seen seen, mat3 frame, vec3 p, GgxView view) {
    float sum = 0.0;
    ClippedWalk walk = clipped_walk_begin(light, frame, p);
    do {
        walk = fill_edges(walk, light, seen, frame, p);
        for (int i = 0; i < edge_count; i++) sum += sum_over_arcs(view, ggx_edge(view, edge_begins[i], edge_ends[i]));
    } while (CHUNKED && walk.more);
    return half_vector_radiance(view, sum, seen.reversed ? -1.0 : 1.0);
}

// Radiance towards the view from a light of radiance 1.
float own_radiance(Light light, vec3 p, vec3 n, vec3 v, vec3 tangent, OwnLobe own) {
    arcs_lobe = own;
    mat3 frame = frame_from_normal_and_view(n, tangent_of(own, tangent));
    vec3 to_eye = transform_transposed(frame, v);
    Seen seen = see(light, p);
    if (!seen.lit || !(to_eye.z > 0.0)) return 0.0;
    float alpha = blinn_phong_alpha(own.exponent);
    GgxView view = BECKMANN ? ggx_view(to_eye, own.ax, own.ay) : ggx_view(to_eye, alpha, alpha);
    if (KIND == kPunctual) {
        PunctualIncident incident = punctual_at(light, p);
        return incident.irradiance * arcs_lobe_at(view, transform_transposed(frame, incident.direction));
    }
    float width = BECKMANN ? 2.0 * max(own.ax, own.ay) : 2.0 * inversesqrt(own.exponent + 1.0);
    if (has_corners()) fill_corners(light, frame, p, phong_mirror(to_eye), width);
    float sent = arcs_over_outline(light, seen, frame, p, view);
    if (CAREFUL && may_be_small(light, p, 30.0)) {
        LightElements e = elements_in(light, seen, frame, p);
        float deviation = BECKMANN ? 0.707106781186547524 * min(own.ax, own.ay) : inversesqrt(max(own.exponent, 1.0e-12));
        if (elements_serve(e, light_elements_half_vector_sharpness(deviation, to_eye.z), 128.0, BECKMANN ? 1.0 / 200.0 : 1.0 / 64.0)) {
            sent = 0.0;
            for (int i = 0; i < 4; i++) {
                LightElement element = light_element_at(e, i);
                sent += element.direction.z > 0.0 ? arcs_lobe_at(view, element.direction) * element.solid_angle : 0.0;
            }
        }
    }
    return sent;
}
