// The fragment shader of the page: a quad light over a floor, the floor's light by one method or the difference of two.
// page.js puts the version, FIRST, SECOND (numbers of methods; SECOND -1: no difference) and the shader library before it.
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.
#define LAMBERT 0
#define LTC_COMPACT 1
#define CLOSED_FORM_DRAFT 2
#define CLOSED_FORM 3
#define PHONG_SERIES 4
#define USES(method) (FIRST == method || SECOND == method)

uniform vec2 resolution;
uniform int samples;      // a side, for smooth edges only: the light needs none
uniform float orbit;      // angle of the eye about the y axis [rad]
uniform float height;     // of the light's centre [m]
uniform vec2 half_size;   // of the light [m]
uniform float tilt;       // 0: shines down, pi/2: towards +z [rad]
uniform float intensity;  // radiance
uniform float roughness;  // of GGX, perceptual
uniform float f0;         // reflectance along the normal; of Phong: at every angle
uniform float exponent;   // of Phong
uniform float exposure;   // powers of two
uniform float gain;       // of the difference
out vec4 colour;

const vec3 kLightColour = vec3(1.0, 0.80, 0.58);
const vec3 kSky = vec3(0.0006, 0.0007, 0.0010);

// What a floor point sees, in its shading frame.
//   view     unit: (s, 0, c)
//   corner   unit directions of the light's corners in walk order
struct Sight {
    vec3 view;
    vec3 corner[4];
};

// The light's edges above the horizon, and last the arc of the horizon that closes them; an edge that is not there has
// equal ends. A quad goes down and comes up at most once, so that there is at most one arc.
struct ClippedQuad {
    vec3 start[5];
    vec3 end[5];
};

ClippedQuad clipped(Sight sight) {
    ClippedQuad quad;
    quad.start[4] = vec3(0.0);
    quad.end[4] = vec3(0.0);
    SteradianHorizonClip clip = steradian_horizon_clip_begin();
    for (int i = 0; i < 4; i++) {
        clip = steradian_horizon_clip_edge(clip, sight.corner[i], sight.corner[(i + 1) & 3]);
        quad.start[i] = clip.start;
        quad.end[i] = clip.end;
        if (clip.closes) {
            quad.start[4] = clip.arc_start;
            quad.end[4] = clip.arc_end;
        }
    }
    clip = steradian_horizon_clip_finish(clip);
    if (clip.closes) {
        quad.start[4] = clip.arc_start;
        quad.end[4] = clip.arc_end;
    }
    return quad;
}

float lambert(Sight sight) {
    SteradianPolygonWalk walk = steradian_polygon_begin();
    for (int i = 0; i < 4; i++) walk = steradian_polygon_add_edge(walk, sight.corner[i], sight.corner[(i + 1) & 3]);
    return steradian_lambert_radiance(steradian_polygon_irradiance(walk, false));
}

#if USES(LTC_COMPACT)
float ltc_compact(Sight sight) {
    vec2 place = steradian_ltc_coordinates(roughness, sight.view.z);
    vec4 shape = steradian_ltc_ggx_shape(place);
    vec2 magnitude = steradian_ltc_ggx_magnitude(place);
    SteradianLtcMatrix m = steradian_ltc_from_compact(shape, max(roughness * roughness, 1.0e-4), sight.view);
    SteradianLtcWalk walk = steradian_ltc_begin();
    for (int e = 0; e < 4; e++) {
        vec3 a = sight.corner[e];
        vec3 b = sight.corner[(e + 1) & 3];
        walk = steradian_ltc_add_edge(walk, m, a, b, steradian_ltc_direction(m, a), steradian_ltc_direction(m, b));
    }
    return steradian_ltc_specular_scale(f0, 1.0, magnitude.x, magnitude.y) * steradian_ltc_integral(walk, false);
}
#endif

#if USES(CLOSED_FORM_DRAFT) || USES(CLOSED_FORM)
float closed_form(Sight sight, bool draft) {
    float alpha = max(roughness * roughness, 1.0e-4);
    SteradianGgxView view = steradian_ggx_view(sight.view, alpha, alpha);
    ClippedQuad quad = clipped(sight);
    SteradianConicArc arcs[5];
    vec3 e = vec3(0.0);
    for (int i = 0; i < 5; i++) {
        arcs[i] = steradian_ggx_edge(view, quad.start[i], quad.end[i]);
        e += steradian_conic_vector(arcs[i]);
    }
    if (draft) return steradian_ggx_radiance(steradian_ggx_draft(view, e, 1.0, 1.0), f0, 1.0);
    SteradianGgxCubature c = steradian_ggx_cubature_begin(view, e, 1.0, 1.0);
    for (int i = 0; i < 5; i++) c = steradian_ggx_cubature_edge(c, arcs[i], 0);
    return steradian_ggx_radiance(steradian_ggx_cubature_finish(c), f0, 1.0);
}
#endif

#if USES(PHONG_SERIES)
float phong_series(Sight sight) {
    vec3 mirror = steradian_phong_mirror(sight.view);
    SteradianMomentSeries series = steradian_moment_series_prepare(exponent);
    ClippedQuad quad = clipped(sight);
    float sum = 0.0;
    for (int i = 0; i < 5; i++) {
        SteradianMomentEdge edge = steradian_moment_edge(quad.start[i], quad.end[i], mirror);
        sum += steradian_moment_edge_share(edge, steradian_moment_series_front(edge, series));
    }
    return f0 * steradian_moment_phong_radiance(sum, false);
}
#endif

// The floor's radiance for a light of radiance 1: matt, or a glossy coat over a darker floor.
vec3 floor_radiance(int method, Sight sight, vec3 albedo) {
    vec3 matt = albedo * lambert(sight);
    if (method == LAMBERT) return matt;
    float gloss = 0.0;
#if USES(LTC_COMPACT)
    if (method == LTC_COMPACT) gloss = ltc_compact(sight);
#endif
#if USES(CLOSED_FORM_DRAFT)
    if (method == CLOSED_FORM_DRAFT) gloss = closed_form(sight, true);
#endif
#if USES(CLOSED_FORM)
    if (method == CLOSED_FORM) gloss = closed_form(sight, false);
#endif
#if USES(PHONG_SERIES)
    if (method == PHONG_SERIES) gloss = phong_series(sight);
#endif
    return 0.3 * matt + gloss;
}

// Radiance that the eye sees along a ray.
vec3 radiance_along(int method, vec3 eye, vec3 ray) {
    vec3 facing = vec3(0.0, -cos(tilt), sin(tilt));
    vec3 u = vec3(half_size.x, 0.0, 0.0);
    vec3 w = vec3(0.0, sin(tilt), cos(tilt)) * half_size.y;
    vec3 centre = vec3(0.0, height, 0.0);

    float nearest = 1.0e30;
    vec3 seen = kSky;
    if (ray.y < 0.0) {
        nearest = -eye.y / ray.y;
        vec3 p = eye + ray * nearest;
        seen = vec3(0.0);
        if (dot(facing, p - centre) > 0.0) {
            mat3 frame = steradian_frame_from_normal_and_view(vec3(0.0, 1.0, 0.0), -ray);
            Sight sight;
            sight.view = steradian_transform_transposed(frame, -ray);
            sight.view.y = 0.0;
            sight.corner[0] = steradian_polygon_direction(steradian_transform_transposed(frame, centre - u + w - p));  // walk order: backwards
            sight.corner[1] = steradian_polygon_direction(steradian_transform_transposed(frame, centre + u + w - p));
            sight.corner[2] = steradian_polygon_direction(steradian_transform_transposed(frame, centre + u - w - p));
            sight.corner[3] = steradian_polygon_direction(steradian_transform_transposed(frame, centre - u - w - p));
            float odd = mod(floor(p.x) + floor(p.z), 2.0);
            vec3 albedo = mix(vec3(0.62, 0.61, 0.60), vec3(0.42, 0.42, 0.43), odd);
            seen = floor_radiance(method, sight, albedo) * kLightColour * intensity;
        }
    }
    float t = dot(facing, centre - eye) / dot(facing, ray);
    vec3 q = eye + ray * t - centre;
    bool hit = t > 0.0 && t < nearest && abs(dot(q, u)) <= dot(u, u) && abs(dot(q, w)) <= dot(w, w);
    if (hit) seen = dot(facing, ray) < 0.0 ? kLightColour * intensity : vec3(0.02);
    return seen;
}

vec3 display(vec3 radiance) {
    vec3 x = 1.0 - exp(-radiance * exp2(exposure));
    return mix(1.055 * pow(x, vec3(1.0 / 2.4)) - 0.055, 12.92 * x, vec3(lessThanEqual(x, vec3(0.0031308))));
}

void main() {
    vec3 target = vec3(0.0, 0.3, 0.0);
    vec3 eye = vec3(5.2 * sin(orbit), 1.7, 5.2 * cos(orbit));
    vec3 forward = normalize(target - eye);
    vec3 right = normalize(cross(forward, vec3(0.0, 1.0, 0.0)));
    vec3 up = cross(right, forward);
    vec3 sum = vec3(0.0);
    for (int j = 0; j < samples; j++) {
        for (int i = 0; i < samples; i++) {
            vec2 offset = (vec2(float(i), float(j)) + 0.5) / float(samples) - 0.5;
            vec2 s = (2.0 * (gl_FragCoord.xy + offset) - resolution) / resolution.y * 0.45;
            vec3 ray = normalize(forward + right * s.x + up * s.y);
            vec3 x = display(radiance_along(FIRST, eye, ray));
#if SECOND >= 0
            x = min(abs(x - display(radiance_along(SECOND, eye, ray))) * gain, 1.0);
#endif
            sum += x;
        }
    }
    colour = vec4(sum / float(samples * samples), 1.0);
}
