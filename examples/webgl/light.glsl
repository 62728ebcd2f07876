// The radiance of one light, reflected by every surface of the G-buffer to the eye, by one method. page.js puts the version, KIND, METHOD and the shader
// library before it, and adds the lights up.
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.
#define POLYGON 0
#define DISK 1
#define BALL 2
#define TUBE 3

#define LAMBERT 0
#define REPRESENTATIVE_POINT 1
#define LTC_CLIPLESS 2
#define LTC_CLASSIC 3
#define LTC_COMPACT 4
#define CLOSED_FORM_DRAFT 5
#define CLOSED_FORM 6
#define CLOSED_FORM_HIGH 7
#define HALF_VECTOR 8
#define BLINN_PHONG 9
#define BECKMANN 10
#define ARVO 11
#define LORENTZIAN 12
#define PEARSON 13
#define ELLIPSOID 14
#define SERIES 15
#define SERIES_HIGH 16
#define PHONG_EXACT 17
#define IS_GGX (METHOD >= REPRESENTATIVE_POINT && METHOD <= HALF_VECTOR)
#define IS_LTC (METHOD >= LTC_CLIPLESS && METHOD <= LTC_COMPACT)
#define IS_HALF_VECTOR (METHOD >= HALF_VECTOR && METHOD <= BECKMANN)
#define IS_PHONG (METHOD >= ARVO)

uniform sampler2D places;      // where the surface is; w: 1, 0 where there is none
uniform sampler2D normals;     // its normal; w: perceptual roughness
uniform sampler2D albedos;     // of its diffuse lobe
uniform sampler2D mirrors;     // f0 of its specular lobe
uniform vec3 eye;
uniform vec3 radiance;         // of the light
uniform vec3 vertices[16];     // POLYGON: counter-clockwise as seen from its lit side; DISK: centre, x, y; BALL: centre; TUBE: its ends
uniform int vertex_count;      // of POLYGON
uniform float radius;          // of BALL and TUBE
#if METHOD == LTC_CLIPLESS || METHOD == LTC_CLASSIC
uniform sampler2D ltc_matrix, ltc_magnitude;  // tables/ggx_classic.h
#endif
out vec4 colour;

// The light's outline in the shading frame: unit directions in walk order. A round light is a polygon about the lobe; its diffuse part is exact.
const int kMostCorners = 16;
vec3 corners[kMostCorners];
int corner_count = 0;

// The light's edges above the horizon, the arcs of the horizon that close them among them.
vec3 edge_begins[24];
vec3 edge_ends[24];
int edge_count = 0;

#if KIND == DISK || KIND == BALL
void fill_ellipse(SteradianEllipse ellipse, vec3 axis, float width) {
    SteradianEllipseFan fan = steradian_ellipse_fan_concentrated(ellipse, axis, width);
    corner_count = kMostCorners;
    for (int i = 0; i < kMostCorners; i++) corners[i] = steradian_polygon_direction(steradian_ellipse_fan_corner(fan, i, kMostCorners));
}
#endif

// Fills the corners; the diffuse irradiance of radiance 1 is returned, negative where the light is not seen.
//   axis, width   of the specular lobe
float look_at_light(vec3 p, mat3 frame, vec3 axis, float width) {
#if KIND == POLYGON
    vec3 area = vec3(0.0);
    for (int i = 1; i + 1 < vertex_count; i++) area += cross(vertices[i] - vertices[0], vertices[i + 1] - vertices[0]);
    if (dot(area, p - vertices[0]) <= 0.0) return -1.0;
    SteradianPolygonWalk walk = steradian_polygon_begin();
    corner_count = vertex_count;
    for (int i = 0; i < vertex_count; i++) corners[i] = steradian_polygon_direction(steradian_transform_transposed(frame, vertices[vertex_count - 1 - i] - p));
    for (int i = 0; i < vertex_count; i++) walk = steradian_polygon_add_edge(walk, corners[i], corners[i + 1 < vertex_count ? i + 1 : 0]);
    return steradian_polygon_irradiance(walk, false);
#elif KIND == DISK
    if (dot(cross(vertices[1], vertices[2]), p - vertices[0]) <= 0.0) return -1.0;
    SteradianEllipse ellipse = steradian_ellipse_prepare(steradian_transform_transposed(frame, vertices[0] - p),
        steradian_transform_transposed(frame, vertices[1]), steradian_transform_transposed(frame, vertices[2]));
    fill_ellipse(ellipse, axis, width);
    return steradian_ellipse_irradiance_vector(ellipse).z;
#elif KIND == BALL
    SteradianEllipsoidOutline outline = steradian_ellipsoid_outline(steradian_transform_transposed(frame, vertices[0] - p), mat3(radius), mat3(1.0 / radius));
    if (!outline.outside) return -1.0;
    SteradianEllipse ellipse = steradian_ellipse_prepare(outline.center, outline.axis_a, outline.axis_b);
    fill_ellipse(ellipse, axis, width);
    return steradian_ellipse_irradiance_vector(ellipse).z;
#else
    SteradianCapsule tube = steradian_capsule_prepare(steradian_transform_transposed(frame, vertices[0] - p), steradian_transform_transposed(frame, vertices[1] - p), radius);
    if (!tube.outside) return -1.0;
    SteradianCapsuleFan fan = steradian_capsule_fan(tube, axis, width, kMostCorners);
    corner_count = kMostCorners;
    for (int i = 0; i < kMostCorners; i++) corners[i] = steradian_polygon_direction(steradian_capsule_fan_corner(fan, i));
    return steradian_capsule_irradiance_vector(tube).z;
#endif
}

void add_edge(vec3 a, vec3 b) {
    vec3 chord = b - a;
    if (dot(chord, chord) > 1.0e-14 && edge_count < 24) {
        edge_begins[edge_count] = a;
        edge_ends[edge_count] = b;
        edge_count++;
    }
}

void add_arc_of_horizon(SteradianHorizonClip clip) {
    if (!clip.closes) return;
    vec3 start = clip.arc_start;
    if (steradian_horizon_arc_wide(start, clip.arc_end)) {
        vec3 middle = steradian_horizon_arc_middle(start, clip.arc_end, 1.0);
        add_edge(start, middle);
        start = middle;
    }
    add_edge(start, clip.arc_end);
}

void clip_at_horizon() {
    SteradianHorizonClip clip = steradian_horizon_clip_begin();
    for (int i = 0; i < corner_count; i++) {
        clip = steradian_horizon_clip_edge(clip, corners[i], corners[i + 1 < corner_count ? i + 1 : 0]);
        add_edge(clip.start, clip.end);
        add_arc_of_horizon(clip);
    }
    clip = steradian_horizon_clip_finish(clip);
    add_arc_of_horizon(clip);
}

#if METHOD == REPRESENTATIVE_POINT
vec2 specular(vec3 view, float alpha) {
    clip_at_horizon();
    vec3 mirror = steradian_phong_mirror(view);
    SteradianRepresentativeWalk walk = steradian_representative_begin();
    SteradianSolidAngleWalk solid = steradian_solid_angle_begin(vec3(0.0, 0.0, 1.0));
    for (int i = 0; i < edge_count; i++) {
        walk = steradian_representative_add_edge(walk, mirror, edge_begins[i], edge_ends[i]);
        solid = steradian_solid_angle_add_edge(solid, edge_begins[i], edge_ends[i]);
    }
    if (edge_count == 0) return vec2(0.0);
    float lobe = steradian_representative_radiance(walk, view, mirror, steradian_solid_angle_finish(solid, false), alpha, false);
    return vec2(lobe, lobe * steradian_fresnel_schlick(0.0, 1.0, steradian_representative_v_dot_h(walk, view, mirror, false)));
}
#elif IS_LTC
#if METHOD != LTC_COMPACT
// Linear between entries, which stand on the table's ends.
vec4 looked_up(sampler2D table, vec2 place) {
    int last = textureSize(table, 0).x - 1;
    vec2 at = clamp(place, 0.0, 1.0) * float(last);
    ivec2 i = min(ivec2(at), ivec2(last - 1));
    vec2 share = at - vec2(i);
    vec4 low = mix(texelFetch(table, i, 0), texelFetch(table, i + ivec2(1, 0), 0), share.x);
    vec4 high = mix(texelFetch(table, i + ivec2(0, 1), 0), texelFetch(table, i + ivec2(1, 1), 0), share.x);
    return mix(low, high, share.y);
}
#endif

vec2 specular(vec3 view, float alpha) {
    vec2 place = steradian_ltc_coordinates(sqrt(alpha), view.z);
#if METHOD == LTC_COMPACT
    SteradianLtcMatrix m = steradian_ltc_from_compact(steradian_ltc_ggx_shape(place), alpha, view);
    vec2 magnitude = steradian_ltc_ggx_magnitude(place);
#else
    SteradianLtcMatrix m = steradian_ltc_from_classic(looked_up(ltc_matrix, place));
    vec2 magnitude = looked_up(ltc_magnitude, place).xy;
#endif
    SteradianLtcWalk walk = steradian_ltc_begin();
    vec3 whole = vec3(0.0);
    for (int i = 0; i < corner_count; i++) {
        vec3 a = corners[i];
        vec3 b = corners[i + 1 < corner_count ? i + 1 : 0];
        vec3 ta = steradian_ltc_direction(m, a);
        vec3 tb = steradian_ltc_direction(m, b);
#if METHOD == LTC_CLIPLESS
        whole = steradian_ltc_clipless_add_edge(whole, ta, tb);
#else
        walk = steradian_ltc_add_edge(walk, m, a, b, ta, tb);
#endif
    }
#if METHOD == LTC_CLIPLESS
    return magnitude * steradian_ltc_clipless_integral(whole, false);
#else
    return magnitude * steradian_ltc_integral(walk, false);
#endif
}
#elif IS_HALF_VECTOR
const int kArcs = 4;
const int kSliverNodes = 4;

#if METHOD == HALF_VECTOR
#define SUM vec3
#else
#define SUM float
#endif

// GGX with F = 1 and with F = (1 - v.h)^5; the others, which have no Fresnel, once.
vec2 specular(vec3 view, float alpha) {
    clip_at_horizon();
#if METHOD == BLINN_PHONG
    float n = max(2.0 / (alpha * alpha) - 2.0, 0.1);  // slopes as wide as alpha's
#elif METHOD == BECKMANN
    SteradianMomentSeriesHigh series = steradian_beckmann_series();
#endif
    SteradianGgxView ggx = steradian_ggx_view(view, alpha, alpha);
    SUM sum = SUM(0.0);
    for (int i = 0; i < edge_count; i++) {
        SteradianConicArc edge = steradian_ggx_edge(ggx, edge_begins[i], edge_ends[i]);
        if (!(edge.end > edge.begin)) continue;
        float weight = steradian_half_vector_split_weight(edge);
        SteradianConicNode first = steradian_half_vector_split_end(edge, edge.begin, weight);
        vec3 p = steradian_half_vector_at(ggx, edge, edge.begin);
        for (int j = 1; j <= kArcs; j++) {
            float tau = j == kArcs ? edge.end : steradian_half_vector_split_pole_mapped(edge, float(j) / float(kArcs));
            vec3 q = steradian_half_vector_at(ggx, edge, tau);
            SteradianConicNode last = steradian_half_vector_split_end(edge, tau, weight);
#if METHOD == HALF_VECTOR
            sum += steradian_ggx_arc(ggx, p, q);
#elif METHOD == BLINN_PHONG
            sum += steradian_blinn_phong_arc(p, q, view, n);
#else
            sum += steradian_beckmann_arc(ggx, p, q, series);
#endif
            for (int k = 0; k < kSliverNodes; k++) {
                SteradianHalfVectorNode node = steradian_half_vector_between(ggx, edge, first, last, p, q, steradian_gauss_legendre_node(kSliverNodes, k));
#if METHOD == HALF_VECTOR
                sum += steradian_ggx_at_half_vector(ggx, node.h) * node.solid_angle;
#elif METHOD == BLINN_PHONG
                sum += steradian_blinn_phong_at_half_vector(node.h, view, n) * node.solid_angle;
#else
                sum += steradian_beckmann_at_half_vector(ggx, node.h) * node.solid_angle;
#endif
            }
            p = q;
            first = last;
        }
    }
#if METHOD == HALF_VECTOR
    SteradianGgxCubature c = steradian_ggx_cubature_begin(ggx, sum, 1.0, 1.0);
    for (int i = 0; i < edge_count; i++) c = steradian_ggx_cubature_edge(c, steradian_ggx_edge(ggx, edge_begins[i], edge_ends[i]), 0);
    return steradian_ggx_cubature_finish(c);
#else
    return vec2(steradian_half_vector_radiance(ggx, sum, 1.0), 0.0);
#endif
}
#elif IS_GGX
vec2 specular(vec3 view, float alpha) {
    clip_at_horizon();
    SteradianGgxView ggx = steradian_ggx_view(view, alpha, alpha);
    vec3 e = vec3(0.0);
    for (int i = 0; i < edge_count; i++) e += steradian_conic_vector(steradian_ggx_edge(ggx, edge_begins[i], edge_ends[i]));
#if METHOD == CLOSED_FORM_DRAFT
    return steradian_ggx_draft(ggx, e, 1.0, 1.0);
#else
    SteradianGgxCubature c = steradian_ggx_cubature_begin(ggx, e, 1.0, 1.0);
    for (int i = 0; i < edge_count; i++)
        c = steradian_ggx_cubature_edge(c, steradian_ggx_edge(ggx, edge_begins[i], edge_ends[i]), METHOD == CLOSED_FORM_HIGH ? 2 : 0);
    return steradian_ggx_cubature_finish(c);
#endif
}
#elif IS_PHONG
float front_of(SteradianMomentEdge edge, float n) {
#if METHOD == ARVO
    return steradian_moment_arvo_front(edge, int(n), 0, 0.0);
#elif METHOD == LORENTZIAN
    return steradian_moment_lorentzian_front(edge, n, 1);
#elif METHOD == PEARSON
    return steradian_moment_pearson_front(edge, n, 1);
#elif METHOD == ELLIPSOID
    return steradian_moment_ellipsoid_front(edge, n, 0);
#elif METHOD == SERIES
    return steradian_moment_series_front(edge, steradian_moment_series_prepare(n));
#elif METHOD == SERIES_HIGH
    return steradian_moment_series_high_front(edge, steradian_moment_series_high_prepare(n));
#else
    return steradian_moment_quadrature_front(edge, n).moment;
#endif
}

float phong(vec3 view, float n) {
    clip_at_horizon();
    vec3 mirror = steradian_phong_mirror(view);
    float sum = 0.0;
    for (int i = 0; i < edge_count; i++) {
        SteradianMomentEdge edge = steradian_moment_edge(edge_begins[i], edge_ends[i], mirror);
        sum += steradian_moment_edge_share(edge, front_of(edge, n));
    }
    return steradian_moment_phong_radiance(sum, false);
}
#endif

void main() {
    ivec2 at = ivec2(gl_FragCoord.xy);
    vec4 place = texelFetch(places, at, 0);
    if (place.w < 0.5) discard;
    vec4 surface = texelFetch(normals, at, 0);
    vec3 view = normalize(eye - place.xyz);
    mat3 frame = steradian_frame_from_normal_and_view(surface.xyz, view);
    vec3 v = steradian_transform_transposed(frame, view);
    v.y = 0.0;
    float alpha = max(surface.w * surface.w, 1.0e-4);
    // The Phong lobe as wide as GGX: a whole exponent, since Arvo's recurrence serves no other.
    float exponent = max(floor(2.0 / (alpha * alpha) - 1.5), 1.0);
#if IS_PHONG
    float width = 1.0 / sqrt(exponent + 1.0);
#else
    float width = 2.0 * alpha;
#endif
    float irradiance = look_at_light(place.xyz, frame, vec3(-v.x, 0.0, v.z), width);
    if (irradiance < 0.0) discard;
    vec3 sum = texelFetch(albedos, at, 0).xyz * steradian_lambert_radiance(irradiance);
    vec3 f0 = texelFetch(mirrors, at, 0).xyz;
#if IS_GGX
    if (v.z > 0.0) {
        vec2 part = specular(v, alpha);
        sum += f0 * (part.x - part.y) + part.y;
    }
#elif IS_HALF_VECTOR
    if (v.z > 0.0) sum += f0 * specular(v, alpha).x;
#elif IS_PHONG
    if (v.z > 0.0) sum += f0 * phong(v, exponent);
#endif
    colour = vec4(sum * radiance, 1.0);
}
