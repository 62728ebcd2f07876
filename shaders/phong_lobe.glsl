// Phong's lobe about the mirrored view, times the light's cosine where the material asks for it, and the product of two as one matched
// lobe. Mirrors source/integrals/phong/phong.h, foreshortened_phong.h and matched_lobe.h.
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.
#include "lobe/lobe_product.glsl"
#include "phong_front.glsl"

const bool PRODUCT = LOBE_FORM == 2;
const bool FORESHORTENED = LOBE_FORM == 1;

// Contribution of one edge to (n + 1) times the moment. r: unit axis of the lobe.
float phong_share(vec3 a, vec3 b, vec3 r, float n) {
    MomentEdge edge = moment_edge(a, b, r);
    if (!FORESHORTENED) return moment_edge_share(edge, phong_front(edge, n));
    float front = 0.0;
    float cosines;
    if (METHOD == kPhongExact || METHOD == kPhongArvo) {
        if (n == 0.0) {
            cosines = trig_atan2(edge.x0 * edge.y1 - edge.x1 * edge.y0, edge.x0 * edge.x1 + edge.y0 * edge.y1);
        } else {
            MomentIntegrands q = moment_quadrature_front(edge, n - 1.0);
            front = METHOD == kPhongExact ? q.moment : phong_front(edge, n - 1.0);
            cosines = q.power;
        }
    } else {
        front = phong_front(edge, n - 1.0);
        cosines = moment_cosine_front(edge, n, LOW_EXPONENT > 0 ? 1 : 0);
    }
    float share = moment_double_axis_share(a, b, r, vec3(0.0, 0.0, 1.0), moment_edge_share(edge, front), cosines);
    return (n + 1.0) / (n + 2.0) * share;
}

struct PhongLobe {
    vec3 mirror;
    float n;
    vec3 axis;  // axis of a product's second lobe
    float n2;
    StretchedLobe matched;
};

PhongLobe phong_lobe_of(OwnLobe own, mat3 frame, vec3 view) {
    PhongLobe lobe;
    lobe.mirror = phong_mirror(view);
    lobe.n = own.exponent;
    if (!PRODUCT) return lobe;
    lobe.n2 = own.axis_exponent;
    lobe.axis = vec3(0.0, 0.0, 1.0);
    if (dot(own.direction, own.direction) > 0.0) lobe.axis = polygon_direction(transform_transposed(frame, own.direction));
    vec3 peak = lobe.n + lobe.n2 > 0.0 ? lobe_product_peak_of_two(lobe.mirror, lobe.n, lobe.axis, lobe.n2) : lobe.mirror;
    LobeProduct product = lobe_product_begin(peak);
    product = lobe_product_add(product, lobe.mirror, lobe.n);
    lobe.matched = lobe_product_anisotropic(lobe_product_add(product, lobe.axis, lobe.n2));
    return lobe;
}

// Value of the lobe in a direction; used for light from one direction and for the elements of a small light.
float phong_at(PhongLobe lobe, vec3 l) {
    float c1 = dot(l, lobe.mirror);
    if (PRODUCT) {
        float c2 = dot(l, lobe.axis);
        float product = phong_power(max(c1, 0.0), lobe.n) * phong_power(max(c2, 0.0), lobe.n2);
        return l.z > 0.0 && c1 > 0.0 && c2 > 0.0 ? (lobe.n + lobe.n2 + 1.0) * inverse_two_pi() * product : 0.0;
    }
    return l.z > 0.0 && c1 > 0.0 ? phong_lobe(l, lobe.mirror, lobe.n) * (FORESHORTENED ? l.z : 1.0) : 0.0;
}

vec3 matched_direction(PhongLobe lobe, vec3 u) { return polygon_direction(lobe_product_stretch(lobe.matched, u)); }

float phong_over_outline(Light light, Seen seen, mat3 frame, vec3 p, PhongLobe lobe) {
    float sum = 0.0;
    ClippedWalk walk = clipped_walk_begin(light, frame, p);
    do {
        walk = fill_edges(walk, light, seen, frame, p);
        for (int i = 0; i < edge_count; i++) {
            if (PRODUCT)
                sum += phong_share(matched_direction(lobe, edge_begins[i]), matched_direction(lobe, edge_ends[i]), vec3(0.0, 0.0, 1.0),
                                   lobe.matched.exponent);
            else
                sum += phong_share(edge_begins[i], edge_ends[i], lobe.mirror, lobe.n);
        }
    } while (CHUNKED && walk.more);
    float sent = moment_phong_radiance(sum, seen.reversed);
    // The lobe's factor is that of both exponents, the moment's that of the matched one.
    if (PRODUCT) sent *= lobe.matched.scale * ((lobe.n + lobe.n2 + 1.0) / (lobe.matched.exponent + 1.0));
    return sent;
}

// Values of source/shapes/small_light.h.
float phong_bias(PhongLobe lobe) {
    bool bends = lobe.n < 2.0 || (PRODUCT && lobe.n2 < 2.0);
    if (bends) return 0.0;
    if (PRODUCT || METHOD == kPhongSeries) return 1.0 / 64.0;
    return METHOD == kPhongSeriesHigh ? 1.0 / 115.0 : 0.0;
}

// Width and axis of the region where corners of a round light gather; for a product, it is about the peak.
float phong_width(PhongLobe lobe) { return inversesqrt((PRODUCT ? lobe.n + lobe.n2 : lobe.n) + 1.0); }
vec3 phong_axis(PhongLobe lobe) { return PRODUCT ? lobe.matched.frame[2] : lobe.mirror; }

// Radiance towards the view from a light of radiance 1, for a lobe of colour 1.
float own_radiance(Light light, vec3 p, vec3 n, vec3 v, vec3 tangent, OwnLobe own) {
    mat3 frame = frame_from_normal(n);
    vec3 view = transform_transposed(frame, v);
    Seen seen = see(light, p);
    if (!seen.lit || !(view.z > 0.0)) return 0.0;
    PhongLobe lobe = phong_lobe_of(own, frame, view);
    if (KIND == kPunctual) {
        PunctualIncident incident = punctual_at(light, p);
        return incident.irradiance * phong_at(lobe, transform_transposed(frame, incident.direction));
    }
    if (has_corners()) fill_corners(light, frame, p, phong_axis(lobe), phong_width(lobe));
    float sent = phong_over_outline(light, seen, frame, p, lobe);
    float sharpness = 2.5 + sqrt(PRODUCT ? lobe.n + lobe.n2 : lobe.n);
    float bias = phong_bias(lobe);
    float least_distance2 = bias > 0.0 || PRODUCT ? min(500.0, 4.0 * sharpness * sharpness) : 500.0;
    if (CAREFUL && may_be_small(light, p, least_distance2)) {
        LightElements e = elements_in(light, seen, frame, p);
        if (elements_serve(e, sharpness, 128.0, bias)) {
            sent = 0.0;
            for (int i = 0; i < 4; i++) {
                LightElement element = light_element_at(e, i);
                sent += phong_at(lobe, element.direction) * element.solid_angle;
            }
        }
    }
    return sent;
}
