// What one light sends from every surface of the G-buffer to the eye, by one method. page.js puts the version, KIND, METHOD and the shader
// library before it, and adds the lights up.
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.
#define POLYGON 0
#define DISK 1
#define BALL 2
#define TUBE 3

#define LAMBERT 0
#define REPRESENTATIVE_POINT 1
#define LTC_COMPACT 2
#define CLOSED_FORM_DRAFT 3
#define CLOSED_FORM 4
#define CLOSED_FORM_HIGH 5
#define ARVO 6
#define LORENTZIAN 7
#define PEARSON 8
#define ELLIPSOID 9
#define SERIES 10
#define SERIES_HIGH 11
#define PHONG_EXACT 12
#define IS_GGX (METHOD >= REPRESENTATIVE_POINT && METHOD <= CLOSED_FORM_HIGH)
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
    if (dot(start, clip.arc_end) < -0.9999) {
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
#elif METHOD == LTC_COMPACT
vec2 specular(vec3 view, float alpha) {
    vec2 place = steradian_ltc_coordinates(sqrt(alpha), view.z);
    SteradianLtcMatrix m = steradian_ltc_from_compact(steradian_ltc_ggx_shape(place), alpha, view);
    SteradianLtcWalk walk = steradian_ltc_begin();
    for (int i = 0; i < corner_count; i++) {
        vec3 a = corners[i];
        vec3 b = corners[i + 1 < corner_count ? i + 1 : 0];
        walk = steradian_ltc_add_edge(walk, m, a, b, steradian_ltc_direction(m, a), steradian_ltc_direction(m, b));
    }
    return steradian_ltc_ggx_magnitude(place) * steradian_ltc_integral(walk, false);
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
#elif IS_PHONG
    if (v.z > 0.0) sum += f0 * phong(v, exponent);
#endif
    colour = vec4(sum * radiance, 1.0);
}
