// Phong's lobe about the mirrored view, times the light's cosine where the material asks for it.
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.
#include "phong_front.glsl"

const bool FORESHORTENED = LOBE_FORM == 1;

// Contribution of one edge to (n + 1) times the moment. r: unit axis of the lobe.
float phong_share(vec3 a, vec3 b, vec3 r, float n) {
    MomentEdge edge = moment_edge(a, b, r);
    if (!FORESHORTENED) return moment_edge_share(edge, phong_front(edge, n));
    float front;
    float cosines;
    if (METHOD == kPhongExact) {
        MomentIntegrands q = moment_foreshortened_front(edge, n, int(n == 0.0));
        front = q.moment;
        cosines = q.power;
    } else {
        front = phong_front(edge, n - 1.0);
        cosines = moment_cosine_front(edge, n, LOW_EXPONENT > 0 ? 1 : 0);
    }
    return (n + 1.0) / (n + 2.0) * moment_foreshortened_share(edge, a, b, r, front, cosines);
}

struct PhongLobe {
    vec3 mirror;
    float n;
};

// Value of the lobe in a direction; used for light from one direction and for the elements of a small light.
float phong_at(PhongLobe lobe, vec3 l) {
    return l.z > 0.0 && dot(l, lobe.mirror) > 0.0 ? phong_lobe(l, lobe.mirror, lobe.n) * (FORESHORTENED ? l.z : 1.0) : 0.0;
}

float phong_over_outline(Light light, Seen seen, mat3 frame, vec3 p, PhongLobe lobe) {
    float sum = 0.0;
    begin_clip(seen.reversed ? -1.0 : 1.0);
    int count = clipped_length(light);
    for (int i = outline_first(); i < count; i++) {
        if (!clipped_place(light, frame, p, i)) continue;
        do {
            if (has_clipped_edge()) sum += phong_share(clip_begin, clip_end, lobe.mirror, lobe.n);
        } while (!UNCUT && next_arc());
    }
    return moment_phong_radiance(sum, seen.reversed);
}

// Bias of the method. Elements miss the bend that a lobe of an exponent below 2 has at its end: they serve only where the lobe is tiny there.
float phong_bias(PhongLobe lobe) {
    if (lobe.n < 2.0) return 0.0;
    return METHOD == kPhongSeries ? light_elements_series_bias() : METHOD == kPhongSeriesHigh ? light_elements_series_high_bias() : 0.0;
}

// Radiance towards the view from a light of radiance 1, for a lobe of colour 1.
float own_radiance(Light light, vec3 p, vec3 n, vec3 v, OwnLobe own) {
    mat3 frame = frame_from_normal(n);
    vec3 view = transform_transposed(frame, v);
    Seen seen = see(light, p);
    if (!seen.lit || !(view.z > 0.0)) return 0.0;
    PhongLobe lobe = PhongLobe(phong_mirror(view), own.exponent);
    if (KIND == kPunctual) {
        PunctualIncident incident = punctual_at(light, p);
        return incident.irradiance * phong_at(lobe, transform_transposed(frame, incident.direction));
    }
    LightElementsLimits limits = light_elements_along_power(lobe.n, phong_bias(lobe));
    if (may_be_small(light, p, limits)) {
        LightElements e = elements_in(light, seen, frame, p);
        if (elements_serve(e, light_elements_power_sharpness(lobe.n), limits)) {
            float sent = 0.0;
            for (int i = 0; i < 4; i++) {
                LightElement element = light_element_at(e, i);
                sent += phong_at(lobe, element.direction) * element.solid_angle;
            }
            return sent;
        }
    }
    if (has_corners()) prepare_corners(light, frame, p, lobe.mirror, inversesqrt(lobe.n + 1.0));
    return phong_over_outline(light, seen, frame, p, lobe);
}
