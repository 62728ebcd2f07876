// The specular lobe, GGX, by each of its methods. Results are radiance at the view from a light of radiance 1, x with F = 1, y with
// F = (1 - v.h)^5.
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.

// The lobe at one point.
struct SpecularLobe {
    vec3 tangent;
    float ax;
    float ay;
};

struct Answer {
    float irradiance;  // that reaches the diffuse lobe, if both are wanted
    vec2 specular;
};

#if LOBE == LOBE_LTC || LOBE == LOBE_LTC_CLIPLESS
#include "tables.glsl"

struct LtcLobe {
    LtcMatrix matrix;
    float n_a;
    float f_a;
};

const int FRESNEL_FIRST = MATRIX_SIZE * MATRIX_SIZE + MAGNITUDE_SIZE * MAGNITUDE_SIZE;

// A lobe of the table, whose matrices begin at node `first`; magnitudes come after them.
LtcLobe ltc_lobe_at(int first, float roughness, vec3 view) {
    vec2 at = ltc_coordinates(roughness, view.z);
    vec4 entry = look_up(first, MATRIX_SIZE, at);
    vec4 scale = look_up(first + MATRIX_SIZE * MATRIX_SIZE, MAGNITUDE_SIZE, at);
    LtcLobe lobe;
    if (COMPACT)
        lobe.matrix = ltc_from_compact(entry, max(roughness * roughness, 1.0e-4), view);
    else
        lobe.matrix = ltc_from_classic(entry);
    lobe.n_a = scale.x;
    lobe.f_a = scale.y;
    return lobe;
}

// The lobe in the direction of a light without extent.
vec2 ltc_towards(vec3 direction, vec3 n, vec3 v, float alpha) {
    mat3 frame = frame_from_normal_and_view(n, v);
    vec3 view = vec3(dot(frame[0], v), 0.0, dot(n, v));
    vec3 l = transform_transposed(frame, direction);
    if (!(l.z > 0.0) || !(view.z > 0.0)) return vec2(0.0);
    float roughness = sqrt(alpha);
    LtcLobe lobe = ltc_lobe_at(0, roughness, view);
    vec2 sent = vec2(lobe.n_a, lobe.f_a) * ltc_lobe(lobe.matrix, l);
    if (FRESNEL_TABLE) {
        LtcLobe fresnel = ltc_lobe_at(FRESNEL_FIRST, roughness, view);
        sent.y = fresnel.n_a * ltc_lobe(fresnel.matrix, l);
    }
    return sent;
}

// The integral by the light's elements; -1 where the outline is better.
float ltc_by_elements(LightElements e, LtcMatrix m) {
    if (!elements_serve(e, light_elements_diffuse_sharpness() + ltc_sharpness(m, e.center), light_elements_transformed())) return -1.0;
    float sum = 0.0;
    for (int k = 0; k < 4; k++) {
        LightElement element = light_element_at(e, k);
        sum += element.direction.z > 0.0 ? ltc_lobe(m, element.direction) * element.solid_angle : 0.0;
    }
    return sum;
}

#if LOBE == LOBE_LTC_CLIPLESS
vec2 clipless(Light light, Seen seen, mat3 frame, vec3 p, vec3 view, float alpha) {
    LtcLobe lobe = ltc_lobe_at(0, sqrt(alpha), view);
    vec3 sum = vec3(0.0);
    int count = outline_length(light);
    vec3 previous = vec3(0.0);
    for (int i = outline_first(); i < count; i++) {
        Place place = outline_place(light, frame, p, i);
        vec3 under = ltc_direction(lobe.matrix, place.direction);
        if (i > 0 && place.joined) sum = ltc_clipless_add_edge(sum, previous, under);
        previous = under;
    }
    float integral = ltc_clipless_integral(sum, seen.reversed);
    if (may_be_small(light, p, light_elements_transformed())) {
        float few = ltc_by_elements(elements_in(light, seen, frame, p), lobe.matrix);
        if (few >= 0.0) integral = few;
    }
    return vec2(lobe.n_a, lobe.f_a) * integral;
}
#else
struct LtcAnswer {
    vec3 irradiance;  // vector for the diffuse lobe, if both are wanted
    float specular;   // integral of the transformed cosine
};

LtcAnswer ltc_walked(Light light, Seen seen, mat3 frame, vec3 p, LtcMatrix m) {
    float few = -1.0;  // the integral by elements, if they serve
    vec3 few_diffuse = vec3(0.0);
    bool diffuse_by_few = false;
    if (may_be_small(light, p, light_elements_transformed())) {
        LightElements e = elements_in(light, seen, frame, p);
        few = ltc_by_elements(e, m);
        diffuse_by_few = elements_serve(e, light_elements_diffuse_sharpness(), light_elements_along_edges());
        if (TOGETHER && diffuse_by_few) few_diffuse = light_elements_irradiance_vector(e);
    }
    PolygonWalk diffuse = polygon_begin();
    LtcWalk walk = ltc_begin();
    int count = outline_length(light);
    vec3 previous_under = vec3(0.0);
    for (int i = outline_first(); i < count; i++) {
        next_edge(light, frame, p, i);
        vec3 under = ltc_direction(m, edge_end);
        vec3 from_under = edge_begin == edge_end ? under : previous_under;
        previous_under = under;
        if (i < 1) continue;
        if (UNCUT) {
            if (TOGETHER) diffuse.edges += polygon_edge(edge_begin, edge_end);
            walk.lobe = polygon_add_edge(walk.lobe, from_under, under);
        } else {
            if (TOGETHER) diffuse = polygon_add_edge(diffuse, edge_begin, edge_end);
            walk = ltc_add_edge(walk, m, edge_begin, edge_end, from_under, under);
        }
    }
    LtcAnswer answer;
    answer.irradiance = diffuse_by_few ? few_diffuse : polygon_irradiance_vector(diffuse, seen.reversed);
    answer.specular = few >= 0.0 ? few : ltc_integral(walk, seen.reversed);
    if (!seen.lit) answer.irradiance = vec3(0.0);
    if (!seen.lit) answer.specular = 0.0;
    return answer;
}

// The table's lobe, then, if it has one, its separate lobe for the Fresnel term.
Answer ltc_answer(Light light, Seen seen, mat3 frame, vec3 p, vec3 view, float alpha, float loss) {
    float roughness = sqrt(alpha);
    Answer answer;
    answer.irradiance = 0.0;
    answer.specular = vec2(0.0);
    for (int k = 0; k <= FRESNEL_LOBE; k++) {
        LtcLobe lobe = ltc_lobe_at(k * FRESNEL_FIRST, roughness, view);
        LtcAnswer walked = ltc_walked(light, seen, frame, p, lobe.matrix);
        if (k == 0) {
            if (TOGETHER) answer.irradiance = irradiance_below(walked.irradiance, view, loss);
            answer.specular = vec2(lobe.n_a, lobe.f_a) * walked.specular;
        } else {
            answer.specular.y = lobe.n_a * walked.specular;
        }
    }
    if (view.z <= 0.0) answer.specular = vec2(0.0);
    return answer;
}
#endif
#else
vec2 by_elements(LightElements e, GgxView view) {
    vec2 sum = vec2(0.0);
    for (int i = 0; i < 4; i++) {
        LightElement element = light_element_at(e, i);
        if (element.direction.z > 0.0) sum += ggx_lobe_and_fresnel(view, element.direction, SMITH) * element.solid_angle;
    }
    return sum;
}

#if LOBE != LOBE_REPRESENTATIVE_POINT
// Contribution of an edge to E.
#if LOBE == LOBE_CLOSED_FORM
const bool DRAFT = QUALITY == 0;
const bool EXACT = LOBE_FORM == 2;
const int EXTRA_NODES = QUALITY == 2 ? 2 : 0;

vec3 vector_of(GgxView view, ConicArc edge) { return conic_vector(edge); }
#else
const bool DRAFT = false;
const bool EXACT = false;
const int EXTRA_NODES = 0;

const int ARCS = QUALITY == 2 ? 8 : 3 + QUALITY;  // of an edge

vec3 vector_of(GgxView view, ConicArc edge) {
    vec3 sum = vec3(0.0);
    if (!(edge.end > edge.begin)) return sum;
    HalfVectorWalk walk = half_vector_begin(view, edge);
    for (int j = 1; j <= ARCS; j++) {
        float tau = edge.end;
        if (j < ARCS) tau = half_vector_split_pole_mapped(edge, float(j) / float(ARCS));
        walk.b = half_vector_at(view, edge, walk.last.tau);  // again: to hold it takes registers
        walk = half_vector_next(walk, view, edge, tau);
        sum += ggx_arc(view, walk.a, walk.b);
        for (int i = 0; i < half_vector_nodes(); i++) {
            HalfVectorNode node = half_vector_node(walk, view, edge, i);
            sum += ggx_at_half_vector(view, node.h) * node.solid_angle;
        }
    }
    return sum;
}
#endif

// The sums of a cubature. The rest of its state follows from E, and costs less to compute for each edge than registers.
struct CubatureSums {
    float weight;
    float centre_weight;
    vec2 weighted;
    vec2 lowest;
    vec2 highest;
};
CubatureSums sums_of(GgxCubature c) { return CubatureSums(c.weight, c.centre_weight, c.weighted, c.lowest, c.highest); }

GgxCubature cubature_with(CubatureSums sums, GgxView view, vec3 e, float facing) {
    GgxCubature c = ggx_cubature_begin(view, e, SMITH, facing);
    c.weight = sums.weight;
    c.centre_weight = sums.centre_weight;
    c.weighted = sums.weighted;
    c.lowest = sums.lowest;
    c.highest = sums.highest;
    return c;
}

// Two walks over the edges: one sums their vectors, the other is the cubature about that sum. Each edge prepares the view again: to hold it
// takes registers.
vec2 by_arcs(Light light, Seen seen, mat3 frame, vec3 p, vec3 v, float ax, float ay) {
    float facing = seen.reversed ? -1.0 : 1.0;
    vec3 e = vec3(0.0);
    CubatureSums sums = CubatureSums(0.0, 0.0, vec2(0.0), vec2(1.0e30), vec2(-1.0e30));
    for (int turn = 0; turn < (DRAFT || EXACT ? 1 : 2); turn++) {
        begin_clip(facing);
        for (int i = outline_first(); i < clipped_length(light); i++) {
            if (!clipped_place(light, frame, p, i)) continue;
            do {
                if (has_clipped_edge()) {
                    GgxView view = ggx_view(v, ax, ay);
                    ConicArc arc = ggx_edge(view, clip_begin, clip_end);
                    if (turn == 0)
                        e += vector_of(view, arc);
                    else
                        sums = sums_of(ggx_cubature_edge(cubature_with(sums, view, e, facing), arc, EXTRA_NODES));
                }
            } while (!UNCUT && next_arc());
        }
    }
    GgxView view = ggx_view(v, ax, ay);
    if (EXACT) return vec2(ggx_unshadowed(view, e * facing), 0.0);
    if (DRAFT) return ggx_draft(view, e, SMITH, facing);
    GgxCubature c = cubature_with(sums, view, e, facing);
    c.lowest = min(c.lowest, c.at_centre);
    c.highest = max(c.highest, c.at_centre);
    return ggx_cubature_finish(c);
}
#else
vec2 representative_point(Light light, Seen seen, mat3 frame, vec3 p, vec3 view, float alpha) {
    vec3 mirror = phong_mirror(view);
    RepresentativeWalk nearest = representative_begin();
    SolidAngleWalk solid_angle = solid_angle_begin(vec3(0.0, 0.0, 1.0));
    begin_clip(seen.reversed ? -1.0 : 1.0);
    int count = clipped_length(light);
    for (int i = outline_first(); i < count; i++) {
        if (!clipped_place(light, frame, p, i)) continue;
        do {
            if (has_clipped_edge()) {
                nearest = representative_add_edge(nearest, mirror, clip_begin, clip_end);
                solid_angle = solid_angle_add_edge(solid_angle, clip_begin, clip_end);
            }
        } while (!UNCUT && next_arc());
    }
    float lobe =
        representative_radiance(nearest, view, mirror, solid_angle_finish(solid_angle, seen.reversed), alpha, seen.reversed);
    return vec2(lobe, lobe * fresnel_schlick(0.0, 1.0, representative_v_dot_h(nearest, view, mirror, seen.reversed)));
}
#endif
#endif

Answer specular_answer(Light light, vec3 p, vec3 n, vec3 v, SpecularLobe lobe, float loss) {
    Answer answer;
    answer.irradiance = 0.0;
    answer.specular = vec2(0.0);
    if (KIND == kPunctual) {
        PunctualIncident incident = punctual_at(light, p);
#if LOBE == LOBE_LTC || LOBE == LOBE_LTC_CLIPLESS
        answer.specular = ltc_towards(incident.direction, n, v, lobe.ax) * incident.irradiance;
#else
        mat3 frame = frame_from_normal_and_view(n, lobe.tangent);
        vec3 view = transform_transposed(frame, v);
        vec3 l = transform_transposed(frame, incident.direction);
        vec3 h = microfacet_half_vector(l, view);
        float sent = microfacet_lobe_unshadowed(ggx_distribution(h, lobe.ax, lobe.ay), l, view);
        if (LOBE_FORM == 0) sent = ggx_lobe(l, view, lobe.ax, lobe.ay);
        sent *= incident.irradiance;
        answer.specular = vec2(sent, sent * fresnel_schlick(0.0, 1.0, dot(view, h)));
#endif
        return answer;
    }
    Seen seen = see(light, p);
#if LOBE == LOBE_LTC || LOBE == LOBE_LTC_CLIPLESS
    mat3 frame = frame_from_normal_and_view(n, v);
    vec3 view = vec3(dot(frame[0], v), 0.0, dot(n, v));
    if (has_corners()) prepare_corners(light, frame, p, vec3(-view.x, 0.0, view.z), 2.0 * lobe.ax);
#if LOBE == LOBE_LTC
    return ltc_answer(light, seen, frame, p, view, lobe.ax, loss);
#else
    if (seen.lit && view.z > 0.0) answer.specular = clipless(light, seen, frame, p, view, lobe.ax);
    return answer;
#endif
#else
    if (!seen.lit || !(dot(n, v) > 0.0)) return answer;
    mat3 frame = frame_from_normal_and_view(n, lobe.tangent);
    vec3 view = transform_transposed(frame, v);
    LightElementsLimits limits = light_elements_transformed();
    if (LOBE == LOBE_CLOSED_FORM) limits = light_elements_along_arcs();
    if (LOBE == LOBE_HALF_VECTOR) limits = light_elements_along_half_vectors(0.0);
    if (may_be_small(light, p, limits)) {
        LightElements e = elements_in(light, seen, frame, p);
        if (elements_serve(e, light_elements_half_vector_sharpness(0.5 * min(lobe.ax, lobe.ay), view.z), limits)) {
            answer.specular = by_elements(e, ggx_view(view, lobe.ax, lobe.ay));
            return answer;
        }
    }
    if (has_corners()) prepare_corners(light, frame, p, phong_mirror(view), 2.0 * max(lobe.ax, lobe.ay));
#if LOBE == LOBE_REPRESENTATIVE_POINT
    answer.specular = representative_point(light, seen, frame, p, view, lobe.ax);
#else
    answer.specular = by_arcs(light, seen, frame, p, view, lobe.ax, lobe.ay);
#endif
    return answer;
#endif
}
