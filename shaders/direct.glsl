// Direct light of a batch of tiles from lights of one kind by one method. A thread handles a pixel and goes through its tile's lights.
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.
//
// A shader is one lobe by one family of methods and defines it as LOBE. The diffuse lobe has diffuse.comp, sheen has sheen.comp. GGX has
// ltc.comp, ltc_clipless.comp, closed_form.comp, half_vector.comp and representative_point.comp. Phong's lobe
// has phong_lobe.comp. texture_means.comp computes what they read, and runs before them.
// Drivers compile everything that a shader holds for each of its pipelines.
#extension GL_KHR_shader_subgroup_ballot : require
#include "layout.glsl"
#include "shadow_layout.glsl"

// A pipeline is one choice of these (source/device/direct/direct_light.cpp).
layout(constant_id = 0) const int KIND = 0;
layout(constant_id = 1) const int WITH_DIFFUSE = 0;        // transformed cosines only: 1: one walk for both lobes
layout(constant_id = 2) const int COMPACT_TABLE = 0;       // transformed cosines only
layout(constant_id = 3) const int QUALITY = 1;             // 0 draft, 1 normal, 2 high
layout(constant_id = 4) const int WHICH_LOBE = 0;          // 1: coat's, not the base's, 2: own_lobe.glsl's; texture_means.comp: see there
layout(constant_id = 5) const int CAREFUL_LIGHTS = 1;      // some points may see a light as small, or be near its rim
layout(constant_id = 6) const int CHUNKED_EDGES = 0;       // an outline may have more edges than there is space for
layout(constant_id = 7) const int FRESNEL_LOBE = 0;        // 1: the table has a separate lobe for (1 - v.h)^5
layout(constant_id = 8) const int ONLY_BALLS = 0;          // 1: only ellipsoids of three equal axes
layout(constant_id = 9) const int CORNERS = 12;            // number of corners that replace a round light
layout(constant_id = 10) const int CORNER_SPACE = 32;      // ... and near its rim
layout(constant_id = 11) const int EDGE_SPACE = 34;
layout(constant_id = 12) const int ARC_SPACE = 34;
layout(constant_id = 13) const int MATRIX_SIZE = 2;
layout(constant_id = 14) const int MAGNITUDE_SIZE = 2;
layout(constant_id = 15) const int SHADOWED_LIGHTS = 0;    // 1: something occludes the lights, or a part of them, from some points
layout(constant_id = 16) const int UNCUT_LIGHTS = 0;       // 1: every point sees each light whole, above its horizon, from the lit side
layout(constant_id = 17) const int UNEVEN_LIGHTS = 0;      // 1: textured, with means in `means`
layout(constant_id = 18) const int TABLE_FIRST = 0;        // texture_means.comp only: place where the table begins
layout(constant_id = 19) const int PROFILED_LIGHTS = 0;    // 1: point lights with a profile
layout(constant_id = 20) const int LOBE_FORM = 0;          // GGX 1: without shadowing, 2: also without Fresnel; custom lobes: see there
layout(constant_id = 21) const int METHOD = 0;             // Phong's lobe only: phong_methods.glsl
layout(constant_id = 22) const int LOW_EXPONENT = 0;       // form of a series: own_lobes.cpp
const float SMITH = LOBE_FORM == 0 ? 1.0 : 0.0;
const bool COAT = WHICH_LOBE == 1;
const bool OWN = WHICH_LOBE == 2;
const bool CAREFUL = CAREFUL_LIGHTS == 1;
const bool CHUNKED = CHUNKED_EDGES == 1;
const bool FRESNEL_TABLE = FRESNEL_LOBE == 1;
const bool BALLS = ONLY_BALLS == 1;
const bool COMPACT = COMPACT_TABLE == 1;
const bool TOGETHER = WITH_DIFFUSE == 1;
const bool SHADOWED = SHADOWED_LIGHTS == 1;
const bool UNCUT = UNCUT_LIGHTS == 1;
const bool PROFILED = PROFILED_LIGHTS == 1;
const bool UNEVEN = UNEVEN_LIGHTS != 0;

layout(local_size_x = 64) in;
layout(binding = 0) uniform samplerBuffer surfaces;
layout(binding = 1) uniform samplerBuffer tables;
layout(binding = 2) uniform samplerBuffer lights;
layout(binding = 3) uniform samplerBuffer vertices;
layout(binding = 4) uniform samplerBuffer radiance_before;  // the same buffer as `radiance`: every thread reads what it alone writes
layout(binding = 5) uniform usamplerBuffer lists;
layout(std430, binding = 6) writeonly buffer Radiance { vec4 radiance[]; };
layout(std430, binding = 7) readonly buffer States { uint states[]; };
layout(std430, binding = 8) buffer Parts { vec4 parts[]; };
layout(std430, binding = 9) buffer Means { vec4 means[]; };
layout(std430, binding = 10) readonly buffer Details { vec4 details[]; };
layout(push_constant) uniform Push { uint first_entry; };

#include "entry.glsl"
#include "kernels.glsl"
#include "parts.glsl"
#include "lights.glsl"
#include "light_profiles.glsl"

PunctualIncident punctual_at(Light light, vec3 p) {
    PunctualIncident incident;
    if (light.r[1].w > 0.5) {  // directional
        incident.direction = -light.r[3].xyz;
        incident.irradiance = 1.0;
        return incident;
    }
    PunctualSource source;
    source.position = light.r[2].xyz;
    source.direction = light.r[3].xyz;
    source.inverse_range2 = light.r[2].w;
    source.spot_scale = light.r[3].w;
    source.spot_offset = light.r[4].w;
    incident = punctual_incident(source, p);
    if (PROFILED) {
        vec3 from = -incident.direction;
        incident.irradiance *= profile_intensity(int(light.r[kWhereDetails].w), vec3(dot(from, light.r[5].xyz), dot(from, light.r[6].xyz),
                                                                                   dot(from, light.r[7].xyz)));
    }
    return incident;
}

#include "outline.glsl"
#include "own_lobe.glsl"
#if LOBE == LOBE_DIFFUSE
#include "diffuse.glsl"
#elif LOBE == LOBE_SHEEN
#include "sheen.glsl"
#elif LOBE == LOBE_PHONG
#include "phong_lobe.glsl"
#elif LOBE != LOBE_TEXTURE_MEANS
#include "specular.glsl"
#endif

// Index of the thread's pixel among the means of a square and a light.
uint slot_of_means() { return gl_WorkGroupID.x * uint(kGroup) + gl_LocalInvocationID.x; }

vec4 surface_at(uint tile, int plane, uint slot) { return texelFetch(surfaces, (int(tile) * kPlanes + plane) * kSlots + int(slot)); }

#if LOBE == LOBE_TEXTURE_MEANS
#include "tables.glsl"
#include "light_textures.glsl"
#include "texture_means.glsl"
#else
// The values of a pixel's surface that the lobe needs.
struct Surface {
    vec3 p;
    vec3 n;
    vec3 up;  // the same, except for a coat's lobe
    vec3 v;
    float loss;
    bool has_lobe;
#if LOBE == LOBE_DIFFUSE
    vec3 albedo;
#elif LOBE == LOBE_SHEEN
    vec4 sheen;
#elif LOBE == LOBE_PHONG
    OwnLobe own;
    vec3 tangent;
#else
    SpecularLobe lobe;
    vec3 f0;
    vec3 f90;
    vec3 albedo;
#endif
};

Surface surface_in(Entry entry) {
    uint tile = entry.tile;
    uint slot = entry.slot;
    vec4 position = surface_at(tile, kPosition, slot);
    vec4 normal = surface_at(tile, kNormal, slot);
    vec4 view = surface_at(tile, kView, slot);
    Surface s;
    s.p = position.xyz;
    s.n = normal.xyz;
    s.up = normal.xyz;
    s.v = view.xyz;
    s.loss = view.w;
    s.has_lobe = dot(s.up, s.up) > 0.25;
    OwnLobe own;
    if (OWN) {
        own = own_lobe_at(entry.own);
        s.has_lobe = s.has_lobe && surface_at(tile, kF0, slot).w == own.material;
    }
#if LOBE == LOBE_DIFFUSE
    s.albedo = surface_at(tile, kAlbedo, slot).xyz;
#elif LOBE == LOBE_SHEEN
    if (OWN)
        s.sheen = vec4(own.color, own.ax);
    else
        s.sheen = surface_at(tile, kSheen, slot);
#elif LOBE == LOBE_PHONG
    s.own = own;
    s.tangent = surface_at(tile, kTangent, slot).xyz;
#else
    vec4 tangent = surface_at(tile, kTangent, slot);
    s.lobe.tangent = tangent.xyz;
    s.lobe.ax = position.w;
    s.lobe.ay = normal.w;
    if (OWN) {
        s.lobe.tangent = tangent_of(own, tangent.xyz);
        s.lobe.ax = own.ax;
        s.lobe.ay = own.ay;
        s.f0 = own.color;
        s.f90 = own.f90;
    } else if (COAT) {
        vec4 coat = surface_at(tile, kCoatNormal, slot);
        s.n = coat.xyz;
        s.lobe.ax = coat.w;
        s.lobe.ay = coat.w;
        s.f90 = vec3(tangent.w);
        s.f0 = 0.04 * s.f90;
    } else {
        s.f0 = surface_at(tile, kF0, slot).xyz;
        s.f90 = surface_at(tile, kF90, slot).xyz;
    }
    s.albedo = TOGETHER ? surface_at(tile, kAlbedo, slot).xyz : vec3(0.0);
#endif
    return s;
}

// Radiance towards the view from a light of radiance 1.
vec3 sent_by(Light light, Surface s) {
#if LOBE == LOBE_DIFFUSE
    return s.albedo * lambert_radiance(irradiance_below_boundary(light, s.p, s.n, s.v, s.loss));
#elif LOBE == LOBE_SHEEN
    return s.sheen.xyz * sheen_radiance(light, s.p, s.n, s.v, s.sheen.w);
#elif LOBE == LOBE_PHONG
    return s.own.color * own_radiance(light, s.p, s.n, s.v, s.tangent, s.own);
#else
    // The visible part of a light lies above the surface's horizon. A coat's normal differs from the surface's only by rounding.
    vec3 n = COAT && by_pieces() ? s.up : s.n;
    Answer answer = specular_answer(light, s.p, n, s.v, s.lobe, s.loss);
    return s.f0 * (answer.specular.x - answer.specular.y) + s.f90 * answer.specular.y +
           s.albedo * lambert_radiance(answer.irradiance);
#endif
}

// Numbers for each light in the lists: its own, that of its states, that of its means.
const uint kNumbers = 1u + uint(SHADOWED_LIGHTS) + (UNEVEN ? 1u : 0u);

void main() {
    Entry entry = entry_here();
    Surface surface = surface_in(entry);
    if (!surface.has_lobe) return;
    vec3 sum = vec3(0.0);
    uint i = 0u;
    do {
        uint at = entry.first + kNumbers * i;
        Light light = light_at(listed(at));
        vec4 found = vec4(0.0);  // mean radiance of a textured light. An occluded part has that of the whole, as on the CPU
        if (UNEVEN) found = means[listed(at + kNumbers - 1u) + slot_of_means()];
        if (SHADOWED) {
            take_part(states[listed(at + 1u) + entry.slot]);
            for (int turn = first_turn(); turn <= kLastTurn; turn++) {
                turn_to(turn);
                vec3 sent = sent_by(light, surface);
                sent *= part.weight * (UNEVEN && turn == kLastTurn ? found.xyz : light.r[0].xyz);
                if (part.whole > 0)
                    parts[part.whole - kPartSums + turn].xyz += sent;
                else
                    sum += sent;
            }
        } else {
            vec3 sent = sent_by(light, surface);
            sum += sent * (UNEVEN ? found.xyz : light.r[0].xyz);
        }
        ++i;
    } while (i < entry.count);

    uint to = entry.tile * uint(kRadiance) + entry.slot;
    radiance[to] = vec4(texelFetch(radiance_before, int(to)).xyz + sum, 0.0);
}
#endif
